// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/change_of_step.h"

namespace buckens::stepping {

bool must_rescale(const model::State& state, const Scheme& scheme) {
  return scheme.has_algorithmic() && state.last_step > 0.0 && state.last_step != scheme.h;
}

void rescale_algorithmic(model::State& state, const Scheme& scheme) {
  const double ratio = scheme.h / state.last_step;
  for (model::BodyState& s : state.bodies) {
    s.w_alg = s.w_dot + ratio * (s.w_alg - s.w_dot);
    s.v_alg = s.v_dot + ratio * (s.v_alg - s.v_dot);
    if (s.d.size() == 0) continue;
    const linalg::Vector &d_ddot = s.d_ddot.whole(), &d_alg = s.d_alg.whole();
    s.d_alg = d_ddot + ratio * (d_alg - d_ddot);
  }
}

}  // namespace buckens::stepping

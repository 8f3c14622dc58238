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
    if (s.d.size() > 0) s.d_alg = s.d_ddot + ratio * (s.d_alg - s.d_ddot);
  }
}

}  // namespace buckens::stepping

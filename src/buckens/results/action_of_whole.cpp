// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/action_of_whole.h"

#include "buckens/loads/joint_law_spec.h"

namespace buckens::results {

loads::Action action_of_whole(const Observation& now, std::size_t load,
                              const dynamics::LoadEnds& ends) {
  const dynamics::Circumstances around = circumstances_of(now);
  const auto action = [&](std::size_t k) {
    return dynamics::action_of(now.model, k, now.state.t, around, ends);
  };
  const std::vector<model::Load>& all = now.model.loads;
  loads::Action out = action(load);
  if (all[load].kind != loads::BallFrictionSpec::kKey) return out;
  for (std::size_t k = load + 1; k < all.size() && all[k].name == all[load].name; ++k) {
    const loads::Action more = action(k);
    out.on_first += more.on_first;
    out.on_second += more.on_second;
  }
  return out;
}

}  // namespace buckens::results

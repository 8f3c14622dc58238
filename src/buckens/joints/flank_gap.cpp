// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/flank_gap.h"

#include <cmath>

namespace buckens::joints {

using spatial::MarkerBias;
using spatial::MarkerMotion;

std::array<double, FlankGap::kMostStates> FlankGap::states() const {
  std::array<double, kMostStates> out{};
  // The multiplier of a row pushes against its residual: the flank has the opposite sign.
  out[static_cast<std::size_t>(data_.mesh->num_states()) - 1] = -data_.side;
  return out;
}

CoordinateLook FlankGap::look(const MarkerMotion& F, const MarkerMotion& M,
                              const CountedValue* before) const {
  const RowValue row = data_.mesh->evaluate(F, M, 0.0, states().data());
  const double half = 0.5 * data_.play;
  // Without a flank both sides see the same, also where centres have moved.
  const double passed = before == nullptr ? data_.mesh->evaluate(F, M, 0.0, nullptr).g
                                          : row.g - data_.side * (half - before->fraction);
  const double g = row.g - data_.period * std::round(passed / data_.period);
  CoordinateLook out;
  out.fraction = half - data_.side * g;
  out.J = -data_.side * row.J;
  out.take_rate(F, M);
  return out;
}

double FlankGap::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                      const MarkerBias& bias_M, const CountedValue* /*before*/) const {
  return -data_.side * data_.mesh->bias(F, M, bias_F, bias_M, 0.0, states().data());
}

}  // namespace buckens::joints

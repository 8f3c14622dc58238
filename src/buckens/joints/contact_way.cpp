// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/contact_way.h"

namespace buckens::joints {

using spatial::MarkerBias;
using spatial::MarkerMotion;

const Eigen::Vector3d& ContactWay::direction(const spatial::TouchPlace& place) const {
  if (direction_ == Direction::across) return place.normal;
  return place.along[direction_ == Direction::along ? 0 : 1];
}

double ContactWay::gap(const MarkerMotion& F, const MarkerMotion& M) const {
  return direction_ == Direction::across ? touch_.look(F, M).gap : 0.0;
}

spatial::PairRow ContactWay::derivatives(const MarkerMotion& F, const MarkerMotion& M) const {
  const spatial::TouchPlace place = touch_.look(F, M);
  return place.row(direction(place), F, M);
}

double ContactWay::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                        const MarkerBias& bias_M) const {
  const spatial::TouchPlace place = touch_.look(F, M);
  const auto of_body = [&](const MarkerMotion& body, const MarkerBias& bias) -> Eigen::Vector3d {
    return bias.a + bias.alpha.cross(place.place - body.p) +
           body.w.cross(place.place_rate - body.v);
  };
  const double turning =
      direction_ == Direction::across ? place.normal_rate.dot(place.velocity(F, M)) : 0.0;
  return direction(place).dot(of_body(M, bias_M) - of_body(F, bias_F)) + turning;
}

}  // namespace buckens::joints

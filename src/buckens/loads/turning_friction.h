// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Friction of a ball or a cross joint, whose direction of sliding may turn, or turn round, while a
/// step is iterated. Its first three soft rows are those of its springs.
class TurningFriction {
 public:
  virtual ~TurningFriction() = default;

  /// Its torque along these rows, and what its bound keeps back of it.
  struct Rub {
    Eigen::Vector3d dry = Eigen::Vector3d::Zero();     ///< without the viscous part [N m]
    Eigen::Vector3d excess = Eigen::Vector3d::Zero();  ///< that the bound keeps back [N m]
    std::array<bool, 3> slides{};
    double stiffness = 0, damping = 0;  ///< of the rows where nothing slides
  };
  virtual Rub rub(const Sight& sight) const = 0;
  /// Whether the bound is that of each arm of a cross joint, not of the whole torque.
  virtual bool has_arms() const { return false; }

  /// Which of its rows slide against the direction in which they slid at another instant of the
  /// same step: all or none of a ball, each alone of a cross joint.
  std::array<bool, 3> reversed(const Rub& before, const Rub& now) const {
    std::array<bool, 3> out{};
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double along = has_arms() ? now.dry[row] * before.dry[row] : now.dry.dot(before.dry);
      out[k] = now.slides[k] && before.slides[k] && along < 0.0;
    }
    return out;
  }
};

}  // namespace buckens::loads

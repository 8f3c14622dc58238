// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include "buckens/base/errors.h"
#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Force on the first marker as a function of time and of the marker's motion, world axes [N].
///
/// The function is called several times per step, from one thread at a time, and must return the
/// same value for the same arguments. It provides no derivatives, so that a law that is stiff
/// compared with the bodies slows down the iteration; use a ForceElement with soft rows for it.
/// Positions are relative to Model::origin, which is zero unless the mechanism is very far from
/// that of the world.
class FunctionForce final : public ForceElement {
 public:
  using Law = std::function<Eigen::Vector3d(double t, const spatial::MarkerMotion& marker)>;

  explicit FunctionForce(Law law) : law_(std::move(law)) {}

  /// @throws NumericalError if the function returns something that is not finite
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& /*second*/) const override {
    Action action;
    action.on_first.force = law_(t, first);
    if (!action.on_first.force.allFinite()) {
      throw NumericalError("the force that its function gives is not finite");
    }
    action.active_power = action.on_first.force.dot(first.v);
    return action;
  }
  bool is_applied() const override { return true; }
  bool is_constant() const override { return false; }

 private:
  Law law_;
};

}  // namespace buckens::loads

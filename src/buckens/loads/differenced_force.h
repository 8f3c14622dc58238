// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "buckens/loads/function_force.h"

namespace buckens::loads {

/// Force by a function of time and of the marker's motion, as FunctionForce, with a tangent by
/// central differences.
///
/// Differentiated are position and velocity of the marker, not its rotation. The step's iteration
/// uses the symmetric, resisting parts of −∂F/∂x and −∂F/∂v: six soft rows, along the principal
/// directions of both. What is left out (a force that turns with the position, or drives the
/// motion) changes the number of iterations, not their limit. Costs twelve calls per tangent.
class DifferencedForce final : public ForceElement {
 public:
  explicit DifferencedForce(FunctionForce::Law law) : force_(law), law_(std::move(law)) {}

  /// @throws NumericalError if the function returns something that is not finite
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override {
    return force_.evaluate(t, first, second);
  }
  bool is_applied() const override { return true; }
  bool is_constant() const override { return false; }

  int num_soft_rows() const override { return 6; }
  void append_soft_rows(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second,
                        std::vector<SoftRow>& rows) const override;
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;

 private:
  void append_rows(double t, const spatial::MarkerMotion& first, std::vector<SoftRow>& rows) const;

  FunctionForce force_;
  FunctionForce::Law law_;
};

}  // namespace buckens::loads

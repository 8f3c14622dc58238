// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/base/time_law.h"
#include "buckens/loads/force_element.h"
#include "buckens/loads/load_axes.h"
#include "buckens/loads/signal_factor.h"

namespace buckens::loads {

/// Force or torque on the first marker by laws of time, in world axes (`fixed`) or in the axes of
/// the marker (`following`). Its contributions to frame and mesh, FM (50)–(52) in the plane, follow
/// from the marker's velocity map (docs/theory/01-kinematics.md).
class AppliedLoad final : public ForceElement {
 public:
  enum class Kind { force, torque };

  /// @param value three laws of time [N] or [N m]
  AppliedLoad(Kind kind, LoadAxes axes, std::array<base::TimeLaw, 3> value,
              SignalFactor factor = SignalFactor());

  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  bool uses_signals() const override { return factor_.exists(); }
  bool is_applied() const override { return true; }
  bool is_constant() const override;
  int num_values() const override { return factor_.exists() ? 0 : 3; }
  Eigen::Vector3d values(double t) const override {
    return {value_[0].value(t), value_[1].value(t), value_[2].value(t)};
  }
  bool follows() const override { return axes_ == LoadAxes::following; }
  bool takes_values() const override { return !factor_.exists(); }
  Action act(const Eigen::Vector3d& values, const spatial::MarkerMotion& first) const override;

 private:
  Kind kind_;
  LoadAxes axes_;
  std::array<base::TimeLaw, 3> value_;
  SignalFactor factor_;
};

}  // namespace buckens::loads

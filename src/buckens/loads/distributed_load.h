// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/base/time_law.h"
#include "buckens/loads/force_element.h"
#include "buckens/loads/load_axes.h"
#include "buckens/loads/signal_factor.h"

namespace buckens::loads {

/// Uniform force per area, length, mass or volume over a part of a body.
///
/// Its work is that of the resultant on the mean displacement of that part, eq. (L1), so it acts as
/// a force on a marker at the mean position that follows the mean displacement; such a marker has
/// no rotation of its own, its axes are those of the body.
class DistributedLoad final : public ForceElement {
 public:
  /// @param value three laws of time [N per unit of extent]
  /// @param extent area [m²], length [m], mass [kg] or volume [m³]; negative reverses the load
  DistributedLoad(LoadAxes axes, std::array<base::TimeLaw, 3> value, double extent,
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

 private:
  Action push(const Eigen::Vector3d& value, const spatial::MarkerMotion& first) const;

  LoadAxes axes_;
  std::array<base::TimeLaw, 3> value_;
  double extent_;
  SignalFactor factor_;
};

}  // namespace buckens::loads

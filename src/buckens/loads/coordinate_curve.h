// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "buckens/base/characteristic.h"
#include "buckens/loads/coordinate_law.h"

namespace buckens::loads {

/// Spring and damper on a joint coordinate with a characteristic beside the linear part:
///
///     f = −k x − c ξ̇ − φ(x, ξ̇),   x = ξ − ξ₀
///
/// What the spring stores is ½ k x² + ∫ φ(s, 0) ds; the rest of its power is lost.
class CoordinateCurve final : public ForceElement {
 public:
  /// @param free value of the coordinate without force [m] or [rad]
  CoordinateCurve(base::SignalLaw stiffness, base::SignalLaw damping, base::SignalLaw free,
                  base::Characteristic curve)
      : laws_(std::move(stiffness), std::move(damping), std::move(free)),
        curve_(std::move(curve)) {}

  /// Nothing: the law needs its coordinate, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool uses_signals() const override { return laws_.uses_signals(); }
  bool has_driven_energy() const override { return laws_.drives_energy(); }
  bool is_constant() const override { return laws_.is_constant(); }

 private:
  SpringLaws laws_;
  base::Characteristic curve_;
};

}  // namespace buckens::loads

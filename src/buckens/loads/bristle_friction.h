// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/loads/bristle_bending.h"
#include "buckens/loads/joint_friction.h"

namespace buckens::loads {

/// Dry friction by bending bristles: LuGre's law in the elasto-plastic form of Dupont et al.
/// (2002). With the deflection z and f_s the bound b of FrictionBound,
///
///     dz/ds = 1 − α(z) σ₀ |z|/f_s while z and s grow alike, else 1;   f = −σ₀ z − σ₁ ż − σ₂ ṡ
///
/// α is zero up to the share κ of the deflection f_s/σ₀ at which it slides, and rises to one there:
/// nothing creeps below. κ = 0 is LuGre's own law, α = 1. States: z and f_s.
/// Theory: docs/theory/22-rows.md §4.
class BristleFriction final : public ForceElement, public ReactionFollower {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  BristleFriction(const FrictionData& data, const BristleData& bristles,
                  const Eigen::Vector3d& axis_F, std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, axis_F, std::move(laws)), bristles_(bristles) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  /// Zero: the law needs its coordinate, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override {
    return bound_.at(sight).most_at_rest(sight);
  }
  int num_states() const override { return 2; }
  void find_states(const Sight& sight, double* states) const override;

 private:
  struct Bend {
    double z = 0;      // [m] or [rad]
    double slope = 1;  // dz/ds in the direction of motion
    double bound = 0;  // f_s [N] or [N m]
  };
  Bend bend(const Sight& sight) const;
  double force(const Sight& sight, const Bend& now) const;

  DrivenBound bound_;
  BristleData bristles_;
};

}  // namespace buckens::loads

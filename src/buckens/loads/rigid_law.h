// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// A law of one joint coordinate that does not give way: a rigid row whose multiplier f stays in a
/// set. The force acts as Jᵀf on both markers of the joint.
///
/// While the row is closed, f is an unknown of the step like the multiplier of a joint. Where the
/// set does not admit it, the row takes the stand that next() names, and is not closed any more.
/// Theory: docs/theory/22-rows.md §5.
class RigidLaw : public ForceElement {
 public:
  /// Friction along several directions slides, from this regime on, in a direction that the step
  /// has found; regime 2 is sliding against the slip.
  static constexpr int kHeldDirection = 3;

  /// Nothing: the law needs its coordinate, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const final;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const final { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool is_rigid() const final { return true; }
  int num_states() const override { return 2; }
  void find_states(const Sight& sight, double* states) const override;

  /// How the coordinate touches one end of its free way.
  struct Contact {
    int regime = 0;   ///< in which the law holds this end
    double sign = 1;  ///< of the forces that it can give: it pushes, or it pulls
    double gap = 0;   ///< free way that is left, negative beyond the end [m] or [rad]
  };
  /// The end that is nearer, or 0 in Contact::regime where the law has none: such a law never
  /// strikes.
  virtual Contact contact(double /*value*/) const { return {}; }
  /// Share of the speed of approach with which it is left again.
  /// @param approach > 0 [m/s] or [rad/s], @param signals t and the values of all signals; may be
  /// empty
  virtual double restitution(double /*approach*/, std::span<const double> /*signals*/) const {
    return 0.0;
  }
  /// Which of the rows of one place of a contact it is: 0 across the surface, 1 and 2 along it; −1:
  /// of none. The rows along follow that across. Open, none of them does anything, nor closes
  /// before an impact.
  virtual int row_of_place() const { return -1; }
  /// Which of the three rows of friction in a ball it is; −1: of none. They are the rigid rows of
  /// successive loads, and stick or slide together.
  virtual int row_of_ball() const { return -1; }
  /// A motor: its power comes from outside.
  virtual bool is_source() const { return false; }
  /// Of the coordinate while the row is closed, as far as laws of time and the motion say [m/s²] or
  /// [rad/s²].
  virtual double aimed_acceleration(const Sight& /*sight*/) const { return 0.0; }
  /// Whether no impulse moves its coordinate: the row takes part in impacts as those of joints do.
  virtual bool withstands_impacts(const Sight& /*sight*/) const { return false; }
  /// Regime after an impact that has changed the rate of its coordinate. Impulses exceed any bound,
  /// so what holds by a bounded force gives way, and what slides may slide the other way.
  /// @param sight after the impact, with the stand before it
  /// @param rounding of rates [m/s] or [rad/s]
  virtual int struck_regime(const Sight& sight, double /*rounding*/) const {
    return sight.stand.regime;
  }

 protected:
  /// What the row leaves open and which stand follows, without the force itself.
  virtual RigidRow row(const Sight& sight) const = 0;
};

/// Holds a joint coordinate where it was locked. Regimes: 0 free, 1 locked; only events change
/// them. Its third state is the value that it holds.
class CoordinateLock final : public RigidLaw {
 public:
  static constexpr const char* kKind = "lock";

  int num_states() const override { return 3; }
  void find_states(const Sight& sight, double* states) const override;
  bool withstands_impacts(const Sight& sight) const override { return sight.stand.regime != 0; }

 private:
  RigidRow row(const Sight& sight) const override;
};

/// Rigid stops of a joint coordinate: one-sided rows. Regimes: 1 at the lower end, which pushes up;
/// 2 at the upper end, which pushes down.
class RigidStop : public RigidLaw {
 public:
  /// Default of the threshold: in lengths of what moves per second, or in rad/s.
  static constexpr double kAtRest = 1e-3;

  /// @param from,to ends of the free way [m] or [rad]; −HUGE_VAL, HUGE_VAL: none on that side
  /// @param restitution 0 … 1
  /// @param threshold speed of approach up to which it stays at rest there [m/s] or [rad/s]
  RigidStop(double from, double to, double restitution, double threshold)
      : from_(from), to_(to), restitution_(restitution), threshold_(threshold) {}

  Contact contact(double value) const override;
  /// Value of the coordinate at the end that a regime holds [m] or [rad].
  double end(int regime) const { return regime == 1 ? from_ : to_; }
  double restitution(double approach, std::span<const double> signals) const final {
    return approach > threshold_ ? restitution_at(signals) : 0.0;
  }

 protected:
  /// Of what comes faster than the threshold.
  virtual double restitution_at(std::span<const double> /*signals*/) const { return restitution_; }
  RigidRow row(const Sight& sight) const override;

 private:
  double from_, to_, restitution_, threshold_;
};

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/base/signal_law.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/reaction_follower.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::loads {

/// Parameters of dry friction in a joint.
struct FrictionData {
  double static_coefficient = 0;   ///< μ_s
  double dynamic_coefficient = 0;  ///< μ_d ≤ μ_s
  double stribeck_rate = 0;        ///< v_s [m/s] or [rad/s]; 0: μ_d as soon as it slides
  double viscous = 0;              ///< [N s/m] or [N m s/rad]
  double preload = 0;              ///< resistance without reaction [N] or [N m]
  double slip = 0;                 ///< break-away displacement [m] or [rad], > 0
  double inertia = 0;              ///< moving along the coordinate [kg] or [kg m²]; 0: no damping
  // Lever arms of the reaction [m]; for sliding joints radius is 1, so forces count directly.
  double radius = 0;          ///< of the pin: for forces across the axis
  double axial_radius = 0;    ///< for forces along the axis, of hinges
  double bearing_length = 0;  ///< that carries bending moments; 0: they are ignored
  double torque_radius = 0;   ///< at which sliding joints carry axial torque; 0: ignored
  double pins_radius = 0;     ///< of the pins of a cross, which all of the force presses
};

/// How much a joint resists at one instant.
class FrictionBound {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  FrictionBound(const FrictionData& data, const Eigen::Vector3d& axis_F)
      : data_(data), axis_F_(axis_F) {}

  /// Resistance that the reaction causes per unit of the coefficient [N] or [N m].
  double load(const Sight& sight) const;
  /// Its derivatives by torque and force of the reaction, times a factor; zero where a part of the
  /// reaction vanishes.
  spatial::Wrench load_slope(const Sight& sight, double factor) const;
  /// μ(ξ̇): from the coefficient of sticking down to that of sliding.
  double coefficient(double rate) const;
  /// b = μ N + b₀ at this load and rate [N] or [N m].
  double at(double load, double rate) const { return coefficient(rate) * load + data_.preload; }
  /// The same at rest.
  double most_at_rest(const Sight& sight) const { return at(load(sight), 0.0); }
  const FrictionData& data() const { return data_; }
  const Eigen::Vector3d& axis() const { return axis_F_; }

 private:
  FrictionData data_;
  Eigen::Vector3d axis_F_;
};

/// The parameters of dry friction that may follow time and signals. Below zero they count as zero,
/// and sliding never resists more than sticking.
struct FrictionLaws {
  base::SignalLaw static_coefficient, dynamic_coefficient;
  base::SignalLaw viscous;  ///< [N s/m] or [N m s/rad]
  base::SignalLaw preload;  ///< [N] or [N m]

  bool uses_signals() const;
  bool is_constant() const;
  /// Writes what they are at this instant.
  void set(const Sight& sight, FrictionData& data) const;
};

/// The bound of a law of friction, with the parameters of the instant.
class DrivenBound {
 public:
  /// @param laws take the place of the numbers in `data`; none: these are constant
  DrivenBound(const FrictionData& data, const Eigen::Vector3d& axis_F,
              std::optional<FrictionLaws> laws);

  FrictionBound at(const Sight& sight) const;
  /// f(bound) without a copy of parameters that are constant: every iteration of a step asks.
  template <class F>
  auto ask(const Sight& sight, F&& f) const {
    return laws_ ? f(at(sight)) : f(constant_);
  }
  bool uses_signals() const { return laws_ && laws_->uses_signals(); }
  bool is_constant() const { return !laws_; }

 private:
  FrictionBound constant_;
  std::optional<FrictionLaws> laws_;
};

/// Dry friction on a joint coordinate by elastic stick with return mapping.
///
/// Within the bound b = μ N + b₀ the joint sticks by a spring that breaks away at the given slip;
/// beyond, it slides with b. It does not creep under constant loads below the bound. N comes from
/// the reaction of the joint. Theory: docs/theory/22-rows.md §4.
class JointFriction final : public CoordinateLaw, public ReactionFollower {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  JointFriction(const FrictionData& data, const Eigen::Vector3d& axis_F,
                std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, axis_F, std::move(laws)) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  CoordinateResponse answer(const Sight& sight) const override;
  /// A joint that covers its slip within a millisecond slides from the start.
  void start_states(const Sight& sight, double* states) const override;

  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override {
    return bound_.at(sight).most_at_rest(sight);
  }

  double load(const Sight& sight) const { return bound_.at(sight).load(sight); }

 private:
  ProjectedForce force(const Sight& sight) const override;
  bool is_yielding() const override { return true; }
  /// The answer of a joint that goes on sliding, whose spring and damper both push beyond the
  /// bound: neither the stiffness nor the damping need be known. @return whether it does
  bool slide_on(const FrictionBound& bound, const Sight& sight, CoordinateResponse& out) const;
  /// How far the spring is strained.
  static double strain(const Sight& sight) {
    return (sight.states != nullptr ? sight.states[0] : 0.0) + sight.coordinate.change;
  }

  DrivenBound bound_;
};

/// Dry friction that sticks rigidly: a row that closes the rate of its coordinate as long as the
/// bound admits the force. Regimes: 1 sticks; 2 and 3 slide forwards and backwards.
class RigidFriction final : public RigidLaw, public ReactionFollower {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  RigidFriction(const FrictionData& data, const Eigen::Vector3d& axis_F,
                std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, axis_F, std::move(laws)) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  /// Sticks at rest, slides where it moves.
  void start_states(const Sight& sight, double* states) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override {
    return bound_.at(sight).most_at_rest(sight);
  }
  int struck_regime(const Sight& sight, double rounding) const override;

 private:
  RigidRow row(const Sight& sight) const override;

  DrivenBound bound_;
};

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/stepping/friction_impulses.h"
#include "buckens/stepping/push_answers.h"
#include "buckens/stepping/rigid_instant.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::stepping {

/// Rigid contacts with friction in the iteration of a step: which contact points ("places") let go,
/// stick or slide, and in which direction, is decided for all of them together.
///
/// From the forces and rates that the iteration has reached, forces are found that satisfy (I1) and
/// (I2) with the changes of rates that they cause; the rows get the stands that follow. A single
/// row knows only its own force. If there are more places than needed, one of them may be given
/// more than its own cone admits, as long as all together hold within theirs.
/// Theory: docs/theory/25-contact.md §4.
class ContactCones {
 public:
  explicit ContactCones(const model::Model& model);

  bool empty() const { return places_.empty(); }
  /// Per rigid row: whether it is one of those that are decided here.
  const std::vector<char>& rows() const { return is_own_; }
  /// Whether the stands of all places agree with their forces and rates. A place that has pushed
  /// over the step and pulls only at its end stays closed, and has no friction there.
  /// @param rows of the iteration
  bool hold(const std::vector<loads::RigidRow>& rows, const RigidRows& rigid) const;
  /// Decides the stands of all places afresh.
  /// @param per_force,per_change `compliance` times per_force is the displacement due to a force;
  ///        times per_change as well, it is the change of the rate
  /// @return whether the stand of any row has changed
  bool decide(const RigidInstant& now, double per_force, double per_change, RigidRows& rigid);
  /// Opens the friction rows of a place whose normal row is open.
  void follow(int across, RigidRows& rigid) const;
  /// Like decide(), for forces that act throughout a span of time, including normal forces: (I1)
  /// and (I2) hold at its end, and the rows of all places get the stands and forces that follow.
  /// Such forces always exist, even if there are none at the instant itself.
  /// @param now with the rates that the rows would have at the end of the span without forces
  void hold_over(const RigidInstant& now, double span, RigidRows& rigid);

 private:
  /// One contact point: its normal row ("across") and its friction rows ("along"), which follow it.
  struct Place {
    const loads::ContactFriction* law;
    int across = 0;                        ///< rigid row
    int soft = 0;                          ///< the same among the soft rows
    int count = 1;                         ///< of directions
    loads::ContactFrictionData data = {};  ///< of the instant
  };
  /// Forces and slip of a place in the iteration.
  struct Now {
    double load = 0;                                  ///< across [N]
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();   ///< [m/s]
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< along [N]
    bool is_pressed = false, sticks = false;
  };
  /// The places that press, and the rows along which they push: first all normal rows.
  struct Pressed {
    std::vector<const Place*> places;
    std::vector<Push> pushes;
    std::vector<double> force, rate;  // of each push [N], [m/s]
    std::vector<ImpactSlip> slips;
  };
  /// The result of (I1) and (I2).
  struct Outcome {
    Pressed pressed;
    linalg::Vector impulses;  ///< of each push: per_force times its force
    linalg::Vector rates;     ///< after them
    double none = 0;          ///< rates up to this are rounding
  };
  Pressed gather(const std::vector<loads::RigidRow>& rows, const dynamics::SoftRows& soft,
                 const RigidRows& rigid) const;
  bool condense(const RigidInstant& now, const RigidRows& rigid);
  /// Whether any friction row of a place is in use.
  static bool rubs(const Place& place, const std::vector<loads::RowStand>& stands);
  Outcome solve(const RigidInstant& now, double per_force, double per_change,
                const RigidRows& rigid) const;
  static Now look(const Place& place, const std::vector<loads::RigidRow>& rows,
                  const std::vector<loads::RowStand>& stands);
  static bool holds(const Place& place, const Now& now, const std::vector<loads::RigidRow>& rows,
                    const std::vector<loads::RowStand>& stands);
  /// Whether a place sticks, given its friction force and its final speed.
  static bool sticks(const Place& place, double load, const linalg::Vector& along, double speed);
  bool put(const Place& place, const linalg::Vector& force, double speed, RigidRows& rigid) const;

  PushAnswers answers_;
  std::vector<Place> places_;
  std::vector<char> is_own_;
};

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/stepping/friction_impulses.h"
#include "buckens/stepping/push_answers.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::stepping {

/// Rigid contacts with friction in the iteration of a step: which places let go, stick or slide,
/// and which way, is decided for all of them together.
///
/// From the forces and rates that the iteration has come to, forces are found that satisfy (I1) and
/// (I2) with what the rates change by them; rows then stand accordingly. On its own, each
/// would know only its own force. Where more places hold than are needed, one of them may be given
/// more than its own cone admits, if all together hold within theirs. Theory:
/// docs/theory/25-contact.md §4.
class ContactCones {
 public:
  /// An instant of the iteration.
  struct Instant {
    const std::vector<loads::RigidRow>& rows;
    const dynamics::SoftRows& soft;
    const std::vector<dynamics::BodyCompliance>& compliance;  ///< of the bodies [m/N]
    const std::vector<dynamics::BodyMotion>& motions;
    const std::vector<int>& rows_in_use;
    const model::RowMemory* memory;
    double t;
  };

  explicit ContactCones(const model::Model& model);

  bool empty() const { return places_.empty(); }
  /// Whether a row of the state is one of those that are decided here, per rigid row.
  const std::vector<char>& rows() const { return is_own_; }
  /// Whether all places stand as their forces and rates ask. @param rows of the iteration
  /// What has pushed over the step and pulls at its end only stays, and does not rub there.
  bool hold(const std::vector<loads::RigidRow>& rows, const RigidRows& rigid) const;
  /// Decides anew. @param per_force,per_change of the equations:
  /// `compliance` times per_force is the displacement by a force, times per_change the change of
  /// the rate
  /// @return whether any row stands otherwise
  bool decide(const Instant& now, double per_force, double per_change, RigidRows& rigid);
  /// Opens the rows along of a place whose row across is open.
  void follow(int across, RigidRows& rigid) const;
  /// As decide(), for forces that are to act throughout a span of time, those across included: at
  /// its end (I1) and (I2) hold, places stand accordingly, and their rows have these forces. Such
  /// forces always exist, also where at the instant itself none do.
  /// @param now with the rates of the rows that the end of the span would have without forces
  void hold_over(const Instant& now, double span, RigidRows& rigid);

 private:
  /// One place: its row across and those along, which follow it.
  struct Place {
    const loads::ContactFriction* law;
    int across = 0;                        ///< rigid row
    int soft = 0;                          ///< the same among the soft rows
    int count = 1;                         ///< of directions
    loads::ContactFrictionData data = {};  ///< of the instant
  };
  /// What a place has in the iteration.
  struct Now {
    double load = 0;                                  ///< across [N]
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();   ///< [m/s]
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< along [N]
    bool is_pressed = false, sticks = false;
  };
  /// The places that press, with the rows along which they push: first all those across.
  struct Pressed {
    std::vector<const Place*> places;
    std::vector<Push> pushes;
    std::vector<double> force, rate;  // of each push [N], [m/s]
    std::vector<ImpactSlip> slips;
  };
  /// What (I1) and (I2) make of them.
  struct Outcome {
    Pressed pressed;
    linalg::Vector impulses;  ///< of each push: per_force times its force
    linalg::Vector rates;     ///< after them
    double none = 0;          ///< rates up to this are rounding
  };
  Pressed gather(const std::vector<loads::RigidRow>& rows, const dynamics::SoftRows& soft,
                 const RigidRows& rigid) const;
  bool condense(const Instant& now, const RigidRows& rigid);
  /// Whether any row along a place is in use.
  static bool rubs(const Place& place, const std::vector<loads::RowStand>& stands);
  Outcome solve(const Instant& now, double per_force, double per_change,
                const RigidRows& rigid) const;
  static Now look(const Place& place, const std::vector<loads::RigidRow>& rows,
                  const std::vector<loads::RowStand>& stands);
  static bool holds(const Place& place, const Now& now, const std::vector<loads::RigidRow>& rows,
                    const std::vector<loads::RowStand>& stands);
  /// Whether a place sticks, with this force along it and this speed in the end.
  static bool sticks(const Place& place, double load, const linalg::Vector& along, double speed);
  bool put(const Place& place, const linalg::Vector& force, double speed, RigidRows& rigid) const;

  PushAnswers answers_;
  std::vector<Place> places_;
  std::vector<char> is_own_;
};

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/model/build/rigid_pairs.h"
#include "buckens/model/spec/rest_friction.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// A row of a force law that holds rigidly at rest.
struct RestRow {
  enum class Kind {
    one_sided,  ///< an end of a rigid stop, rope, cam or contact: gap ≥ 0, it only pushes
    held,       ///< frozen friction in a joint, a brake
    along       ///< frozen friction of a contact along its surface, while it presses
  };
  /// Soft rows of each spot of an elastic contact with friction: across, then along.
  static constexpr int kOfSpot = 3;

  Kind kind = Kind::one_sided;
  std::size_t load = 0;   ///< index into Model::loads
  int part = 0;           ///< which of the soft rows of a law with several
  int across = -1;        ///< of `along`: the row that presses; −1 of elastic contacts
  int pair = -1;          ///< of elastic contacts of many bodies: which pair, −1 of all others
  bool is_angle = false;  ///< its coordinate, else a length
  double start = 0;       ///< of `held`: the value that it holds [m] or [rad]

  /// Friction of an elastic contact along its surface.
  bool is_elastic() const { return kind == Kind::along && across < 0; }
};

/// What frozen friction of an elastic contact holds with.
struct HeldContact {
  std::size_t load = 0;                 ///< index into Model::loads
  std::optional<model::NearPair> pair;  ///< of a contact of many bodies
  spatial::Wrench along;                ///< on its second marker
};

/// Which rows are closed, and their forces: RowStand::regime is the end of a one-sided row, 1 for
/// other closed rows, 0 if open; kLanding for a row along the surface of an elastic contact that
/// begins to press in a step. A row that has been opened keeps its force until the next step
/// removes it.
using RestStands = std::vector<loads::RowStand>;
inline constexpr int kLanding = 2;

/// How many of the rows belong to a pair of a rigid contact group. The rows of all near pairs
/// follow all others.
struct PairRows {
  model::NearPair pair;
  std::size_t count = 0;
  bool operator==(const PairRows&) const = default;
};
using RestOrder = std::vector<PairRows>;

/// The rows in one configuration.
struct RestValues {
  std::vector<dynamics::SystemRow> rows;  ///< derivatives
  std::vector<double> values;             ///< of the coordinates [m] or [rad]
  std::vector<spatial::Wrench> pushes;    ///< on the second marker per unit force of the row
  std::vector<loads::RigidLaw::Contact> contacts;  ///< of one-sided rows: the nearer end
  std::vector<char> presses;                       ///< of elastic contacts: whether the spot does
  std::vector<char> nears;  ///< of elastic contacts: whether the spot is open, but felt
};

/// All rows of force laws that hold a mechanism at rest. Theory: docs/theory/12-static-paths.md §5.
class RestRows {
 public:
  /// @param model must outlive this object
  /// @param state at the start: loads that are off have no rows, frozen friction holds it
  /// @param groups of this model, must outlive this object; null: it has no rigid contact groups
  RestRows(const model::Model& model, model::RestFriction friction, const model::State& state,
           model::RigidPairs* groups = nullptr);

  /// Gives rows to pairs of rigid contact groups that may meet during a motion.
  /// @param way the bodies at its start, with velocities that lead to its end within 1 s
  /// @param keeps other pairs keep their rows; otherwise they lose them
  /// @return whether rows have been added or removed; data per row must then be carried()
  bool follow_pairs(const std::vector<dynamics::BodyMotion>& way, bool keeps);
  /// Pairs that have rows, in their order.
  const RestOrder& order() const { return order_; }
  /// Position of each row when pairs had rows in this order; −1: it is new.
  std::vector<int> places_in(const RestOrder& then) const;
  /// Transfers earlier stands to the present rows. New rows are open.
  RestStands carried(const RestOrder& then, const RestStands& stands) const;

  const model::Model& model() const { return model_; }
  std::size_t size() const { return rows_.size(); }
  /// Whether the model has friction that is left out.
  bool leaves_friction() const { return leaves_friction_; }
  const RestRow& operator[](std::size_t k) const { return rows_[k]; }
  /// Its load, and of contacts among many bodies which two: for texts that quote it.
  std::string name(std::size_t k) const;
  /// @pre the row is that of an elastic pair of many bodies
  const model::NearPair& pair(std::size_t k) const {
    return pairs_[static_cast<std::size_t>(rows_[k].pair)];
  }

  void evaluate(const std::vector<dynamics::BodyMotion>& motions, double t, RestValues& out) const;
  /// Adds Jᵀf.
  void add_forces(const RestValues& values, const RestStands& stands, dynamics::Forces& out) const;
  /// Remaining gap of a closed row [m] or [rad].
  double gap(std::size_t k, const RestValues& values, int regime) const;
  /// Force that a one-sided row pushes with, whatever its end; negative: it would pull.
  double push(std::size_t k, const loads::RowStand& stand) const;
  /// Whether a one-sided row touches, or overlaps.
  bool touches(std::size_t k, const RestValues& values) const;

  /// Stands at the start: what touches is closed, what friction freezes is held.
  RestStands start(const RestValues& values) const;
  /// Closes what touches and removes all forces, so that rows that share a load share it as evenly
  /// as possible, whatever the way to this configuration.
  void share(const RestValues& values, RestStands& stands) const;
  /// Friction along a surface holds while the normal row is closed and touched before the step; for
  /// elastic contacts, where they overlap.
  void follow_contacts(const RestValues& values, RestStands& stands) const;
  /// Ends what holds because it lands: at the beginning of a step.
  void end_landings(RestStands& stands) const;
  /// What frozen friction of elastic contacts holds with; those without force are left out.
  std::vector<HeldContact> held_contacts(const RestValues& values, const RestStands& stands) const;
  /// Opens what is closed without a noticeable force.
  void open_unloaded(double force, RestStands& stands) const;
  /// Largest gap below zero of open rows, as a share of the model's length or of 1 rad.
  double deepest(const RestValues& values, const RestStands& stands) const;
  /// Largest force with which a closed one-sided row pulls [N].
  double strongest_pull(const RestStands& stands) const;
  /// Largest force, torques divided by the model's length [N].
  double strongest(const RestStands& stands) const;

  /// One entry per load, for the memory of a state: of laws with several rows the size of what they
  /// push with. @see model::RowMemory::at_rest
  RestStands of_loads(const RestValues& values, const RestStands& stands) const;
  /// Names of loads that touch without pressing anywhere, quoted; empty if there are none.
  std::string unloaded(const RestValues& values, const RestStands& stands, double force) const;
  /// Warnings about what overlaps by more than a thousandth of the model's length.
  std::vector<std::string> overlaps(const RestValues& values) const;

 private:
  void add_friction(const model::State& state, std::size_t load);
  /// Rows of Model::pair_loads.
  void add_rigid_pairs();
  bool is_off(const model::NearPair& pair) const;
  /// All pairs that may touch; which of them do is known at the end.
  void add_pairs(std::size_t load);
  void evaluate_pair(std::size_t k, const std::vector<dynamics::BodyMotion>& motions, double t,
                     std::vector<loads::SoftRow>& soft, RestValues& out) const;
  /// Rows of the law of row k in `soft`; those along faces of an elastic contact are in one plane.
  void find_soft_rows(std::size_t k, const loads::ForceElement& law, const loads::Sight& sight,
                      std::vector<loads::SoftRow>& soft, RestValues& out) const;
  double length_of(std::size_t k) const { return rows_[k].is_angle ? 1.0 : model_.length; }

  const model::Model& model_;
  model::RestFriction friction_;
  model::RigidPairs* groups_;
  model::RowMemory switched_;  // what is off
  std::vector<RestRow> rows_;
  std::size_t num_lasting_ = 0;  // rows of other loads than those of rigid pairs
  RestOrder order_;
  std::vector<model::NearPair> pairs_;
  bool leaves_friction_ = false;
};

}  // namespace buckens::analysis

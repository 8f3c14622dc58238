// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/stepping/blow_islands.h"
#include "buckens/stepping/body_answer.h"
#include "buckens/stepping/body_step.h"
#include "buckens/stepping/push_answers.h"
#include "buckens/stepping/step_settings.h"
#include "buckens/stepping/stop_clearance.h"

namespace buckens::stepping {

/// Effect of impacts on one body.
struct BodyJump {
  Vector6 velocity = Vector6::Zero();  ///< of the frame: body axes [rad/s], world axes [m/s]
  Vector6 shift = Vector6::Zero();     ///< of the frame over the rest of the step [rad], [m]
  Eigen::VectorXd impulse;             ///< on interface rows [N s], [N m s]
  Eigen::VectorXd impulse_time;        ///< the same, times the rest of the step
  double since = 0;                    ///< from the instant of the impulses to the end of step [s]
};

/// Impacts at the end of a smooth step: coordinates that have run into a rigid stop leave it again.
///
/// The instant of an impact is found on the cubic of coordinate and rate over the step. Impulses P
/// of all stops that are reached act together, and joints take part with impulses of their own.
/// Impacts that reach no common body are independent, each at its own instant:
///
///     J M⁻¹Jᵀ P ≥ b,   P ≥ 0,   one of both an equality;   b = (1 + e) times the speed of approach
///
/// Velocities jump, positions move on with the new velocities for the rest of the step, and the
/// accelerations that the method carries are not affected (Brüls, Acary, Cardona, 2014). For frames
/// M is their mass, for meshes the step matrix: they respond to an impulse with k₀ Y K̂⁻¹Nᵀ, as the
/// method would. Friction of contacts takes part (stepping/friction_impulses.h).
/// Theory: docs/theory/23-impacts.md.
class Impacts {
 public:
  Impacts(const model::Model& model, const Scheme& scheme, std::vector<const BodyAnswer*> answers);

  /// k₀ N Y K̂⁻¹Nᵀ: jump of the interface rates per impulse; empty if a mesh does not move by
  /// itself. @param answer of the body; null: rigid
  static linalg::Matrix impulse_compliance(const Scheme& scheme, const BodyAnswer* answer);

  /// False for models in which nothing can strike.
  bool can_happen() const { return !laws_.empty(); }
  /// Notes where the coordinates are at the start of a step.
  void start(const std::vector<dynamics::BodyMotion>& motions, double t,
             const model::RowMemory& memory);

  /// Looks for impacts in the step that ended with `motions`, and finds their effect.
  /// @param bodies of the step, @param rows_in_use independent joint rows
  /// @return whether there are any
  bool find(const std::vector<dynamics::BodyMotion>& motions, const std::vector<BodyStep>& bodies,
            const std::vector<int>& rows_in_use, const dynamics::Circumstances& around, double t);

  const std::vector<BodyJump>& jumps() const { return jumps_; }
  /// Stands of the laws afterwards; laws that are not listed keep theirs.
  struct Landing {
    int rigid_row;
    int regime;
  };
  const std::vector<Landing>& landings() const { return landings_; }
  /// Whether impacts involve a mesh, and all bodies that struck one stay there: the loss of all
  /// impacts is then the energy that the jumps take.
  bool stay_on_meshes() const;
  /// Divides the loss of all impacts among them [J]; a gain is left to the energy balance.
  void lose_in_all(double energy);
  /// Energy lost in the impacts found last [J]; count() is their number.
  double loss() const { return loss_; }
  /// Share of each law in this loss.
  const std::vector<ImpactShare>& shares() const { return shares_; }
  int count() const { return count_; }
  /// Number of those that should have rebounded but were stopped, because friction jams.
  int jammed() const { return jammed_; }
  /// Whether some of the impulses are those of ConeEnd::near.
  bool are_near() const { return are_near_; }
  /// Time from their mean instant, weighted by their strength, to the end of the step [s].
  double rest() const { return rest_; }

 private:
  /// Friction of a law that can strike, along one direction.
  struct Friction {
    std::size_t load;
    const loads::ContactFriction* law;
  };
  /// A law that can strike, with its coordinate at the start of the step.
  struct Law {
    std::size_t load;
    const loads::RigidLaw* law;
    loads::CoordinateMotion start{};
    std::vector<Friction> frictions;
    bool bounces = true;  // false: in this step friction holds what restitution would separate
  };
  /// A stop that is reached.
  struct Touch : Push {
    std::size_t law;        ///< index into laws_
    int regime;             ///< of the end that is touched
    double approach = 0;    ///< speed against it before the impact [m/s] or [rad/s]
    double met = 0;         ///< rate away from the end to which the jump is added, for the loss
    double gap = 0;         ///< at the end of the step, without the impact [m] or [rad]
    double target = 0;      ///< required jump of the rate away from the end
    double rest = 0;        ///< time for which positions move on after the impact [s]
    double since = 0;       ///< time from the impact to the end of the step [s]
    double lost_share = 1;  ///< of the energy of `approach`, that the impact itself had
    bool strikes = false;   ///< arrives in this step, in contrast to what touches already
    /// Time from the instant at which its row is taken to the end of the step [s].
    double from = 0;
    bool stays = false;       ///< is not left again
    bool is_of_step = false;  ///< its impulse acts throughout the step, as meshes need it
    /// At the impact its row is that of another contact point, to which the required rate does not
    /// belong: the row at the end of the step acts.
    bool is_elsewhere = false;
    /// Impulses cancel each other: only the sum of all losses is a loss.
    bool is_wedged = false;
    double rate = 0;  ///< away from the end, at the end of the step
    double sign = 1;  ///< of the coordinate, away from the end
  };
  /// Slip of a stop that is reached, along one direction.
  struct Slip : Push {
    /// Fraction of a slip below which what remains of it is rounding.
    static constexpr double kStopped = 1e-9;
    std::size_t touch;     ///< index into touches_
    std::size_t friction;  ///< index into Law::frictions
    double speed = 0;      ///< on which friction acts: at the impact, or at the end of the step
    double at_impact = 0;  ///< [m/s]
  };

  bool look(std::size_t law, const dynamics::Circumstances& around,
            const std::vector<dynamics::BodyMotion>& motions, double t);
  /// Finds which touches act together, and drops those that no impact reaches.
  void find_islands();
  std::size_t island_of(const Touch& touch) const;
  const Touch& strongest_near(const Touch& touch) const {
    return touches_[strongest_[island_of(touch)]];
  }
  /// Time from the instant of an impact to the end of the step [s].
  static double since(const Touch& touch);
  /// Pairs of bodies that no joint holds get the instant of their own strongest impact, whatever
  /// else reaches them; others get that of their island.
  void find_instants();
  using MotionPair = std::array<dynamics::BodyMotion, 2>;
  /// Bodies of a touch whose motions in at_impact() are not those at its own instant. @return
  /// number
  std::size_t find_moved(const Touch& touch, std::array<std::size_t, 2>& moved) const;
  /// Moves the bodies of a touch to the instant at which its row is taken. @param then at_impact()
  void go_to_instant(const Touch& touch, const std::vector<dynamics::BodyMotion>& motions,
                     std::vector<dynamics::BodyMotion>& then, MotionPair& kept) const;
  /// Moves them back. @param kept as go_to_instant() has written it
  void leave_instant(const Touch& touch, std::vector<dynamics::BodyMotion>& then,
                     MotionPair& kept) const;
  /// Motions of the bodies at the strongest of the impacts that reach them.
  std::vector<dynamics::BodyMotion> at_impact(std::vector<dynamics::BodyMotion> motions);
  void set_row(std::size_t load, double sign, const std::vector<dynamics::BodyMotion>& motions,
               const model::RowMemory* memory, Push& push) const;
  void add_slips(std::size_t touch, const std::vector<dynamics::BodyMotion>& then,
                 const model::RowMemory* memory);
  const Friction& friction_of(const Slip& slip) const {
    return laws_[touches_[slip.touch].law].frictions[slip.friction];
  }
  /// The pushes in the order of the impulses: stops, then slips.
  const Push& push(std::size_t row) const {
    return row < touches_.size() ? static_cast<const Push&>(touches_[row])
                                 : slips_[row - touches_.size()];
  }
  std::size_t num_pushes() const { return touches_.size() + slips_.size(); }
  /// Responses along the rows of all pushes to each of them.
  linalg::SparseMatrix answers() const;
  /// Finds impulses and their effect. @return false if friction jams: the impacts have to be found
  /// again without the restitution that friction does not admit
  bool strike(const std::vector<dynamics::BodyMotion>& then, const std::vector<int>& rows_in_use,
              const model::RowMemory* memory, double t);
  /// @param jammed see solve_impact()
  linalg::Vector solve(const linalg::SparseMatrix& D, std::vector<Eigen::Index>* jammed);
  /// Takes restitution from these rows. @return whether any of them would have bounced
  bool stop_bouncing(const std::vector<Eigen::Index>& rows);
  double restitution(const Law& law, double approach) const;
  /// @param rests it does not rebound
  void set_approach(Touch& touch, const Law& law, bool rests, const loads::CoordinateMotion& end,
                    double sign, double gap) const;
  /// For a touch at another contact point: takes its row and speed at the end of the step.
  void take_row_of_end(Touch& touch, const std::vector<dynamics::BodyMotion>& end,
                       const model::RowMemory* memory);
  /// If a mesh is involved, an impulse with restitution is one of the step as a whole, (I4).
  /// @param e restitution, @param rate_start away from the end, negative
  void make_impulse_of_step(Touch& touch, double e, double rate_start) const;
  /// Whether a mesh is involved in the impacts of a law.
  bool moves_mesh(const Law& law) const;
  void condense(const std::vector<dynamics::BodyMotion>& motions,
                const std::vector<BodyStep>& bodies, const std::vector<int>& rows_in_use,
                const dynamics::Circumstances& around, double t);
  /// Rows of laws that no impulse moves, which hold as joints do.
  void find_holding(const std::vector<dynamics::BodyMotion>& motions,
                    const dynamics::Circumstances& around, double t);
  /// Impulses may cancel each other, as between balls that are wedged. If they would move a body
  /// much further than anything moves in a step, separate instants correspond to no real motion:
  /// all touches of such an island go on from the instant of its strongest impact. Islands with
  /// meshes are excepted.
  void share_instants(const linalg::Vector& P);
  void move_bodies(const linalg::Vector& P);
  /// Takes bodies out of ends that they would still be in after impulses of the step.
  void clear_ends(const linalg::Vector& P, const std::vector<dynamics::BodyMotion>& then,
                  const std::vector<int>& rows_in_use, const model::RowMemory* memory, double t);
  void land(const linalg::Vector& P, const linalg::Vector& jump);
  static double rate_of(const dynamics::SystemRow& row,
                        const std::vector<dynamics::BodyMotion>& motions);
  /// Speed that weight takes back within a step [m/s]. Leaving more slowly than that does not count
  /// as leaving; otherwise, bodies at rest would go on rocking by it for ever.
  double weight_returns(const Touch& touch) const;
  /// Energy lost by all pushes, (I5): impulse times mean of the rates before and after, at the
  /// instant from which the impulse moves the bodies.
  /// @param end motions with the velocities of the end of the step
  void lose(const linalg::Vector& P, const linalg::Vector& jump,
            const std::vector<dynamics::BodyMotion>& end);
  void lose(std::size_t load, double energy);
  /// Rows of islands whose impulses give the bodies more energy than they take, (I7): wedges that
  /// amplify restitution. @param end as for lose()
  std::vector<Eigen::Index> gaining(const linalg::Vector& P, const linalg::Vector& jump,
                                    const std::vector<dynamics::BodyMotion>& end) const;
  /// Loss of one touch or slip if meshes are involved, from rates alone.
  double loss_on_mesh(const Touch& touch, double P, double jump) const;
  double loss_of_slip(const Slip& slip, double P, double jump) const;
  void land_slips(std::size_t touch, bool is_held, const linalg::Vector& jump);

  const model::Model& model_;
  Scheme scheme_;
  std::span<const double> signals_;  // of the step looked at last
  std::vector<const BodyAnswer*> answers_;
  std::vector<Law> laws_;
  std::vector<std::size_t> holds_;            // loads whose rigid row never strikes
  std::vector<dynamics::SystemRow> holding_;  // of those that no impulse moves
  bool is_rough_ = false;                     // any of them has friction
  std::vector<dynamics::BodyMotion> start_;   // of the step
  std::vector<Touch> touches_;
  std::vector<Slip> slips_;
  BlowIslands islands_;
  std::vector<std::size_t> strongest_;  // of the touches of each island, by the body it is named by
  std::vector<linalg::Matrix> interface_;  // k₀ N Y K̂⁻¹Nᵀ
  std::vector<char> with_mesh_;            // per body: it is a mesh, or joints connect it with one
  std::vector<char> is_free_;              // per body: no joint moves it
  std::vector<dynamics::BodyCompliance> compliance_;
  PushAnswers answers_to_;
  StopClearance clearance_;
  std::vector<BodyJump> jumps_;
  std::vector<Landing> landings_;
  std::vector<ImpactShare> shares_;
  double length_ = 0;  // of positions in the step looked at last [m]
  double loss_ = 0, rest_ = 0;
  int count_ = 0, jammed_ = 0;
  bool are_near_ = false;
};

}  // namespace buckens::stepping

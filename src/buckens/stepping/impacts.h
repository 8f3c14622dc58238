// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// What impacts do to one body.
struct BodyJump {
  Vector6 velocity = Vector6::Zero();  ///< of the frame: body axes [rad/s], world axes [m/s]
  Vector6 shift = Vector6::Zero();     ///< of the frame by the rest of the step [rad], [m]
  Eigen::VectorXd impulse;             ///< on interface rows [N s], [N m s]
  Eigen::VectorXd impulse_time;        ///< the same times the rest of the step
  double since = 0;                    ///< from where impulses act on it to the end of the step [s]
};

/// Impacts at the end of a smooth step: coordinates that have run into a rigid stop leave it again.
///
/// The instant of an impact is found on the cubic of coordinate and rate over the step. Impulses P
/// of all stops that are reached act together, and joints take part with their own; blows that
/// reach no common body are apart, each at its own instant:
///
///     J M⁻¹Jᵀ P ≥ b,   P ≥ 0,   one of both an equality;   b = (1 + e) times the speed of approach
///
/// Velocities jump, positions move on with the new velocities for the rest of the step, and
/// accelerations carried on by the method see nothing of it (Brüls, Acary, Cardona, 2014). Of
/// frames M is their mass, of meshes the step matrix: k₀ Y K̂⁻¹Nᵀ answers an impulse as the method
/// would. Friction of contacts takes part (stepping/friction_impulses.h).
/// Theory: docs/theory/23-impacts.md.
class Impacts {
 public:
  Impacts(const model::Model& model, const Scheme& scheme, std::vector<const BodyAnswer*> answers);

  /// k₀ N Y K̂⁻¹Nᵀ: jump of the interface rates per impulse; empty where a mesh does not deform by
  /// itself. @param answer of the body; null: rigid
  static linalg::Matrix impulse_compliance(const Scheme& scheme, const BodyAnswer* answer);

  /// False for models without anything that strikes.
  bool can_happen() const { return !laws_.empty(); }
  /// Notes where the coordinates are at the start of a step.
  void start(const std::vector<dynamics::BodyMotion>& motions, double t,
             const model::RowMemory& memory);

  /// Looks for impacts in the step that ended with `motions`, and finds what they do.
  /// @param bodies of the step, @param rows_in_use independent joint rows
  /// @return whether there are any
  bool find(const std::vector<dynamics::BodyMotion>& motions, const std::vector<BodyStep>& bodies,
            const std::vector<int>& rows_in_use, const dynamics::Circumstances& around, double t);

  const std::vector<BodyJump>& jumps() const { return jumps_; }
  /// How the laws stand afterwards; those not named keep their stand.
  struct Landing {
    int rigid_row;
    int regime;
  };
  const std::vector<Landing>& landings() const { return landings_; }
  /// Whether something strikes with a mesh and stays there, and nothing leaves one again: then
  /// what all lose is the energy that the jumps take.
  bool stay_on_meshes() const;
  /// Shares out what all of them lose [J]; a gain is left to the balance.
  void lose_in_all(double energy);
  /// Energy lost in the impacts found last [J], and their number.
  double loss() const { return loss_; }
  /// What of it each of the laws lost.
  const std::vector<ImpactShare>& shares() const { return shares_; }
  int count() const { return count_; }
  /// Of them, those that should have rebounded, and were stopped since friction jams.
  int jammed() const { return jammed_; }
  /// Whether some of the impulses are those of ConeEnd::near.
  bool are_near() const { return are_near_; }
  /// From their mean instant, weighted by their strength, to the end of the step [s].
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
    bool bounces = true;  // friction does not hold what restitution would part in this step
  };
  /// A stop that is reached.
  struct Touch : Push {
    std::size_t law;        ///< index into laws_
    int regime;             ///< of the end that is touched
    double approach = 0;    ///< speed against it before the impact [m/s] or [rad/s]
    double met = 0;         ///< rate away from the end to which the jump is added, for the loss
    double gap = 0;         ///< at the end of the step, without the impact [m] or [rad]
    double target = 0;      ///< jump of the rate away from the end that it asks for
    double rest = 0;        ///< what is left of the step after the impact, for positions [s]
    double since = 0;       ///< what is left of it [s]
    double lost_share = 1;  ///< of the energy of `approach`, that the impact itself had
    bool strikes = false;   ///< comes in this step, in contrast to what touches already
    /// From where its row is taken to the end of the step [s].
    double from = 0;
    bool stays = false;       ///< is not left again
    bool is_of_step = false;  ///< its impulse acts throughout the step, as meshes need it
    /// At the impact its row is that of another place, to which the rate asked for does not belong:
    /// the one at the end of the step acts.
    bool is_elsewhere = false;
    /// Impulses cancel each other: only all of them together say what is lost.
    bool is_wedged = false;
    double rate = 0;  ///< away from the end, at the end of the step
    double sign = 1;  ///< of the coordinate, away from the end
  };
  /// Slip of a stop that is reached, along one direction.
  struct Slip : Push {
    /// Share of a slip below which what is left of it is rounding.
    static constexpr double kStopped = 1e-9;
    std::size_t touch;     ///< index into touches_
    std::size_t friction;  ///< index into Law::frictions
    double speed = 0;      ///< that friction acts on: at the impact, or at the end of the step
    double at_impact = 0;  ///< [m/s]
  };

  bool look(std::size_t law, const dynamics::Circumstances& around,
            const std::vector<dynamics::BodyMotion>& motions, double t);
  /// Finds which touches act together, and leaves out what no blow reaches.
  void find_islands();
  std::size_t island_of(const Touch& touch) const;
  const Touch& strongest_near(const Touch& touch) const {
    return touches_[strongest_[island_of(touch)]];
  }
  /// From where impulses of a blow act to the end of the step [s].
  static double since(const Touch& touch);
  /// Pairs of bodies that no joint holds have the instant of their own strongest blow, whatever
  /// else reaches them; others that of their island.
  void find_instants();
  /// Calls f with the motions in which a touch has its row. @param then at_impact(), changed and
  /// restored
  template <class F>
  void at_own_instant(const Touch& touch, const std::vector<dynamics::BodyMotion>& motions,
                      std::vector<dynamics::BodyMotion>& then, F&& f);
  /// Where the bodies were at the strongest of the impacts that reach them.
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
  /// What each push does along the rows of all.
  linalg::SparseMatrix answers() const;
  /// Finds impulses and what they do. @return false where friction jams: to be looked for again
  /// without the restitution that it does not admit
  bool strike(const std::vector<dynamics::BodyMotion>& then, const std::vector<int>& rows_in_use,
              const model::RowMemory* memory, double t);
  /// @param jammed see solve_impact()
  linalg::Vector solve(const linalg::SparseMatrix& D, std::vector<Eigen::Index>* jammed);
  /// @return whether any of them would have bounced
  bool stop_bouncing(const std::vector<Eigen::Index>& rows);
  double restitution(const Law& law, double approach) const;
  void set_approach(Touch& touch, const Law& law, const loads::CoordinateMotion& end, double sign,
                    double gap) const;
  /// For a touch that is elsewhere at its impact: its row, and its speed, at the end of the step.
  void take_row_of_end(Touch& touch, const std::vector<dynamics::BodyMotion>& end,
                       const model::RowMemory* memory);
  /// Where a mesh takes part, the impulse of what leaves again belongs to the step as a whole.
  /// @param e restitution, @param rate_start away from the end, negative
  void make_impulse_of_step(Touch& touch, double e, double rate_start) const;
  /// Whether a mesh takes part in what a law strikes.
  bool moves_mesh(const Law& law) const;
  void condense(const std::vector<dynamics::BodyMotion>& motions,
                const std::vector<BodyStep>& bodies, const std::vector<int>& rows_in_use,
                const model::RowMemory* memory, double t);
  /// Where impulses cancel each other, as those of balls that wedge each other may, to more than
  /// what strikes brings with it, their differences of instants do not belong to motions: these
  /// islands go on from the instant of their strongest blow.
  void share_instants(const linalg::Vector& P);
  void move_bodies(const linalg::Vector& P);
  /// Takes bodies out of ends into which impulses of the step would still let them go.
  void clear_ends(const linalg::Vector& P, const std::vector<dynamics::BodyMotion>& then,
                  const std::vector<int>& rows_in_use, const model::RowMemory* memory, double t);
  void land(const linalg::Vector& P, const linalg::Vector& jump);
  static double rate_of(const dynamics::SystemRow& row,
                        const std::vector<dynamics::BodyMotion>& motions);
  /// Speed up to which weight brings back what leaves within a step [m/s]: it does not count as
  /// leaving, or what has come to rest would rock on by it for ever.
  double weight_returns(const Touch& touch) const;
  /// Energy lost by all pushes: each has the mean of its rates before and after, which are those at
  /// the instant from which on its impulse moves the bodies.
  /// @param end motions with the velocities of the end of the step
  void lose(const linalg::Vector& P, const linalg::Vector& jump,
            const std::vector<dynamics::BodyMotion>& end);
  void lose(std::size_t load, double energy);
  /// Rows of the stops that reach each other by impulses that give bodies more than they take from
  /// them: restitution that wedges drive up. @param end as for lose()
  std::vector<Eigen::Index> gaining(const linalg::Vector& P, const linalg::Vector& jump,
                                    const std::vector<dynamics::BodyMotion>& end) const;
  /// The same of one touch and one slip where meshes take part, from rates alone.
  double loss_on_mesh(const Touch& touch, double P, double jump) const;
  double loss_of_slip(const Slip& slip, double P, double jump) const;
  void land_slips(std::size_t touch, bool is_held, const linalg::Vector& jump);

  const model::Model& model_;
  Scheme scheme_;
  std::span<const double> signals_;  // of the step looked at last
  std::vector<const BodyAnswer*> answers_;
  std::vector<Law> laws_;
  bool is_rough_ = false;                    // any of them has friction
  std::vector<dynamics::BodyMotion> start_;  // of the step
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

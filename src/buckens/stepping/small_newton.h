// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/joint_set.h"
#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/dynamics/reaction_slopes.h"
#include "buckens/stepping/ball_cones.h"
#include "buckens/stepping/body_iteration.h"
#include "buckens/stepping/contact_cones.h"
#include "buckens/stepping/held_laws.h"
#include "buckens/stepping/iteration_end.h"
#include "buckens/stepping/rigid_rows.h"
#include "buckens/stepping/row_watch.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// The iteration of one step in frame coordinates, interface values and multipliers only.
///
/// Flexible bodies enter by their interface compliance, FM (42); no n-sized vector is touched.
/// Position and velocity rows of the joints are closed together: the multipliers λ close the
/// velocities, FM (34), (43), a correction q ← q + W⁻¹Gᵀη without velocity closes the positions
/// (stabilised index 2).
///
/// Directions of the correction and the matrix of the iteration are those at the predicted
/// configuration. Residuals are exact, so the result does not depend on the approximation. After
/// the first step nothing is allocated unless the rows in use change.
class SmallNewton {
 public:
  /// @param rows_in_use independent rows of λ; the others follow from them and remain zero
  SmallNewton(const model::Model& model, const Scheme& scheme, const StepSettings& settings,
              std::vector<const BodyAnswer*> answers, std::vector<int> rows_in_use);

  /// What force laws may use in the next step; must outlive it. λ is read as it is iterated.
  /// Rigid rows begin with the stands in its memory.
  void use(const dynamics::Circumstances& around);
  /// The same, with the stands of rigid rows as iterated.
  const dynamics::Circumstances& around() const { return around_; }
  /// Whether the stand of any rigid row differs from that at the start of the step.
  bool rigid_rows_changed() const { return rigid_.have_changed(); }
  /// See RigidRows::ends_have_turned().
  bool ends_have_turned() const { return rigid_.ends_have_turned(); }
  /// Whether rigid rows that have moved too often in a step keep their last stands instead of
  /// failing: near its limit, rounding decides whether a set admits a force.
  void accept_last_stands(bool accepts) { accepts_last_stands_ = accepts; }
  /// Whether it has done so in this step.
  bool has_accepted_stands() const { return has_accepted_stands_; }
  /// Whether the stands of rigid contacts with friction are decided before the first iteration of a
  /// step: iterations that begin with the stands of the previous step may diverge.
  void decide_first(bool decides) { decides_first_ = decides; }
  bool has_rough_contacts() const { return !cones_.empty(); }
  /// Condenses the joints at the predicted configuration held in `bodies`.
  /// @throws NumericalError naming joints if their equations have become dependent
  /// @param begins_here whether the iteration begins at that configuration, with λ as it is now
  void prepare(std::vector<BodyStep>& bodies, double t, bool begins_here);

  /// Iterates until the motion stops changing.
  /// @param lambda first guess and result [N, N m]
  /// @param goes_on whether iterate_on() is expected to follow: it may leave to it what is small
  /// @throws NumericalError naming the joint that resists, if it does not converge
  void iterate(std::vector<BodyStep>& bodies, double t, linalg::Vector& lambda, StepReport& report,
               bool goes_on = false);
  /// Whether it has, so that iterate_on() must follow.
  bool has_left_open() const { return has_left_open_; }
  /// Continues from where iterate() ended in this step, after free responses or moments of `bodies`
  /// changed. A change too small to move anything takes no iteration.
  void iterate_on(std::vector<BodyStep>& bodies, double t, linalg::Vector& lambda,
                  StepReport& report);

  /// Forces at the evaluation instant of the last iteration.
  const dynamics::Forces& forces() const { return forces_; }
  const std::vector<dynamics::BodyMotion>& motions_at_end() const { return end_; }
  /// Motions at the instant at which the equations hold.
  const std::vector<dynamics::BodyMotion>& at_evaluation() const {
    return scheme_.weight == 1.0 ? end_ : evaluation_;
  }
  const std::vector<int>& rows_in_use() const { return rows_in_use_; }
  /// What laws on joints remember if the step ends here; null: not known.
  const dynamics::LawEnds* law_ends() const { return scheme_.weight == 1.0 ? &law_ends_ : nullptr; }
  /// How often the rows in use were changed because pivots dropped or a row opened.
  int num_selections() const { return num_selections_; }

  /// Saves or restores what later steps depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  using Change = IterationEnd::Change;
  void find_motions(const std::vector<BodyStep>& bodies);
  /// The rest of evaluate(). @param soft null, or to be filled with the rows of laws on joints
  void evaluate_motions(std::vector<BodyStep>& bodies, double t, const linalg::Vector& lambda,
                        std::vector<dynamics::ReactionSlope>* slopes,
                        std::vector<dynamics::SoftRows>* soft);
  /// Those of all laws at the predicted configuration.
  void find_soft_rows(std::vector<BodyStep>& bodies, double t, bool begins_here);
  /// @param slopes null, or to be filled with those of laws on joints
  void evaluate(std::vector<BodyStep>& bodies, double t, const linalg::Vector& lambda,
                std::vector<dynamics::ReactionSlope>* slopes = nullptr);
  /// Tells drives by signals where they are to be at the end of the step.
  void steer(double t);
  /// @return size of the residual of the bodies' equations of motion [m]
  double find_residuals(const std::vector<BodyStep>& bodies);
  /// Whether what the residuals leave to be moved is negligible, so that no iteration is needed to
  /// tell. @param open of find_residuals() [m], @param motion of the step [m]
  bool is_balanced(double open, double motion) const;
  /// One iteration from the results of evaluate() and find_residuals().
  Change move(std::vector<BodyStep>& bodies, double t, linalg::Vector& lambda, StepReport& report);
  /// Evaluates and moves until converged. @param change of the previous iteration, if any
  void settle(std::vector<BodyStep>& bodies, double t, linalg::Vector& lambda, Change change,
              StepReport& report);
  /// What corrections have to close of the rows with positions.
  void find_open_positions();
  void solve_correction(const std::vector<BodyStep>& bodies, double t);
  /// Largest motion of a frame by correction_ [m].
  double size_of_correction(const std::vector<BodyStep>& bodies) const;
  /// Finds the correction where places stick. If they stick in a ring, as between wedged balls, the
  /// only way to close a gap of micrometres may be to roll far, which opens more than it closes:
  /// places then slide during corrections, (I10). @return false if none sticks
  bool correct_by_sliding(const std::vector<BodyStep>& bodies, double t);
  /// The rows of corrections without those that hold rates only. Null: they are dependent
  std::unique_ptr<dynamics::MultiplierCondensation> condense_without_sticking(double t);
  void solve_multipliers(double t);
  Change update(std::vector<BodyStep>& bodies, linalg::Vector& lambda);
  /// Replaces ġ by that without position corrections and with shapes as at the start of the step: a
  /// changing quasi-static shape must not jolt the mechanism, Δλ ~ m w Δy/h.
  void keep_shapes_in_rates(const std::vector<BodyStep>& bodies, double t_end);
  /// A joint row for closing velocities: excludes deformation without rates.
  const dynamics::SystemRow& without_rates(const dynamics::SystemRow& row) const {
    return with_shapes(row, 0.0);
  }
  /// A row that a share of such deformation moves: that of the spring in a spring with damper.
  /// Good until the next call.
  const dynamics::SystemRow& with_shapes(const dynamics::SystemRow& row, double share) const;
  bool corrects_positions() const;
  /// Bodies and marker rows of everything to be condensed: rows in use, then the soft ones.
  std::vector<dynamics::SystemRow> row_pattern(double t);
  void number_rows_in_use();
  /// Passes the derivatives at this configuration to the condensation, soft rows last.
  void set_joint_rows(double t);
  /// With these stiffnesses and dampings of rows that are not closed.
  void set_soft_rows(const std::vector<double>& stiffness, const std::vector<double>& damping);
  /// Place of what a slope is by among the condensed rows, −1: it is not there.
  int place_of(const dynamics::ReactionSlope& slope) const;
  /// Passes on how friction grows with multipliers, after the soft rows.
  void set_slopes();
  /// And how soft rows of one element act together.
  void add_slopes_of_mixes();
  /// @param soft the row whose force grows, @param place of what it grows with
  void add_slope(int soft, int place, double value);
  /// Passes them on once more, as they are after the first iteration: slopes by multipliers of the
  /// last step are wrong by the angle by which reactions have turned since. @return whether it did
  bool renew_slopes();
  /// Corrections of positions are those of the soft rows as they are now.
  void keep_for_corrections();
  /// The rigid row at a place among the soft ones if it is closed, else null.
  const loads::RigidRow* closed_row(std::size_t soft) const;
  /// Moves rigid rows to where their sets put them, once all else is settled. @return whether any
  bool move_rigid_rows(double t, const StepReport& report);
  /// Decides the stands of rigid contacts with friction. @return whether any has changed
  bool decide_cones(double t, const StepReport& report);
  /// The same of balls that stick rigidly. @param is_settled whether all else has settled
  bool decide_balls(double t, const StepReport& report, bool is_settled);
  /// Whether rigid rows may move on in this step.
  /// @throws StepFailure if they have moved too often, unless the last stands are accepted
  bool may_move(double t, const StepReport& report);
  /// Whether the iteration has gone on for so long that friction may alternate.
  bool is_restless(int iterations) const {
    constexpr int kRestless = 10;
    return !(cones_.empty() && balls_.empty()) && iterations % kRestless == 0;
  }
  /// Lets a contact go whose place alternates between two positions, so that its gap does not
  /// close; the contact there is found at the end of the step. @param change of the last iteration
  /// @return whether there is any
  bool let_jumping_go(double change);
  /// Forms the matrix of multipliers again if a force law has changed its regime since. @return
  /// false if so
  bool regimes_hold(std::vector<BodyStep>& bodies, double t, const StepReport& report);
  void form_tangent_anew(std::vector<BodyStep>& bodies, double t, const StepReport& report);
  TurningBalls::Sliding look_at_balls(double t) const;
  /// That matrix, from the soft rows as they are now. Position corrections weigh soft rows and
  /// belong to one matrix, that of the predicted motion, so that they do not depend on the way of
  /// the iteration. Where rigid rows have moved they begin anew. @return false if it is singular
  bool form_tangent(std::vector<BodyStep>& bodies, bool rigid_rows_moved);
  /// Assembles and factorises S for the rows in use. @return false if it is singular
  bool condense(double t);
  /// Determines again which rows are independent.
  /// @param may_give_up whether fewer rows may be used
  /// @return true if the rows in use have changed
  bool select_rows_anew(double t, bool may_give_up);
  /// Determines them again where joints have let go since.
  void follow_released(double t);
  /// Begins with a new condensation where others of many bodies are near each other.
  void follow_near();
  /// Multipliers of dropped rows are zero.
  void leave_to_rows_in_use(linalg::Vector& lambda) const;
  /// Reports the residuals of rows, and notes a row not in use that no longer follows from the
  /// others. Costs one pass over the rows per step.
  /// @throws StepFailure naming the joints, if the residual of such a row spoils the motion
  void watch_rows(double t, StepReport& report);
  [[noreturn]] void fail(double t, const StepReport& report, const char* what) const;

  const model::Model& model_;
  Scheme scheme_;
  StepSettings settings_;
  std::vector<const BodyAnswer*> answers_;
  std::vector<int> rows_in_use_;
  std::vector<int> dependent_;  // at the last selection
  bool gave_up_rows_ = false;   // fewer rows in use than elsewhere: a dead centre was hit
  std::vector<char> released_;  // joints that have let go, when rows were last selected for them
  double trusted_pivots_ = 0;   // largest pivot ratio since rows were last selected
  RowWatch watch_;
  bool has_quasi_static_ = false;
  bool has_laws_ = false;  // rows with laws of their own: gears, paths, wheels
  dynamics::Circumstances around_;
  model::RowMemory steered_;  // of models with drives by signals: around_.memory, steered
  dynamics::SignalValues steering_signals_;
  RigidRows rigid_;
  ContactCones cones_;
  BallCones balls_;
  std::vector<char> decided_together_;  // per rigid row: by cones_ or balls_
  HeldLaws held_;
  bool accepts_last_stands_ = false, has_accepted_stands_ = false;
  bool decides_first_ = false;
  int num_selections_ = 0;
  std::unique_ptr<dynamics::MultiplierCondensation> condensation_;
  /// Of corrections for which places slide; null: in this step none had to.
  std::unique_ptr<dynamics::MultiplierCondensation> sliding_;
  std::vector<double> pivoted_;  // for a condensation not yet made, see visit_saved()

  IterationEnd ending_;
  dynamics::JointSet joints_;
  std::vector<char> rates_only_;   // of each row of λ
  std::vector<int> place_in_use_;  // of each row of λ among the rows in use, −1: not in use
  std::vector<dynamics::BodyMotion> end_, evaluation_, uncorrected_;
  dynamics::JointResiduals residuals_;        // at the end of the step
  dynamics::JointResiduals other_residuals_;  // elsewhere
  dynamics::Forces forces_;
  bool goes_on_ = false, has_left_open_ = false;  // see iterate()
  dynamics::LawEnds law_ends_;                    // at the last evaluation
  /// Scratch: rows of couplers own memory.
  std::array<dynamics::SystemRow, dynamics::JointSet::kMostRows> rows_of_joint_, acting_of_joint_;
  std::vector<model::NearPair> near_;  // that the condensation was made for
  int num_of_groups_ = 0;
  dynamics::SoftRows soft_, soft_now_;  // at the predicted configuration; scratch
  std::vector<double> correcting_stiffness_, correcting_damping_;  // of the soft rows, predicted
  std::vector<char> give_to_corrections_;  // of soft rows: act in the matrix of corrections
  std::vector<double> soft_compliance_;
  std::vector<double> soft_stiffness_share_;  // k θ / k_eff
  bool has_soft_springs_ = false;             // any of them is not zero
  std::vector<char> only_follows_;  // of soft rows: set as rows of forces that follow multipliers
  dynamics::ReactionSlopes reaction_slopes_;
  std::vector<dynamics::ReactionSlope> slopes_;            // as the soft rows are
  std::vector<dynamics::ReactionSlope> slopes_of_joints_;  // after the first iteration
  bool slopes_are_old_ = false;                            // still those of the predicted motion
  std::vector<dynamics::SoftRows> soft_of_laws_;           // on joints, as they were evaluated
  bool is_evaluated_ = false;  // prepare() has done what the iteration begins with
  std::vector<dynamics::MultiplierSlope> slopes_in_use_;
  std::vector<loads::RowMix> inverse_mixes_;  // nearly: of singular ones
  std::vector<int> mix_of_row_;               // of each soft row, −1: none
  std::vector<dynamics::BodyCompliance> compliance_;

  std::vector<BodyIteration> shares_;                          // per body
  std::vector<dynamics::BodyResponse> correction_, response_;  // row forces on them
  linalg::Vector E_, open_, X_, corrected_;
  double motion_ = 0;              // of the step, at the last iteration [m]
  std::size_t restless_body_ = 0;  // whose frame moved most in the last iteration
};

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/reaction_slopes.h"
#include "buckens/dynamics/signals.h"

namespace buckens::dynamics {

/// What one load does to the energy of the model at one instant.
struct LoadPower {
  double stored = 0;    ///< in its springs [J]
  double supplied = 0;  ///< from outside [W]
  double lost = 0;      ///< dissipated, without `rubbed` [W]
  double rubbed = 0;    ///< by dry friction of contacts [W]

  void add(const loads::Action& action) {
    stored += action.stored_energy;
    supplied += action.active_power + action.dissipation;
    lost += action.dissipation - action.friction;
    rubbed += action.friction;
  }
};

/// Generalised forces on all bodies at one instant.
struct Forces {
  /// Per body: torque about the origin in body axes [N m], force in world axes [N].
  std::vector<Eigen::Matrix<double, 6, 1>> frame;
  /// Per body: loads on the interface rows, num_interface_rows() each.
  std::vector<Eigen::VectorXd> interface;
  double stored_energy = 0;            ///< in springs [J]
  double active_power = 0;             ///< of loads and dampers [W], not counting stored energy
  double dissipation = 0;              ///< dissipated by dampers, negative part of active_power [W]
  std::vector<int> regimes;            ///< of laws on joint coordinates, see loads::Action::regime
  std::vector<loads::RigidRow> rigid;  ///< one per Load::rigid_row
  SignalValues signals;                ///< at the instant
  std::vector<spatial::Wrench> on_others;  ///< scratch
  /// Of each load, where account() has asked for them; otherwise empty.
  std::vector<LoadPower> of_loads;

  void reset(const model::Model& model) { reset(model, model.gravity); }
  /// @param gravity of the instant [m/s²]
  void reset(const model::Model& model, const Eigen::Vector3d& gravity);
  /// Keeps the place of a load that is evaluated elsewhere.
  void leave_place(const model::Load& load);
  /// Asks for the powers of single loads. Those of laws that a JointSet evaluates are left out.
  void account(const model::Model& model) { of_loads.resize(model.loads.size()); }
};

/// Whether a load has more than one tangent, and so a place in Forces::regimes.
bool has_regimes(const model::Load& load);

/// Gravity, loads and springs. Uniform gravity acts on frames only: its nodal load is in the span
/// of P, which the sieve removes.
/// @param around what force laws use besides the motions
/// @param load_factor multiplies applied forces and torques, neither gravity nor springs
/// @param at_joints JointSet::laws(): of loads that are left to a JointSet, which adds to `out`
/// @throws NumericalError naming the load whose law fails
void evaluate_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     const Circumstances& around, Forces& out, double load_factor = 1.0,
                     const std::vector<char>* at_joints = nullptr);
/// The same without circumstances.
void evaluate_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     Forces& out, double load_factor = 1.0);

/// Adds the effect of a wrench on a marker to its body; nothing for the ground.
void add_wrench(const model::Model& model, const model::MarkerId& id,
                const body::MarkerKinematics& kinematics, const spatial::Wrench& wrench,
                Forces& out);

/// Adds Gᵀλ.
void add_joint_forces(const Constraints& constraints, const linalg::Vector& lambda, Forces& out);

class JointSet;

/// Tangents of all force elements, in the order of Model::loads.
struct SoftRows {
  std::vector<SystemRow> rows;
  std::vector<double> stiffness, damping;
  std::vector<int> rigid;              ///< Load::rigid_row, −1 of rows that give way
  std::vector<char> is_closed;         ///< of rigid rows; false of rows that give way
  std::vector<int> regimes;            ///< as in Forces
  std::vector<loads::RowMix> mixes;    ///< of rows that act together
  std::vector<int> first_of_mix;       ///< the first of the rows of each
  int num_of_groups = 0;               ///< of the rows, the last ones: of contacts of many bodies
  std::vector<loads::SoftRow> of_one;  ///< scratch
  std::vector<loads::TwistRow> of_others;
  SignalValues signals, shifted;  ///< at the instant; scratch

  /// Forgets all rows and what belongs to them.
  void clear();
};

/// @param followers null, or forces that grow with reactions: `slopes` says how, in the order of
/// the rows
/// @param at_joints null, or evaluates the laws that it has with their joints
/// @param of_laws null, or the rows of these laws, JointSet::Laws::soft; their slopes are left out
void evaluate_soft_rows(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                        const Circumstances& around, SoftRows& out,
                        const ReactionSlopes* followers = nullptr,
                        std::vector<ReactionSlope>* slopes = nullptr,
                        const JointSet* at_joints = nullptr,
                        const std::vector<SoftRows>* of_laws = nullptr);
/// Appends rows, as they are, to others.
void append_rows(const SoftRows& from, SoftRows& to);
/// Appends how the rows of an element that come next act together, if they do.
void append_mix(const loads::ForceElement& element, const loads::Sight& sight, SoftRows& out);
/// Rows of what is switched off stay in their places, since the number of rows is constant.
void give_nothing(std::vector<loads::SoftRow>& rows);
/// The same without circumstances, at t = 0.
void evaluate_soft_rows(const model::Model& model, const std::vector<BodyMotion>& motions,
                        SoftRows& out);

}  // namespace buckens::dynamics

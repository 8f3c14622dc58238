// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/acceleration.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/initial/mixed_rounds.h"
#include "buckens/base/errors.h"
#include "buckens/body/body_lengths.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/dynamics/travel.h"
#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::analysis {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr int kMaxRounds = 100;
constexpr double kSettled = 1e-13;
// Frames and meshes that are coupled weakly have converged by then.
constexpr int kPlainRounds = 20;

/// Accelerations of one body, refined in rounds.
struct BodyAcceleration {
  body::DeformedMoments moments;
  Vector6 frame = Vector6::Zero();
  Vector nodal_static;  // Y M⁻¹ of loads that do not depend on accelerations
  Vector nodal;         // d̈
  Vector lengths;       // that make displacements of d
};

class Accelerations {
 public:
  Accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                const std::vector<int>& rows_in_use, model::State& state,
                const std::vector<char>& given)
      : model_(model), metric_(metric), rows_in_use_(rows_in_use), state_(state), given_(given) {}

  void run() {
    start();
    MixedRounds mixed;
    for (int round = 0; round < kMaxRounds; ++round) {
      const Vector begin = round < kPlainRounds ? Vector() : gather();
      if (solve_round() <= kSettled) {
        store();
        return;
      }
      if (round >= kPlainRounds) scatter(mixed.mix(begin, gather()));
    }
    throw NumericalError(
        "the initial accelerations of frames and meshes do not converge: an initial deformation is "
        "too large for linear elasticity; reduce it or stiffen the body");
  }

 private:
  void start() {
    const auto motions = dynamics::motions_of(model_, state_);
    dynamics::evaluate_constraints(model_, motions, state_.t, &state_.memory, constraints_);
    find_rows(motions);
    dynamics::evaluate_forces(model_, motions, state_.t, dynamics::circumstances_of(state_),
                              forces_);
    bodies_.resize(model_.bodies.size());
    std::vector<Matrix3d> J;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const body::Body& body = model_.bodies[b];
      const model::BodyState& s = state_.bodies[b];
      const Vector zero = Vector::Zero(s.d.size());
      if (!body.is_flexible()) {
        bodies_[b].moments = dynamics::undeformed_moments(body);
        J.push_back(body.J0);
        continue;
      }
      bodies_[b].lengths = body::coordinate_lengths(body);
      const auto coupling = dynamics::evaluate_coupling(body, s.terms, s.d, s.d_dot, zero,
                                                        s.frame.w, Vector3d::Zero());
      const body::InertiaInvariants& invariants = body.flexible->invariants;
      bodies_[b].moments = dynamics::frame_moments(body, s.terms, coupling.moments,
                                                   invariants.pattern_values(s.d.whole()),
                                                   invariants.pattern_values(s.d_dot.whole()));
      J.push_back(bodies_[b].moments.J);
      Vector load = -(body.flexible->fe.K * s.d.whole());
      if (body.flexible->is_damped()) load -= body.flexible->C * s.d_dot.whole();
      if (s.terms.have_load()) load += coupling.load.whole();
      invariants.add_centrifugal_load(dynamics::centrifugal_weights(s.terms, s.frame.w), load);
      bodies_[b].nodal_static = mass_solve(body, load);
      bodies_[b].nodal = bodies_[b].nodal_static;
    }
    compliance_ = metric_.full(J);
    condensation_.emplace(static_cast<int>(bodies_.size()), rows_);
    std::vector<double> give;
    for (std::size_t k = rows_in_use_.size(); k < rows_.size(); ++k) {
      give.push_back(stepping::kRigidGive * stepping::own_compliance(rows_[k], compliance_));
    }
    if (!stepping::factorise_closed_rows(*condensation_, rows_, compliance_, give)) {
      throw NumericalError(
          "the joint equations are dependent in the initial position (a dead centre); choose "
          "another initial position");
    }
  }

  /// Joint rows in use, then the closed rigid rows of force laws, whose forces are to be found.
  void find_rows(const std::vector<dynamics::BodyMotion>& motions) {
    const Vector bias = dynamics::constraint_bias(model_, motions, state_.t, &state_.memory);
    for (const int row : rows_in_use_) {
      rows_.push_back(constraints_.rows[static_cast<std::size_t>(row)]);
      bias_.push_back(bias[row]);
    }
    if (model_.num_rigid_rows() == 0) return;
    dynamics::SoftRows soft;
    dynamics::evaluate_soft_rows(model_, motions, state_.t, dynamics::circumstances_of(state_),
                                 soft);
    for (std::size_t k = 0; k < soft.rows.size(); ++k) {
      if (!soft.is_closed[k]) continue;
      if (!given_.empty() && given_[static_cast<std::size_t>(soft.rigid[k])] != 0) continue;
      const model::Load& load = model_.load_of_rigid_row(soft.rigid[k]);
      rows_.push_back(soft.rows[k]);
      bias_.push_back(bias_of(load, motions) - aimed_acceleration(load, motions));
      closed_.push_back(load.first_state + 1);
    }
  }

  double aimed_acceleration(const model::Load& load,
                            const std::vector<dynamics::BodyMotion>& motions) const {
    const auto index = static_cast<std::size_t>(&load - model_.loads.data());
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, &state_.memory);
    return static_cast<const loads::RigidLaw&>(*load.element)
        .aimed_acceleration(
            dynamics::sight_of(model_, index, state_.t, dynamics::circumstances_of(state_), ends));
  }

  double bias_of(const model::Load& load, const std::vector<dynamics::BodyMotion>& motions) const {
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, &state_.memory);
    if (ends.travel) return ends.travel->coordinate_bias();
    const auto coordinate = static_cast<std::size_t>(load.coordinate);
    return model_.coordinates[coordinate].law.bias(
        ends.first.motion, ends.second.motion, dynamics::evaluate_bias(model_, load.first, motions),
        dynamics::evaluate_bias(model_, load.second, motions),
        dynamics::before_of(&state_.memory, coordinate));
  }

  /// M⁻¹ of a load; zero if deformation has no rates.
  Vector mass_solve(const body::Body& body, Vector load) const {
    if (body.flexible->is_quasi_static) return Vector::Zero(load.size());
    body.flexible->sieve.apply_transposed(load);
    Vector x = linalg::conjugate_gradients(body.flexible->fe.M, load);
    body.flexible->sieve.apply(x);
    return x;
  }

  /// Accelerations at fixed coupling between ẇ and d̈; returns their relative change.
  double solve_round() {
    std::vector<Vector6> frame(bodies_.size());
    std::vector<Vector> nodal(bodies_.size());
    std::vector<Eigen::VectorXd> y(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) free_acceleration(b, frame[b], nodal[b], y[b]);
    Vector X(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      double value = -bias_[k];
      for (const dynamics::BodyRow* part : rows_[k].parts()) {
        if (part->body == model::kGround) continue;
        const auto b = static_cast<std::size_t>(part->body);
        value -= part->change(frame[b], y[b]);
      }
      X[static_cast<Eigen::Index>(k)] = value;
    }
    condensation_->solve_in_place(X);
    std::vector<dynamics::BodyResponse> responses(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      responses[b].interface_load = Vector::Zero(model_.bodies[b].num_interface_rows());
    }
    condensation_->gather(X, responses);
    double change = 0.0;
    double size = 1e-300;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      // In equilibrium joints cancel the effect of loads: that is the scale of rounding.
      size = std::max({size, size_of(frame[b]), size_of(b, nodal[b])});
      frame[b] += compliance_[b].frame * responses[b].frame_load;
      change = std::max(change, size_of(frame[b] - bodies_[b].frame));
      size = std::max(size, size_of(frame[b]));
      bodies_[b].frame = frame[b];
      if (!model_.bodies[b].is_flexible()) continue;
      nodal[b] += metric_.H(b) * responses[b].interface_load;
      change = std::max(change, size_of(b, nodal[b] - bodies_[b].nodal));
      size = std::max(size, size_of(b, nodal[b]));
      bodies_[b].nodal = nodal[b];
    }
    lambda_ = X;
    return change / size;
  }

  /// All accelerations of a round, as those of displacements [m/s²].
  Vector gather() const {
    Eigen::Index size = 0;
    for (const BodyAcceleration& body : bodies_) size += 6 + body.nodal.size();
    Vector all(size);
    Eigen::Index at = 0;
    for (const BodyAcceleration& body : bodies_) {
      all.segment<6>(at) = body.frame;
      all.segment<3>(at) *= model_.length;
      all.segment(at + 6, body.nodal.size()) = body.nodal.cwiseProduct(body.lengths);
      at += 6 + body.nodal.size();
    }
    return all;
  }
  void scatter(const Vector& all) {
    Eigen::Index at = 0;
    for (BodyAcceleration& body : bodies_) {
      body.frame = all.segment<6>(at);
      body.frame.head<3>() /= model_.length;
      body.nodal = all.segment(at + 6, body.nodal.size()).cwiseQuotient(body.lengths);
      at += 6 + body.nodal.size();
    }
  }

  /// Largest acceleration [m/s²], rotations by the model's length.
  double size_of(const Vector6& frame) const {
    return std::max(model_.length * frame.head<3>().cwiseAbs().maxCoeff(),
                    frame.tail<3>().cwiseAbs().maxCoeff());
  }
  double size_of(std::size_t b, const Vector& nodal) const {
    return nodal.size() > 0 ? nodal.cwiseProduct(bodies_[b].lengths).cwiseAbs().maxCoeff() : 0.0;
  }

  void free_acceleration(std::size_t b, Vector6& frame, Vector& nodal, Eigen::VectorXd& y) const {
    const body::Body& body = model_.bodies[b];
    const model::BodyState& s = state_.bodies[b];
    const BodyAcceleration& now = bodies_[b];
    body::DeformedMoments moments = now.moments;
    if (body.is_flexible() && s.terms.quad_ref) {
      moments.l_dot = body.flexible->invariants.relative_momentum(s.d, now.nodal);
    }
    const Vector6 inertia =
        dynamics::frame_inertia(body, moments, s.frame.w, Vector3d::Zero(), Vector3d::Zero());
    Vector6 load = forces_.frame[b] - inertia;
    // The substitute for missing inertia is part of the compliance but not of the motion.
    load.head<3>() += body.stand_in * now.frame.head<3>();
    frame = compliance_[b].frame * load;
    if (!body.is_flexible()) return;
    nodal = now.nodal_static + metric_.H(b) * forces_.interface[b];
    if (s.terms.eul_fe) {
      const Vector3d w_dot = now.frame.head<3>();
      const Vector euler = body.flexible->invariants.deformation_load(
          s.d, Vector::Zero(s.d.size()), Vector3d::Zero(), w_dot, s.terms);
      if (!euler.isZero(0.0)) nodal += mass_solve(body, euler);
    }
    y = body.row_values(nodal);
  }

  void store() {
    state_.lambda.setZero(model_.num_constraint_rows());
    for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
      state_.lambda[rows_in_use_[k]] = lambda_[static_cast<Eigen::Index>(k)];
    }
    for (std::size_t k = 0; k < closed_.size(); ++k) {
      // What was missing: friction of contacts is that of the forces so far.
      state_.memory.laws[closed_[k]] += lambda_[static_cast<Eigen::Index>(rows_in_use_.size() + k)];
    }
    state_.lambda_time = state_.t;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      model::BodyState& s = state_.bodies[b];
      s.w_dot = s.w_alg = bodies_[b].frame.head<3>();
      s.v_dot = s.v_alg = bodies_[b].frame.tail<3>();
      if (s.d.size() > 0) s.d_ddot = s.d_alg = bodies_[b].nodal;
    }
  }

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  const std::vector<int>& rows_in_use_;
  model::State& state_;
  const std::vector<char>& given_;  // rigid rows whose forces are known
  dynamics::Constraints constraints_;
  Vector lambda_;
  std::vector<double> bias_;
  std::vector<int> closed_;  // places in RowMemory::laws of the forces of closed rigid rows
  dynamics::Forces forces_;
  std::vector<BodyAcceleration> bodies_;
  std::vector<dynamics::BodyCompliance> compliance_;
  std::vector<dynamics::SystemRow> rows_;
  std::optional<dynamics::MultiplierCondensation> condensation_;
};

}  // namespace

void compute_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                           const std::vector<int>& rows_in_use, model::State& state,
                           const std::vector<char>& given) {
  Accelerations(model, metric, rows_in_use, state, given).run();
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/monolithic_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/drives.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/spatial/rotation.h"
#include "buckens/stepping/change_of_step.h"

namespace buckens::stepping {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Unknowns of one body: u and Δ carry velocity, κ and η are corrections. Columns −1 are absent.
struct MonolithicStepper::Part {
  explicit Part(const body::Body& b) : body(b) {
    const auto rotations = b.rotation_basis.cols();
    const auto translations = b.translation_basis.cols();
    basis = MatrixXd::Zero(6, rotations + translations);
    basis.topLeftCorner(3, rotations) = b.rotation_basis;
    basis.bottomRightCorner(3, translations) = b.translation_basis;
    if (b.is_flexible()) P = independent_multipliers(b);
  }

  /// P = MΦ with unit columns; columns without mass or dependent on others are left out.
  static Matrix independent_multipliers(const body::Body& b) {
    std::vector<Vector3d> positions;
    for (const auto& node : b.flexible->fe.nodes) positions.push_back(node.position);
    const Matrix Phi = body::rigid_modes(positions, b.flexible->fe.dofs, b.com);
    Matrix P = b.flexible->fe.M * Phi;
    const double largest = P.colwise().norm().maxCoeff();
    for (Eigen::Index k = 0; k < P.cols(); ++k) {
      const double norm = P.col(k).norm();
      P.col(k) *= norm > 1e-12 * largest ? 1.0 / norm : 0.0;
    }
    const linalg::PivotedQr qr(P, 1e-9);
    Matrix out(P.rows(), qr.rank());
    for (Eigen::Index k = 0; k < qr.rank(); ++k) {
      out.col(k) = P.col(qr.order()[static_cast<std::size_t>(k)]);
    }
    return out;
  }

  const body::Body& body;
  MatrixXd basis;  // 6×(frame coordinates in use)
  Matrix P;        // n×(rigid motions that carry mass)
  int frame = 0, frame_correction = 0;
  int nodal = 0, nodal_multiplier = 0, nodal_correction = 0, correction_multiplier = 0;

  const model::BodyState* before = nullptr;
  History<Vector6> frame_history;
  History<Vector> nodal_history;
  Vector6 u, kappa;
  Vector delta, eta;
  Matrix6 W;                      // of the correction: at the predicted motion
  model::Coupling coupling;       // as evaluated last
  body::DeformedMoments moments;  // all of them

  bool is_flexible() const { return body.is_flexible(); }
  void set_moments(const Vector& d, const Vector& d_dot) {
    const auto& patterns = body.flexible->invariants.centrifugal_patterns();
    moments = dynamics::frame_moments(body, before->terms, coupling.moments,
                                      patterns.transpose() * d, patterns.transpose() * d_dot);
  }
  Matrix6 metric(const Scheme& scheme, const Vector3d& w) const {
    Matrix6 out = Matrix6::Zero();
    out.topLeftCorner<3, 3>() =
        scheme.mass * moments.J + scheme.damping * dynamics::gyroscopic_tangent(moments, w);
    out.bottomRightCorner<3, 3>() = scheme.mass * body.mass * Eigen::Matrix3d::Identity();
    return out;
  }
  dynamics::BodyMotion motion(double weight, bool corrected, bool shifted, double rate_factor,
                              const Vector6& frame_rate, const Vector* nodal_rate) const {
    dynamics::BodyMotion out;
    Vector6 way = weight * u;
    if (shifted) way += frame_history.offset;
    if (corrected) way += kappa;
    out.frame.X_WB.p = before->frame.X_WB.p + way.tail<3>();
    out.frame.X_WB.q = (before->frame.X_WB.q * spatial::exp_rotation(way.head<3>())).normalized();
    const Vector6 rate = rate_factor * u + frame_rate;
    out.frame.w = rate.head<3>();
    out.frame.v = rate.tail<3>();
    if (!is_flexible()) return out;
    Vector d = before->d + weight * delta;
    if (shifted) d += nodal_history.offset;
    if (corrected) d += eta;
    out.y = body.flexible->rows * d;
    out.y_dot = body.flexible->rows * (rate_factor * delta + *nodal_rate);
    return out;
  }
};

MonolithicStepper::MonolithicStepper(const model::Model& model, const StepSettings& settings,
                                     std::vector<int> rows_in_use)
    : model_(model),
      settings_(settings),
      scheme_(settings.method, settings.step, settings.method_parameter()),
      rows_in_use_(std::move(rows_in_use)),
      rates_only_(dynamics::rate_only_rows(model)),
      rigid_(model),
      held_(model) {
  const auto take = [this](Eigen::Index count) {
    const int first = size_;
    size_ += static_cast<int>(count);
    return first;
  };
  for (const body::Body& body : model.bodies) {
    auto part = std::make_unique<Part>(body);
    part->frame = take(part->basis.cols());
    part->frame_correction = take(part->basis.cols());
    part->nodal = take(body.num_dofs());
    part->nodal_multiplier = take(part->P.cols());
    part->nodal_correction = take(body.num_dofs());
    part->correction_multiplier = take(part->P.cols());
    parts_.push_back(std::move(part));
  }
  first_lambda_ = take(static_cast<Eigen::Index>(rows_in_use_.size()));
  first_correction_ = take(static_cast<Eigen::Index>(rows_in_use_.size()));
  first_rigid_ = take(model.num_rigid_rows());
  first_rigid_correction_ = take(model.num_rigid_rows());
}

MonolithicStepper::~MonolithicStepper() = default;

bool MonolithicStepper::corrects_positions() const {
  return scheme_.weight == 1.0 || settings_.position_projection;
}

void MonolithicStepper::start(const model::State& state) {
  z_ = Vector::Zero(size_);
  regimes_before_.clear();
  lambda_ = state.lambda;
  inputs_ = state.inputs;
  memory_ = state.memory;
  rigid_.start(memory_, scheme_.undone_at_end());
  for (std::size_t k = 0; k < rigid_.stands().size(); ++k) {
    z_[first_rigid_ + static_cast<int>(k)] = scheme_.force * rigid_.stands()[k].force;
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    z_[first_lambda_ + static_cast<int>(k)] = scheme_.force * lambda_[rows_in_use_[k]];
  }
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    Part& part = *parts_[b];
    const model::BodyState& s = state.bodies[b];
    part.before = &s;
    Vector6 rate, acceleration, algorithmic;
    rate << s.frame.w, s.frame.v;
    acceleration << s.w_dot, s.v_dot;
    algorithmic << s.w_alg, s.v_alg;
    part.frame_history = scheme_.history<Vector6>(rate, acceleration, algorithmic);
    part.u = part.frame_history.predicted;
    part.kappa.setZero();
    if (!part.is_flexible()) {
      part.moments = dynamics::undeformed_moments(part.body);
      continue;
    }
    part.nodal_history = scheme_.history<Vector>(s.d_dot, s.d_ddot, s.d_alg);
    part.delta = part.nodal_history.predicted;
    part.eta = Vector::Zero(s.d.size());
    // The step starts from the coupling extrapolated from previous steps, and W keeps it.
    if (!s.terms.are_lagged()) {
      part.coupling = {};
    } else if (state.history > 0) {
      dynamics::extrapolate(s, state.history, scheme_.evaluation_time(state.t), part.coupling);
    } else {
      part.coupling = dynamics::evaluate_coupling(part.body, s.terms, s.d, s.d_dot, s.d_ddot,
                                                  s.frame.w, s.w_dot);
    }
    Vector d = s.d + scheme_.weight * part.delta;
    if (scheme_.has_offset()) d += part.nodal_history.offset;
    part.set_moments(d, scheme_.mean_rate * part.delta + part.nodal_history.mean_velocity);
    z_.segment(part.nodal, s.d.size()) = part.delta;
  }
}

void MonolithicStepper::evaluate(double t) {
  motions_end_.resize(parts_.size());
  motions_evaluation_.resize(parts_.size());
  const bool at_end = scheme_.weight == 1.0;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    motions_end_[b] = part.motion(1.0, true, false, scheme_.end_rate, part.frame_history.velocity,
                                  &part.nodal_history.velocity);
    motions_evaluation_[b] =
        part.motion(scheme_.weight, at_end, scheme_.has_offset(), scheme_.mean_rate,
                    part.frame_history.mean_velocity, &part.nodal_history.mean_velocity);
  }
  dynamics::steer_drives(model_, motions_end_, t + scheme_.h, around(), forces_.signals, memory_);
  const double t_e = scheme_.evaluation_time(t);
  dynamics::evaluate_constraints(model_, motions_end_, t + scheme_.h, &memory_, end_);
  dynamics::evaluate_constraints(model_, motions_evaluation_, t_e, &memory_, evaluation_);
  const auto act = [&] {
    dynamics::evaluate_forces(model_, motions_evaluation_, t_e, around(), forces_);
  };
  act();
  if (rigid_.let_go(forces_.rigid)) act();
  dynamics::evaluate_soft_rows(model_, motions_evaluation_, t_e, around(), soft_);
  dynamics::add_joint_forces(evaluation_, lambda_, forces_);
}

void MonolithicStepper::predict(double t) {
  evaluate(t);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    parts_[b]->W = parts_[b]->metric(scheme_, motions_evaluation_[b].frame.w);
  }
  predicted_rows_ = evaluation_.rows;
  correcting_ = soft_;
  fixed_part();
}

void MonolithicStepper::update_coupling(Part& part) {
  if (!part.is_flexible()) return;
  Vector d = part.before->d + scheme_.weight * part.delta;
  if (scheme_.weight == 1.0) d += part.eta;
  if (scheme_.has_offset()) d += part.nodal_history.offset;
  const Vector6 w = scheme_.mean_rate * part.u + part.frame_history.mean_velocity;
  const Vector6 w_dot = scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
  const Vector d_dot = scheme_.mean_rate * part.delta + part.nodal_history.mean_velocity;
  part.coupling = dynamics::evaluate_coupling(
      part.body, part.before->terms, d, d_dot,
      scheme_.acceleration_rate * part.delta + part.nodal_history.acceleration, w.head<3>(),
      w_dot.head<3>());
  part.set_moments(d, d_dot);
}

std::vector<MonolithicStepper::Entry> MonolithicStepper::entries(
    const dynamics::SystemRow& row) const {
  std::vector<Entry> out;
  for (const dynamics::BodyRow* share : row.parts()) {
    if (share->body == model::kGround) continue;
    const Part& part = *parts_[static_cast<std::size_t>(share->body)];
    const Eigen::RowVectorXd frame = share->frame * part.basis;
    for (int k = 0; k < static_cast<int>(frame.size()); ++k) {
      out.push_back({part.frame + k, part.frame_correction + k, frame[k]});
    }
    for (int k = 0; k < 6; ++k) {
      const int first = k < 3 ? share->translation_row : share->rotation_row;
      if (first < 0) continue;
      const auto& N = part.body.flexible->rows;
      using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
      for (RowMajor::InnerIterator it(N, first + k % 3); it; ++it) {
        const int dof = static_cast<int>(it.col());
        out.push_back(
            {part.nodal + dof, part.nodal_correction + dof, share->interface[k] * it.value()});
      }
    }
  }
  return out;
}

namespace {

void add_block(std::vector<Triplet>& out, int row, int column, double factor,
               const SparseMatrix& A) {
  for (int k = 0; k < A.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      out.emplace_back(row + static_cast<int>(it.row()), column + static_cast<int>(it.col()),
                       factor * it.value());
    }
  }
}

void add_dense(std::vector<Triplet>& out, int row, int column, const MatrixXd& A) {
  for (int j = 0; j < static_cast<int>(A.cols()); ++j) {
    for (int i = 0; i < static_cast<int>(A.rows()); ++i) {
      out.emplace_back(row + i, column + j, A(i, j));
    }
  }
}

}  // namespace

void MonolithicStepper::fixed_body(const Part& part) {
  add_dense(fixed_, part.frame_correction, part.frame_correction,
            part.basis.transpose() * part.W * part.basis);
  if (!part.is_flexible()) return;
  const body::FlexiblePart& mesh = *part.body.flexible;
  for (const auto& [row, multiplier] :
       {std::pair(part.nodal, part.nodal_multiplier),
        std::pair(part.nodal_correction, part.correction_multiplier)}) {
    add_block(fixed_, row, row, scheme_.mass, mesh.fe.M);
    add_block(fixed_, row, row, scheme_.stiffness, mesh.fe.K);
    if (mesh.is_damped()) add_block(fixed_, row, row, scheme_.damping, mesh.C);
    add_dense(fixed_, row, multiplier, -part.P);
    add_dense(fixed_, multiplier, row, part.P.transpose());
  }
  // Only where the equations hold at the corrected position does its strain count.
  if (scheme_.weight == 1.0) {
    add_block(fixed_, part.nodal, part.nodal_correction, scheme_.stiffness, mesh.fe.K);
  }
}

void MonolithicStepper::add_product(const std::vector<Entry>& row, const std::vector<Entry>& column,
                                    double factor, bool row_corrects, bool column_corrects) {
  for (const Entry& i : row) {
    for (const Entry& j : column) {
      fixed_.emplace_back(row_corrects ? i.correction_column : i.column,
                          column_corrects ? j.correction_column : j.column,
                          factor * i.value * j.value);
    }
  }
}

void MonolithicStepper::fixed_corrections() {
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const int column = first_correction_ + static_cast<int>(k);
    if (!corrects_positions()) {
      fixed_.emplace_back(column, column, 1.0);
      continue;
    }
    const auto row = static_cast<std::size_t>(rows_in_use_[k]);
    for (const Entry& e : entries(predicted_rows_[row])) {
      fixed_.emplace_back(e.correction_column, column, -e.value);
      // A correction of positions rolls as well.
      if (rates_only_[row]) fixed_.emplace_back(column, e.correction_column, e.value);
    }
  }
  for (std::size_t k = 0; k < correcting_.rows.size(); ++k) {
    const double k_eff = scheme_.force * (scheme_.weight * correcting_.stiffness[k] +
                                          scheme_.mean_rate * correcting_.damping[k]);
    const std::vector<Entry> row = entries(correcting_.rows[k]);
    add_product(row, row, k_eff, true, true);
  }
}

void MonolithicStepper::follow_regimes() {
  if (correcting_.regimes == soft_.regimes) return;
  correcting_.regimes = soft_.regimes;
  correcting_.is_closed = soft_.is_closed;
  fixed_part();
}

void MonolithicStepper::fixed_part() {
  fixed_.clear();
  for (const auto& part : parts_) fixed_body(*part);
  fixed_corrections();
  fixed_rigid_corrections();
  fixed_matrix_.resize(size_, size_);
  fixed_matrix_.setFromTriplets(fixed_.begin(), fixed_.end());
}

void MonolithicStepper::tangent(std::vector<Triplet>& out) const {
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    const Matrix6 W = part.metric(scheme_, motions_evaluation_[b].frame.w);
    add_dense(out, part.frame, part.frame, part.basis.transpose() * W * part.basis);
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const auto row = static_cast<std::size_t>(rows_in_use_[k]);
    const int velocity = first_lambda_ + static_cast<int>(k);
    const int position = first_correction_ + static_cast<int>(k);
    for (const Entry& e : entries(evaluation_.rows[row])) {
      out.emplace_back(e.column, velocity, -e.value);
    }
    for (const Entry& e : entries(end_.rows[row])) {
      out.emplace_back(velocity, e.column, e.value);
      if (!corrects_positions() || rates_only_[row]) continue;
      out.emplace_back(position, e.column, e.value);
      out.emplace_back(position, e.correction_column, e.value);
    }
  }
  std::vector<std::vector<Entry>> soft;
  for (const dynamics::SystemRow& row : soft_.rows) soft.push_back(entries(row));
  dynamics::for_shares(soft_, [&](int on, int by, double share) {
    const auto k = static_cast<std::size_t>(by);
    const double elastic = share * scheme_.force * scheme_.weight * soft_.stiffness[k];
    const double both = elastic + share * scheme_.force * scheme_.mean_rate * soft_.damping[k];
    for (const Entry& i : soft[static_cast<std::size_t>(on)]) {
      for (const Entry& j : soft[k]) {
        out.emplace_back(i.column, j.column, both * i.value * j.value);
        if (scheme_.weight != 1.0) continue;
        out.emplace_back(i.column, j.correction_column, elastic * i.value * j.value);
      }
    }
  });
}

void MonolithicStepper::body_residual(std::size_t b, Vector& r) const {
  const Part& part = *parts_[b];
  const Vector6 acceleration = scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
  const Vector3d& w = motions_evaluation_[b].frame.w;
  const Vector6 inertia = dynamics::frame_inertia(part.body, part.moments, w,
                                                  acceleration.head<3>(), acceleration.tail<3>());
  r.segment(part.frame, part.basis.cols()) =
      part.basis.transpose() * (scheme_.force * (inertia - forces_.frame[b]));
  if (!part.is_flexible()) return;
  const body::FlexiblePart& mesh = *part.body.flexible;
  Vector load = -(mesh.fe.M * part.nodal_history.acceleration) - mesh.fe.K * part.before->d;
  if (scheme_.has_offset()) load -= mesh.fe.K * part.nodal_history.offset;
  if (mesh.is_damped()) load -= mesh.C * part.nodal_history.mean_velocity;
  load += mesh.rows.topRows(mesh.num_interface_rows).transpose() * forces_.interface[b];
  if (part.before->terms.have_load()) load += part.coupling.load;
  load +=
      mesh.invariants.centrifugal_patterns() * dynamics::centrifugal_weights(part.before->terms, w);
  r.segment(part.nodal, load.size()) -= scheme_.force * load;
  Vector at_rest = part.before->d;  // Pᵀx_e = 0, per θ
  if (scheme_.has_offset()) at_rest = (at_rest + part.nodal_history.offset) / scheme_.weight;
  r.segment(part.nodal_multiplier, part.P.cols()) += part.P.transpose() * at_rest;
}

Vector MonolithicStepper::residual(double t) const {
  Vector r = fixed_matrix_ * z_;
  for (std::size_t b = 0; b < parts_.size(); ++b) body_residual(b, r);
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const int row = rows_in_use_[k];
    r[first_lambda_ + static_cast<int>(k)] = end_.g_dot[row] / scheme_.end_rate;
    if (corrects_positions() && !rates_only_[static_cast<std::size_t>(row)]) {
      r[first_correction_ + static_cast<int>(k)] = end_.g[row];
    }
  }
  rigid_residual(r);
  held_residual(t, r);
  return r;
}

double MonolithicStepper::apply(const Vector& change, double& motion) {
  z_ += change;
  const auto size = [this](const Vector6& u) {
    return std::max(model_.length * u.head<3>().cwiseAbs().maxCoeff(),
                    u.tail<3>().cwiseAbs().maxCoeff());
  };
  double largest = 0;
  motion = 0;
  for (const auto& p : parts_) {
    Part& part = *p;
    const Eigen::Index count = part.basis.cols();
    const Vector6 du = part.basis * change.segment(part.frame, count);
    const Vector6 dk = part.basis * change.segment(part.frame_correction, count);
    part.u += du;
    part.kappa += dk;
    largest = std::max(largest, size(du) + size(dk));
    motion = std::max(motion, size(part.u));
    if (!part.is_flexible()) continue;
    const Eigen::Index n = part.delta.size();
    part.delta = z_.segment(part.nodal, n);
    part.eta = z_.segment(part.nodal_correction, n);
    largest = std::max(largest, change.segment(part.nodal, n).cwiseAbs().maxCoeff());
    largest = std::max(largest, change.segment(part.nodal_correction, n).cwiseAbs().maxCoeff());
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    lambda_[rows_in_use_[k]] = z_[first_lambda_ + static_cast<int>(k)] / scheme_.force;
  }
  for (std::size_t k = 0; k < rigid_.stands().size(); ++k) {
    const int row = static_cast<int>(k);
    if (!forces_.rigid[k].is_closed) continue;
    rigid_.add_force(row, z_[first_rigid_ + row] / scheme_.force - rigid_.stands()[k].force);
  }
  return largest;
}

void MonolithicStepper::iterate(double t, StepReport& report) {
  double before = 0;
  for (int iteration = 0; iteration < settings_.max_newton; ++iteration) {
    follow_regimes();
    hold_reversed(t);
    std::vector<Triplet> all = fixed_;
    tangent(all);
    rigid_tangent(all);
    SparseMatrix A(size_, size_);
    A.setFromTriplets(all.begin(), all.end());
    Eigen::SparseLU<SparseMatrix> lu(A);
    if (lu.info() != Eigen::Success) {
      throw NumericalError(
          fmt::format("step at t = {:.6g} s failed: the monolithic matrix is singular; the joint "
                      "equations have become dependent",
                      t));
    }
    double motion = 0;
    const double change = apply(lu.solve(Vector(-residual(t))), motion);
    ++report.newton_iterations;
    for (const auto& part : parts_) update_coupling(*part);
    evaluate(t);
    // Rounding of positions limits what can be reached; slow convergence is not mistaken for it.
    const bool is_settled =
        change <= settings_.newton_tolerance * motion + 1e-15 * model_.length ||
        (before > 0 && change > 0.9 * before && change <= 1e-11 * model_.length);
    if (is_settled && !move_rigid_rows()) return;
    if (is_settled) evaluate(t);
    before = is_settled ? 0 : change;
  }
  throw NumericalError(
      fmt::format("step at t = {:.6g} s failed: the monolithic iteration does not converge within "
                  "{} iterations (last change {:.3g} m); use a smaller step than {:.3g} s",
                  t, settings_.max_newton, before, scheme_.h));
}

model::State MonolithicStepper::next_state(const model::State& state) const {
  model::State next;
  next.t = state.t + scheme_.h;
  next.lambda = lambda_;
  next.lambda_time = scheme_.evaluation_time(state.t);
  next.last_step = scheme_.h;
  next.history = std::min(3, state.history + 1);
  next.inputs = state.inputs;
  dynamics::advance_memory(model_, motions_end_, next.t, around(), next.memory);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    const model::BodyState& old = state.bodies[b];
    model::BodyState& s = next.bodies.emplace_back();
    s.frame = motions_end_[b].frame;
    const Vector6 acceleration =
        scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
    s.w_dot = scheme_.carried_acceleration<Vector3d>(old.w_dot, acceleration.head<3>());
    s.v_dot = scheme_.carried_acceleration<Vector3d>(old.v_dot, acceleration.tail<3>());
    s.w_alg = scheme_.algorithmic(old.w_dot, old.w_alg, s.w_dot);
    s.v_alg = scheme_.algorithmic(old.v_dot, old.v_alg, s.v_dot);
    s.terms = old.terms;
    if (!part.is_flexible()) continue;
    s.d = old.d + part.delta + part.eta;
    s.d_dot = scheme_.end_rate * part.delta + part.nodal_history.velocity;
    s.d_ddot = scheme_.carried_acceleration<Vector>(
        old.d_ddot, scheme_.acceleration_rate * part.delta + part.nodal_history.acceleration);
    s.d_alg = scheme_.algorithmic(old.d_ddot, old.d_alg, s.d_ddot);
    s.coupling = part.coupling;
    s.coupling.t = scheme_.evaluation_time(state.t);
    s.coupling_before = old.coupling;
    s.coupling_earlier = old.coupling_before;
  }
  return next;
}

StepReport MonolithicStepper::step(model::State& state) {
  StepReport report;
  model::State from = state;
  if (must_rescale(state, scheme_)) rescale_algorithmic(from, scheme_);
  start(from);
  predict(state.t);
  iterate(state.t, report);
  if (end_.g.size() > 0) {
    Eigen::Index worst = 0;
    report.position_residual = end_.g.cwiseAbs().maxCoeff(&worst);
    report.velocity_residual = end_.g_dot.cwiseAbs().maxCoeff();
    report.worst_row = static_cast<int>(worst);
  }
  state = next_state(from);
  return report;
}

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/position_assembly.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/initial/start_rows.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/model_scales.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using dynamics::BodyCompliance;
using dynamics::BodyResponse;
using dynamics::Constraints;
using dynamics::SystemRow;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr int kMaxAssemblyIterations = 200;
constexpr double kLargestRotation = 0.5;  // rad per iteration

/// Least motion that closes the rows; redundant rows share it.
class LeastMotion {
 public:
  /// @param lengths of comparison, one per row
  LeastMotion(const model::Model& model, std::vector<BodyCompliance> compliance,
              const std::vector<SystemRow>& rows, Vector lengths)
      : lengths_(std::move(lengths)),
        compliance_(std::move(compliance)),
        condensation_(static_cast<int>(model.bodies.size()), rows),
        responses_(model.bodies.size()) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      responses_[b].interface_load = Vector::Zero(model.bodies[b].num_interface_rows());
    }
  }

  /// Bodies' loads whose motion changes the rows by `demand`, damped by `damping` of the diagonal.
  const std::vector<BodyResponse>& solve(const std::vector<SystemRow>& rows, Vector demand,
                                         double damping) {
    std::vector<double> diagonal;
    diagonal.reserve(rows.size());
    double largest = 0.0;
    // Compared as fractions of the model's length: angles and lengths differ in unit.
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const SystemRow& row = rows[k];
      const double length = lengths_[static_cast<Eigen::Index>(k)];
      double value = 0.0;
      for (const dynamics::BodyRow* part : row.parts()) {
        if (part->body == model::kGround) continue;
        const auto& C = compliance_[static_cast<std::size_t>(part->body)];
        value += part->frame.dot(C.frame * part->frame.transpose());
      }
      diagonal.push_back(value);
      largest = std::max(largest, value / (length * length));
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double length = lengths_[static_cast<Eigen::Index>(k)];
      diagonal[k] = damping * std::max(diagonal[k], 1e-6 * largest * length * length) + 1e-300;
    }
    condensation_.factorise(rows, rows, compliance_, diagonal);
    condensation_.solve_in_place(demand);
    condensation_.gather(demand, responses_);
    return responses_;
  }

  Vector6 frame_motion(std::size_t b) const {
    return compliance_[b].frame * responses_[b].frame_load;
  }

 private:
  Vector lengths_;
  std::vector<BodyCompliance> compliance_;
  dynamics::MultiplierCondensation condensation_;
  std::vector<BodyResponse> responses_;
};

const model::Joint* worst_joint(const model::Model& model, const Vector& residual) {
  Eigen::Index worst = 0;
  // Start values may stand behind the rows of joints.
  residual.head(model.num_constraint_rows()).cwiseAbs().maxCoeff(&worst);
  return model.owner_of_row(static_cast<int>(worst)).first;
}

std::string describe_gap(const model::Joint* joint, const Vector& residual, const char* rate) {
  const Vector own =
      residual.segment(joint->first_row, static_cast<Eigen::Index>(joint->rows.size()));
  double gap = 0.0;
  double angle = 0.0;
  for (std::size_t k = 0; k < joint->rows.size(); ++k) {
    const double value = own[static_cast<Eigen::Index>(k)];
    (joint->rows[k].is_length() ? gap : angle) += value * value;
  }
  return fmt::format("joint \"{}\" ({} between {} and {}): {:.6g} m{} apart, {:.6g} rad{} askew",
                     joint->name, joints::to_string(joint->type), joint->first.text,
                     joint->second.text, std::sqrt(gap), rate, std::sqrt(angle), rate);
}

std::vector<spatial::Pose> poses(const model::State& state) {
  std::vector<spatial::Pose> out;
  for (const model::BodyState& body : state.bodies) out.push_back(body.frame.X_WB);
  return out;
}

void move(model::State& state, const std::vector<spatial::Pose>& from, const LeastMotion& motion,
          double factor) {
  for (std::size_t b = 0; b < from.size(); ++b) {
    const Vector6 u = factor * motion.frame_motion(b);
    spatial::Pose& X = state.bodies[b].frame.X_WB;
    X.p = from[b].p + u.tail<3>();
    X.q = (from[b].q * spatial::exp_rotation(u.head<3>())).normalized();
  }
}

double step_limit(const model::Model& model, const LeastMotion& motion) {
  double factor = 1.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Vector6 u = motion.frame_motion(b);
    factor = std::min(factor, kLargestRotation / std::max(u.head<3>().norm(), kLargestRotation));
    factor = std::min(factor, model.length / std::max(u.tail<3>().norm(), model.length));
  }
  return factor;
}

/// Closes joints, and start values with them.
class PositionClosure {
 public:
  PositionClosure(const model::Model& model, const dynamics::MassMetric& metric,
                  model::State& state, const StartRows& starts)
      : model_(model), metric_(metric), state_(state), starts_(starts) {
    lengths_ = dynamics::row_lengths(model);
    starts.append_lengths(lengths_);
  }

  /// @param share of the way to the start values. @return whether all rows are closed
  bool run(double share) {
    share_ = share;
    evaluate();
    LeastMotion motion(model_, metric_.rigid(), constraints_.rows, lengths_);
    // Positions far from the origin are known to fewer digits.
    const double rounding =
        kPositionRounding *
        dynamics::rounding_length(model_, dynamics::motions_of(model_, state_)) / model_.length;
    double residual = shares().norm();
    double damping = 1e-10;
    for (int iteration = 0; iteration < kMaxAssemblyIterations; ++iteration) {
      if (shares().cwiseAbs().maxCoeff() <= std::max(kClosed, rounding)) break;
      motion.solve(constraints_.rows, -constraints_.g, damping);
      if (improve(motion, residual)) {
        residual = shares().norm();
        damping = std::max(1e-12, 0.1 * damping);
        continue;
      }
      damping *= 100.0;
      if (damping > 1.0) break;
    }
    return shares().cwiseAbs().maxCoeff() <= std::max(kDependentGap, 10.0 * rounding);
  }

  /// Largest gap of the joints.
  double gap() const {
    const Eigen::Index rows = model_.num_constraint_rows();
    return rows == 0 ? 0.0 : constraints_.g.head(rows).cwiseAbs().maxCoeff();
  }

  [[noreturn]] void refuse() const {
    const bool has_joints = model_.num_constraint_rows() > 0;
    const model::Joint* joint = has_joints ? worst_joint(model_, constraints_.g) : nullptr;
    const std::string left = has_joints ? describe_gap(joint, constraints_.g, "") : std::string();
    if (starts_.empty()) {
      throw ModelError(joint->where,
                       "the mechanism cannot be assembled; closest approach leaves " + left +
                           "; correct the placement (`at`), the lengths of the bodies, or remove a "
                           "joint");
    }
    throw ModelError(
        starts_.where(),
        fmt::format("initial.joints: the joints do not allow these start values; closest approach "
                    "leaves {}{}{}; correct or remove one of them",
                    starts_.describe(dynamics::motions_of(model_, state_)),
                    left.empty() ? "" : ", and ", left));
  }

 private:
  Vector shares() const { return constraints_.g.cwiseQuotient(lengths_); }
  void evaluate() {
    const auto motions = dynamics::motions_of(model_, state_);
    dynamics::evaluate_constraints(model_, motions, state_.t, &state_.memory, constraints_);
    starts_.append(motions, share_, state_.memory, constraints_);
  }
  /// Moves as far as the gaps become smaller; not at all if they do not.
  bool improve(const LeastMotion& motion, double residual) {
    const std::vector<spatial::Pose> from = poses(state_);
    double factor = step_limit(model_, motion);
    for (int halving = 0; halving < 12; ++halving, factor *= 0.5) {
      move(state_, from, motion, factor);
      evaluate();
      if (shares().norm() < residual * (1.0 - 1e-4 * factor)) return true;
    }
    move(state_, from, motion, 0.0);
    evaluate();
    return false;
  }

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  model::State& state_;
  const StartRows& starts_;
  Vector lengths_;
  Constraints constraints_;
  double share_ = 1.0;
};

/// @throws ModelError naming the joint whose velocity cannot be met, and start values if there are
[[noreturn]] void refuse_velocities(const model::Model& model, const Vector& g_dot,
                                    const StartRows& starts, const model::State& state) {
  const bool has_joints = model.num_constraint_rows() > 0;
  const model::Joint* joint = has_joints ? worst_joint(model, g_dot) : nullptr;
  const std::string left = has_joints ? describe_gap(joint, g_dot, "/s") : std::string();
  if (starts.empty()) {
    throw ModelError(joint->where, "initial velocities contradict the joints; residual at " + left +
                                       "; correct `initial` or the law of motion of the drive");
  }
  throw ModelError(starts.where(),
                   fmt::format("initial.joints: the joints do not allow these speeds; closest "
                               "approach leaves {}{}{}; correct or remove one of them",
                               starts.describe(dynamics::motions_of(model, state)),
                               left.empty() ? "" : ", and ", left));
}

}  // namespace

double assemble_positions(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state, const std::vector<model::StartCoordinate>& starts) {
  const StartRows held(model, starts, StartRows::Held::values, dynamics::motions_of(model, state));
  if (model.num_constraint_rows() == 0 && held.empty()) return 0.0;
  PositionClosure closure(model, metric, state, held);
  const int stages = held.stages();
  for (int stage = 1; stage < stages; ++stage) {
    // What a stage leaves open the last one may close.
    closure.run(static_cast<double>(stage) / stages);
  }
  if (!closure.run(1.0)) closure.refuse();
  return closure.gap();
}

double project_velocities(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state, const std::vector<model::StartCoordinate>& starts) {
  const StartRows held(model, starts, StartRows::Held::rates, dynamics::motions_of(model, state));
  if (model.num_constraint_rows() == 0 && held.empty()) return 0.0;
  Constraints constraints;
  const auto evaluate = [&] {
    const auto motions = dynamics::motions_of(model, state);
    dynamics::evaluate_constraints(model, motions, state.t, &state.memory, constraints);
    held.append(motions, 1.0, state.memory, constraints);
  };
  std::vector<Eigen::Matrix3d> J;
  for (const body::Body& body : model.bodies) J.push_back(body.J0);
  Vector lengths = dynamics::row_lengths(model);
  held.append_lengths(lengths);
  const auto shares = [&] { return constraints.g_dot.cwiseQuotient(lengths); };
  // Of the rates [1/s]: consistent velocities leave rounding of their own size.
  double scale = 0.0;
  for (const model::BodyState& body : state.bodies) {
    scale = std::max({scale, body.frame.v.cwiseAbs().maxCoeff() / model.length,
                      body.frame.w.cwiseAbs().maxCoeff()});
  }
  for (const bool with_mesh : {false, true}) {
    evaluate();
    LeastMotion motion(model, with_mesh ? metric.full(J) : metric.rigid(), constraints.rows,
                       lengths);
    // The damping that tolerates redundant rows leaves 1e-10 of the demand: three rounds remove it.
    for (int round = 0; round < 3; ++round) {
      scale = std::max(scale, shares().cwiseAbs().maxCoeff());
      const auto& responses = motion.solve(constraints.rows, -constraints.g_dot, 1e-10);
      for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        model::BodyState& s = state.bodies[b];
        const Vector6 V = motion.frame_motion(b);
        s.frame.w += V.head<3>();
        s.frame.v += V.tail<3>();
        if (!with_mesh || s.d.size() == 0) continue;
        s.d_dot.change() += metric.H(b) * responses[b].interface_load;
      }
      evaluate();
    }
    if (shares().cwiseAbs().maxCoeff() <= kDependentGap * scale) {
      return constraints.g_dot.cwiseAbs().maxCoeff();
    }
  }
  refuse_velocities(model, constraints.g_dot, held, state);
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/position_assembly.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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
  LeastMotion(const model::Model& model, std::vector<BodyCompliance> compliance,
              const std::vector<SystemRow>& rows)
      : lengths_(dynamics::row_lengths(model)),
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
      for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
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
  residual.cwiseAbs().maxCoeff(&worst);
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

}  // namespace

double assemble_positions(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state) {
  if (model.num_constraint_rows() == 0) return 0.0;
  Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, state), state.t, constraints);
  LeastMotion motion(model, metric.rigid(), constraints.rows);
  const Vector lengths = dynamics::row_lengths(model);
  const auto shares = [&] { return constraints.g.cwiseQuotient(lengths); };
  // Positions far from the origin are known to fewer digits.
  const double rounding = kPositionRounding *
                          dynamics::rounding_length(model, dynamics::motions_of(model, state)) /
                          model.length;
  double residual = shares().norm();
  double damping = 1e-10;
  for (int iteration = 0; iteration < kMaxAssemblyIterations; ++iteration) {
    if (shares().cwiseAbs().maxCoeff() <= std::max(kClosed, rounding)) break;
    motion.solve(constraints.rows, -constraints.g, damping);
    const std::vector<spatial::Pose> from = poses(state);
    double factor = step_limit(model, motion);
    bool improved = false;
    for (int halving = 0; halving < 12 && !improved; ++halving, factor *= 0.5) {
      move(state, from, motion, factor);
      dynamics::evaluate_constraints(model, dynamics::motions_of(model, state), state.t,
                                     constraints);
      improved = shares().norm() < residual * (1.0 - 1e-4 * factor);
    }
    if (improved) {
      residual = shares().norm();
      damping = std::max(1e-12, 0.1 * damping);
      continue;
    }
    move(state, from, motion, 0.0);
    dynamics::evaluate_constraints(model, dynamics::motions_of(model, state), state.t, constraints);
    damping *= 100.0;
    if (damping > 1.0) break;
  }
  if (shares().cwiseAbs().maxCoeff() <= std::max(kDependentGap, 10.0 * rounding)) {
    return constraints.g.cwiseAbs().maxCoeff();
  }
  const model::Joint* joint = worst_joint(model, constraints.g);
  throw ModelError(
      joint->where,
      "the mechanism cannot be assembled; closest approach leaves " +
          describe_gap(joint, constraints.g, "") +
          "; correct the placement (`at`), the lengths of the bodies, or remove a joint");
}

double project_velocities(const model::Model& model, const dynamics::MassMetric& metric,
                          model::State& state) {
  if (model.num_constraint_rows() == 0) return 0.0;
  Constraints constraints;
  std::vector<Eigen::Matrix3d> J;
  for (const body::Body& body : model.bodies) J.push_back(body.J0);
  const Vector lengths = dynamics::row_lengths(model);
  const auto shares = [&] { return constraints.g_dot.cwiseQuotient(lengths); };
  // Of the rates [1/s]: consistent velocities leave rounding of their own size.
  double scale = 0.0;
  for (const model::BodyState& body : state.bodies) {
    scale = std::max({scale, body.frame.v.cwiseAbs().maxCoeff() / model.length,
                      body.frame.w.cwiseAbs().maxCoeff()});
  }
  for (const bool with_mesh : {false, true}) {
    dynamics::evaluate_constraints(model, dynamics::motions_of(model, state), state.t, constraints);
    LeastMotion motion(model, with_mesh ? metric.full(J) : metric.rigid(), constraints.rows);
    // The damping that tolerates redundant rows leaves 1e-10 of the demand: three rounds remove it.
    for (int round = 0; round < 3; ++round) {
      scale = std::max(scale, shares().cwiseAbs().maxCoeff());
      const auto& responses = motion.solve(constraints.rows, -constraints.g_dot, 1e-10);
      for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        model::BodyState& s = state.bodies[b];
        const Vector6 V = motion.frame_motion(b);
        s.frame.w += V.head<3>();
        s.frame.v += V.tail<3>();
        if (with_mesh && s.d.size() > 0) s.d_dot += metric.H(b) * responses[b].interface_load;
      }
      dynamics::evaluate_constraints(model, dynamics::motions_of(model, state), state.t,
                                     constraints);
    }
    if (shares().cwiseAbs().maxCoeff() <= kDependentGap * scale) {
      return constraints.g_dot.cwiseAbs().maxCoeff();
    }
  }
  const model::Joint* joint = worst_joint(model, constraints.g_dot);
  throw ModelError(joint->where, "initial velocities contradict the joints; left over at " +
                                     describe_gap(joint, constraints.g_dot, "/s") +
                                     "; correct `initial` or the law of motion of the drive");
}

}  // namespace buckens::analysis

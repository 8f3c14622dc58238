// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/rest_tangent.h"

#include <algorithm>

#include "buckens/dynamics/forces.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using dynamics::BodyMotion;
using dynamics::BodyRow;
using dynamics::Forces;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

// Of the model's length, or rad: balances rounding (1e-16/step) and curvature (step²).
constexpr double kTangentDifference = 1e-5;

class Linearisation {
 public:
  Linearisation(const model::Model& model, const model::State& state, std::vector<int> rows_in_use)
      : model_(model), state_(state), rows_in_use_(std::move(rows_in_use)) {
    lay_out();
    motions_ = dynamics::motions_of(model, state);
    for (BodyMotion& motion : motions_) {
      motion.frame.w.setZero();
      motion.frame.v.setZero();
      motion.y_dot.setZero();
    }
    dynamics::evaluate_constraints(model, motions_, state.t, constraints_);
  }

  RestTangent run(RestLoads loads) {
    add_joint_rows();
    if (loads == RestLoads::all) {
      add_force_differences();
    } else {
      add_springs();
    }
    const SparseMatrix transposed = out_.stiffness.transpose();
    const double size = out_.stiffness.norm();
    if (size > 0.0) out_.asymmetry = SparseMatrix(out_.stiffness - transposed).norm() / size;
    out_.stiffness = SparseMatrix(0.5 * (out_.stiffness + transposed));
    return std::move(out_);
  }

 private:
  void lay_out();
  Vector gradient(const BodyRow& part) const;
  void add_joint_rows();
  void add_springs();
  void add_force_differences();
  Forces forces_at(const Vector& step) const;
  Vector loads_on(std::size_t body, const Forces& forces) const;
  std::vector<std::vector<std::size_t>> neighbours() const;

  const model::Model& model_;
  const model::State& state_;
  std::vector<int> rows_in_use_;
  std::vector<BodyMotion> motions_;
  dynamics::Constraints constraints_;
  RestTangent out_;
};

void Linearisation::lay_out() {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    RestBody place;
    place.first = out_.size;
    place.rotations = static_cast<int>(body.rotation_basis.cols());
    place.translations = static_cast<int>(body.translation_basis.cols());
    place.rows = body.num_interface_rows();
    // l̇ in the frame equation and the Euler load in that of the mesh.
    const body::CouplingTerms& terms = state_.bodies[b].terms;
    const bool couples = body.is_flexible() && terms.quad_ref && terms.eul_fe;
    if (couples && state_.bodies[b].d.cwiseAbs().maxCoeff() > 0.0) place.momenta = 3;
    out_.size += place.size();
    out_.bodies.push_back(place);
  }
}

/// Derivatives of a scalar with respect to the coordinates of one body.
Vector Linearisation::gradient(const BodyRow& part) const {
  const auto b = static_cast<std::size_t>(part.body);
  const RestBody& place = out_.bodies[b];
  Vector out = Vector::Zero(place.size());
  out.head(place.rotations) =
      model_.bodies[b].rotation_basis.transpose() * part.frame.head<3>().transpose();
  out.segment(place.rotations, place.translations) =
      model_.bodies[b].translation_basis.transpose() * part.frame.tail<3>().transpose();
  auto y = out.segment(place.num_frame(), place.rows);
  if (part.translation_row >= 0) {
    y.segment<3>(part.translation_row) += part.interface.head<3>().transpose();
  }
  if (part.rotation_row >= 0) {
    y.segment<3>(part.rotation_row) += part.interface.tail<3>().transpose();
  }
  return out;
}

void Linearisation::add_joint_rows() {
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const auto& row = constraints_.rows[static_cast<std::size_t>(rows_in_use_[k])];
    for (const BodyRow* part : {&row.first, &row.second}) {
      if (part->body == model::kGround) continue;
      const Vector own = gradient(*part);
      const int first = out_.bodies[static_cast<std::size_t>(part->body)].first;
      for (int i = 0; i < own.size(); ++i) {
        if (own[i] != 0.0) entries.emplace_back(static_cast<int>(k), first + i, own[i]);
      }
    }
  }
  out_.rows.resize(static_cast<Eigen::Index>(rows_in_use_.size()), out_.size);
  out_.rows.setFromTriplets(entries.begin(), entries.end());
}

void Linearisation::add_springs() {
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model_, motions_, soft);
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < soft.rows.size(); ++k) {
    std::vector<std::pair<int, double>> values;
    for (const BodyRow* part : {&soft.rows[k].first, &soft.rows[k].second}) {
      if (part->body == model::kGround) continue;
      const Vector own = gradient(*part);
      const int first = out_.bodies[static_cast<std::size_t>(part->body)].first;
      for (int i = 0; i < own.size(); ++i) {
        if (own[i] != 0.0) values.emplace_back(first + i, own[i]);
      }
    }
    for (const auto& [i, a] : values) {
      for (const auto& [j, b] : values) entries.emplace_back(i, j, soft.stiffness[k] * a * b);
    }
  }
  out_.stiffness.resize(out_.size, out_.size);
  out_.stiffness.setFromTriplets(entries.begin(), entries.end());
}

/// Loads and joint forces after a step of the coordinates, multipliers as they are.
Forces Linearisation::forces_at(const Vector& step) const {
  std::vector<BodyMotion> moved = motions_;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const RestBody& place = out_.bodies[b];
    const body::Body& body = model_.bodies[b];
    const auto own = step.segment(place.first, place.size());
    spatial::Pose& pose = moved[b].frame.X_WB;
    pose.p += body.translation_basis * own.segment(place.rotations, place.translations);
    const Eigen::Vector3d psi = body.rotation_basis * own.head(place.rotations);
    pose.q = (pose.q * spatial::exp_rotation(psi)).normalized();
    moved[b].y.head(place.rows) += own.segment(place.num_frame(), place.rows);
  }
  Forces out;
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model_, moved, state_.t, constraints);
  dynamics::evaluate_forces(model_, moved, state_.t, out);
  dynamics::add_joint_forces(constraints, state_.lambda, out);
  return out;
}

Vector Linearisation::loads_on(std::size_t b, const Forces& forces) const {
  const RestBody& place = out_.bodies[b];
  Vector out = Vector::Zero(place.size());
  out.head(place.rotations) =
      model_.bodies[b].rotation_basis.transpose() * forces.frame[b].head<3>();
  out.segment(place.rotations, place.translations) =
      model_.bodies[b].translation_basis.transpose() * forces.frame[b].tail<3>();
  out.segment(place.num_frame(), place.rows) = forces.interface[b].head(place.rows);
  return out;
}

/// Bodies that feel a body's motion, itself too.
std::vector<std::vector<std::size_t>> Linearisation::neighbours() const {
  std::vector<std::vector<std::size_t>> out(model_.bodies.size());
  for (std::size_t b = 0; b < out.size(); ++b) out[b].push_back(b);
  const auto connect = [&](const model::MarkerId& first, const model::MarkerId& second) {
    if (first.body == model::kGround || second.body == model::kGround) return;
    out[static_cast<std::size_t>(first.body)].push_back(static_cast<std::size_t>(second.body));
    out[static_cast<std::size_t>(second.body)].push_back(static_cast<std::size_t>(first.body));
  };
  for (const model::Joint& joint : model_.joints) connect(joint.first, joint.second);
  for (const model::Load& load : model_.loads) connect(load.first, load.second);
  for (auto& list : out) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return out;
}

/// Greedy colours such that no body feels two bodies of one colour.
std::vector<std::vector<std::size_t>> colors_of(
    const std::vector<std::vector<std::size_t>>& neighbours) {
  std::vector<std::vector<std::size_t>> colors;
  std::vector<std::size_t> color(neighbours.size(), neighbours.size());
  for (std::size_t b = 0; b < neighbours.size(); ++b) {
    std::vector<bool> taken(colors.size() + 1, false);
    for (const std::size_t near : neighbours[b]) {
      for (const std::size_t far : neighbours[near]) {
        if (color[far] < taken.size()) taken[color[far]] = true;
      }
    }
    color[b] =
        static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    if (color[b] == colors.size()) colors.emplace_back();
    colors[color[b]].push_back(b);
  }
  return colors;
}

void Linearisation::add_force_differences() {
  const auto near = neighbours();
  std::vector<Triplet> entries;
  for (const std::vector<std::size_t>& color : colors_of(near)) {
    int most = 0;
    for (const std::size_t b : color) {
      most = std::max(most, out_.bodies[b].num_frame() + out_.bodies[b].rows);
    }
    for (int k = 0; k < most; ++k) {
      Vector step = Vector::Zero(out_.size);
      const auto step_of = [&](std::size_t b) {
        const RestBody& place = out_.bodies[b];
        return k < place.rotations ? kTangentDifference : kTangentDifference * model_.length;
      };
      for (const std::size_t b : color) {
        const RestBody& place = out_.bodies[b];
        if (k < place.num_frame() + place.rows) step[place.first + k] = step_of(b);
      }
      const Forces plus = forces_at(step);
      const Forces minus = forces_at(-step);
      for (const std::size_t b : color) {
        const RestBody& place = out_.bodies[b];
        if (k >= place.num_frame() + place.rows) continue;
        for (const std::size_t other : near[b]) {
          const Vector change = loads_on(other, plus) - loads_on(other, minus);
          for (int i = 0; i < change.size(); ++i) {
            if (change[i] == 0.0) continue;
            entries.emplace_back(out_.bodies[other].first + i, place.first + k,
                                 -change[i] / (2.0 * step_of(b)));
          }
        }
      }
    }
  }
  out_.stiffness.resize(out_.size, out_.size);
  out_.stiffness.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

RestTangent rest_tangent(const model::Model& model, const model::State& state,
                         const std::vector<int>& rows_in_use, RestLoads loads) {
  return Linearisation(model, state, rows_in_use).run(loads);
}

}  // namespace buckens::analysis

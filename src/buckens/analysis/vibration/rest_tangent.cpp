// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/rest_tangent.h"

#include <utility>

#include "buckens/analysis/statics/linearised_loads.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

using dynamics::BodyMotion;
using dynamics::BodyRow;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;

namespace {

/// Gathers a RestTangent.
class AtRest {
 public:
  AtRest(const model::Model& model, const model::State& state, std::vector<int> rows_in_use,
         const ClosedRows* closed)
      : model_(model),
        state_(state),
        rows_in_use_(std::move(rows_in_use)),
        closed_(closed),
        loads_(model, closed == nullptr ? nullptr : &closed->rest) {
    lay_out();
    motions_ = dynamics::motions_of(model, state);
    for (BodyMotion& motion : motions_) {
      motion.frame.w.setZero();
      motion.frame.v.setZero();
      motion.y_dot.setZero();
    }
    dynamics::evaluate_constraints(model, motions_, state.t, &state.memory, constraints_);
  }

  RestTangent run(RestLoads loads) {
    add_joint_rows();
    if (loads == RestLoads::all) {
      add_loads();
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
  void add_joint_rows();
  void add_row(int number, const dynamics::SystemRow& row, std::vector<Triplet>& to) const;
  void add_springs();
  void add_loads();

  const model::Model& model_;
  const model::State& state_;
  std::vector<int> rows_in_use_;
  const ClosedRows* closed_;
  LinearisedLoads loads_;
  std::vector<BodyMotion> motions_;
  dynamics::Constraints constraints_;
  RestTangent out_;
};

void AtRest::lay_out() {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    RestBody place;
    static_cast<BodyCoordinates&>(place) = loads_.bodies()[b];
    place.first = out_.size;
    // l̇ in the frame equation and the Euler load in that of the mesh.
    const body::CouplingTerms& terms = state_.bodies[b].terms;
    const bool couples = body.is_flexible() && terms.quad_ref && terms.eul_fe;
    if (couples && state_.bodies[b].d.whole().cwiseAbs().maxCoeff() > 0.0) place.momenta = 3;
    out_.size += place.size();
    out_.bodies.push_back(place);
  }
}

void AtRest::add_row(int number, const dynamics::SystemRow& row, std::vector<Triplet>& to) const {
  for (const BodyRow* part : row.parts()) {
    if (part->body == model::kGround) continue;
    const Vector own = loads_.gradient(*part);
    const int first = out_.bodies[static_cast<std::size_t>(part->body)].first;
    for (int i = 0; i < own.size(); ++i) {
      if (own[i] != 0.0) to.emplace_back(number, first + i, own[i]);
    }
  }
}

void AtRest::add_joint_rows() {
  std::vector<Triplet> entries;
  int count = 0;
  for (const int row : rows_in_use_) {
    add_row(count++, constraints_.rows[static_cast<std::size_t>(row)], entries);
  }
  if (closed_ != nullptr) {
    RestValues values;
    closed_->rest.evaluate(motions_, state_.t, values);
    for (const int row : closed_->in_use) {
      add_row(count++, values.rows[static_cast<std::size_t>(row)], entries);
    }
  }
  out_.rows.resize(count, out_.size);
  out_.rows.setFromTriplets(entries.begin(), entries.end());
}

void AtRest::add_springs() {
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model_, motions_, soft);
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < soft.rows.size(); ++k) {
    std::vector<std::pair<int, double>> values;
    for (const BodyRow* part : soft.rows[k].parts()) {
      if (part->body == model::kGround) continue;
      const Vector own = loads_.gradient(*part);
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

void AtRest::add_loads() {
  std::vector<Triplet> entries;
  const RestStands stands = closed_ == nullptr ? RestStands() : closed_->stands;
  for (const auto& block : loads_.stiffness(motions_, state_.t, state_.lambda, 1.0, stands)) {
    const int row = out_.bodies[block.on].first;
    const int column = out_.bodies[block.by].first;
    for (int j = 0; j < block.stiffness.cols(); ++j) {
      for (int i = 0; i < block.stiffness.rows(); ++i) {
        if (block.stiffness(i, j) == 0.0) continue;
        entries.emplace_back(row + i, column + j, block.stiffness(i, j));
      }
    }
  }
  out_.stiffness.resize(out_.size, out_.size);
  out_.stiffness.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

RestTangent rest_tangent(const model::Model& model, const model::State& state,
                         const std::vector<int>& rows_in_use, RestLoads loads,
                         const ClosedRows* closed) {
  return AtRest(model, state, rows_in_use, closed).run(loads);
}

}  // namespace buckens::analysis

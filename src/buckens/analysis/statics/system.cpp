// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/dynamics/row_memory.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using dynamics::BodyRow;
using dynamics::Forces;
using Eigen::VectorXd;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

StaticSystem::StaticSystem(const model::Model& model, const RestRows& rest,
                           const std::vector<const ElasticCompliance*>& compliance,
                           std::vector<int> rows_in_use, double t, double force)
    : model_(model),
      rest_(rest),
      compliance_(compliance),
      rows_in_use_(std::move(rows_in_use)),
      t_(t),
      force_(force),
      loads_(model, &rest) {
  lay_out();
  add_mass();
}

void StaticSystem::lay_out() {
  const double L = model_.length;
  std::vector<double> rows, columns;
  const auto add = [&](Share share, double row, double column) {
    shares_.push_back(share);
    rows.push_back(row);
    columns.push_back(column);
  };
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    first_.push_back(static_cast<int>(shares_.size()));
    for (Eigen::Index k = 0; k < body.rotation_basis.cols(); ++k) {
      add(Share::frame, 1.0 / (force_ * L), 1.0);
    }
    for (Eigen::Index k = 0; k < body.translation_basis.cols(); ++k) {
      add(Share::frame, 1.0 / force_, L);
    }
    num_frame_.push_back(static_cast<int>(shares_.size()) - first_.back());
    std::vector<bool> is_rotation(static_cast<std::size_t>(body.num_interface_rows()), false);
    for (const body::Marker& marker : body.markers) {
      if (marker.rotation_row < 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t row = static_cast<std::size_t>(marker.rotation_row) + k;
        if (row < is_rotation.size()) is_rotation[row] = true;
      }
    }
    for (const bool rotation : is_rotation) {
      add(Share::elastic, rotation ? 1.0 : 1.0 / L, rotation ? 1.0 : L);
    }
  }
  first_multiplier_ = static_cast<int>(shares_.size());
  for (const int row : rows_in_use_) {
    const auto [joint, k] = model_.owner_of_row(row);
    const bool length = joint->rows[static_cast<std::size_t>(k)].is_length();
    add(Share::joint, length ? 1.0 / L : 1.0, length ? force_ : force_ * L);
  }
  first_rest_ = static_cast<int>(shares_.size());
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    const bool is_angle = rest_[k].is_angle;
    add(Share::joint, is_angle ? 1.0 : 1.0 / L, is_angle ? force_ * L : force_);
  }
  size_ = static_cast<int>(shares_.size());
  row_scale_ = Eigen::Map<const Vector>(rows.data(), size_);
  column_scale_ = Eigen::Map<const Vector>(columns.data(), size_);
}

void StaticSystem::add_mass() {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const auto& T = body.rotation_basis;
    const Eigen::MatrixXd J = T.transpose() * (body.J0 + body.stand_in) * T;
    for (int i = 0; i < num_frame_[b]; ++i) {
      for (int j = 0; j < num_frame_[b]; ++j) {
        double value = i == j ? body.mass : 0.0;
        if (i < J.rows() || j < J.rows()) value = i < J.rows() && j < J.rows() ? J(i, j) : 0.0;
        put(first_[b] + i, first_[b] + j, value, mass_);
      }
    }
  }
}

int StaticSystem::num_unknowns(std::size_t body) const {
  return num_frame_[body] + model_.bodies[body].num_interface_rows();
}

void StaticSystem::put(int row, int column, double value, std::vector<Triplet>& to) const {
  to.emplace_back(row, column, row_scale_[row] * column_scale_[column] * value);
}

std::vector<dynamics::BodyMotion> motions_at(const model::Model& model, const StaticPoint& point) {
  std::vector<dynamics::BodyMotion> motions(point.poses.size());
  for (std::size_t b = 0; b < motions.size(); ++b) {
    motions[b].frame.X_WB = point.poses[b];
    motions[b].y = motions[b].y_dot = VectorXd::Zero(model.bodies[b].num_rows());
    motions[b].y.head(point.y[b].size()) = point.y[b];
  }
  return motions;
}

std::vector<dynamics::BodyMotion> motions_towards(const model::Model& model,
                                                  const StaticPoint& from, const StaticPoint& to) {
  std::vector<dynamics::BodyMotion> out = motions_at(model, from);
  for (std::size_t b = 0; b < out.size(); ++b) {
    out[b].frame.v = to.poses[b].p - from.poses[b].p;
    out[b].frame.w = spatial::log_rotation(from.poses[b].q.conjugate() * to.poses[b].q);
    out[b].y_dot.head(from.y[b].size()) = to.y[b] - from.y[b];
  }
  return out;
}

StaticBalance StaticSystem::balance(const StaticPoint& point) const {
  const std::vector<dynamics::BodyMotion> motions = motions_at(model_, point);
  StaticBalance out;
  const model::RowMemory memory = dynamics::memory_at_rest(model_, motions, t_, point.lambda);
  dynamics::evaluate_constraints(model_, motions, t_, &memory, out.constraints);
  dynamics::evaluate_forces(model_, motions, t_, out.forces, point.load_factor);
  dynamics::add_joint_forces(out.constraints, point.lambda, out.forces);
  rest_.evaluate(motions, t_, out.rest);
  rest_.add_forces(out.rest, point.rest, out.forces);
  return out;
}

VectorXd StaticSystem::body_residual(std::size_t body, const Vector6& frame,
                                     const VectorXd& interface) const {
  const body::Body& b = model_.bodies[body];
  VectorXd out(num_unknowns(body));
  out << -b.rotation_basis.transpose() * frame.head<3>(),
      -b.translation_basis.transpose() * frame.tail<3>(), VectorXd::Zero(interface.size());
  if (compliance_[body] != nullptr) {
    out.tail(interface.size()) = -compliance_[body]->interface() * interface;
  }
  return out;
}

Vector StaticSystem::residual(const StaticPoint& point, const StaticBalance& balance) const {
  Vector out(size_);
  for (std::size_t b = 0; b < first_.size(); ++b) {
    VectorXd own = body_residual(b, balance.forces.frame[b], balance.forces.interface[b]);
    own.tail(point.y[b].size()) += point.y[b];
    out.segment(first_[b], own.size()) = own;
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    out[first_multiplier_ + static_cast<int>(k)] = balance.constraints.g[rows_in_use_[k]];
  }
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    const int index = first_rest_ + static_cast<int>(k);
    const loads::RowStand& stand = point.rest[k];
    out[index] = stand.regime != 0 ? rest_.gap(k, balance.rest, stand.regime)
                                   : stand.force / (column_scale_[index] * row_scale_[index]);
  }
  return out.cwiseProduct(row_scale_);
}

void StaticSystem::linearise(const StaticPoint& point, const StaticBalance& balance) {
  derivatives_.clear();
  add_joint_derivatives(balance);
  add_rest_derivatives(balance);
  for (std::size_t b = 0; b < first_.size(); ++b) {
    for (int k = num_frame_[b]; k < num_unknowns(b); ++k) {
      put(first_[b] + k, first_[b] + k, 1.0, derivatives_);  // y itself
    }
  }
  for (auto& block : loads_.stiffness(motions_at(model_, point), t_, point.lambda,
                                      point.load_factor, point.rest)) {
    const int rows = loads_.bodies()[block.on].rows;
    if (rows > 0) {  // y = K⁺ f on the interface
      const Eigen::MatrixXd loads = block.stiffness.bottomRows(rows);
      block.stiffness.bottomRows(rows) = compliance_[block.on]->interface() * loads;
    }
    for (int j = 0; j < block.stiffness.cols(); ++j) {
      for (int i = 0; i < block.stiffness.rows(); ++i) {
        put(first_[block.on] + i, first_[block.by] + j, block.stiffness(i, j), derivatives_);
      }
    }
  }
}

void StaticSystem::add_joint_derivatives(const StaticBalance& balance) {
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const auto& row = balance.constraints.rows[static_cast<std::size_t>(rows_in_use_[k])];
    for (const BodyRow* part : row.parts()) {
      if (part->body == model::kGround) continue;
      add_row(first_multiplier_ + static_cast<int>(k), *part, derivatives_, derivatives_);
    }
  }
}

void StaticSystem::add_rest_derivatives(const StaticBalance& balance) {
  closes_.assign(rest_.size(), {});
  compliances_.assign(rest_.size(), 0.0);
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    const int index = first_rest_ + static_cast<int>(k);
    double elastic = 0.0;
    for (const BodyRow* part : balance.rest.rows[k].parts()) {
      if (part->body == model::kGround) continue;
      add_row(index, *part, closes_[k], derivatives_);
      const auto b = static_cast<std::size_t>(part->body);
      if (compliance_[b] == nullptr) continue;
      const VectorXd y = loads_.gradient(*part).tail(model_.bodies[b].num_interface_rows());
      elastic += y.dot(compliance_[b]->interface() * y);
    }
    elastic *= row_scale_[index] * column_scale_[index];
    compliances_[k] = elastic > 0.0 ? elastic : 1.0;
  }
}

void StaticSystem::add_row(int index, const BodyRow& part, std::vector<Triplet>& closes,
                           std::vector<Triplet>& acts) const {
  const auto b = static_cast<std::size_t>(part.body);
  const body::Body& body = model_.bodies[b];
  VectorXd interface = VectorXd::Zero(body.num_interface_rows());
  if (part.translation_row >= 0) {
    interface.segment<3>(part.translation_row) = part.interface.head<3>().transpose();
  }
  if (part.rotation_row >= 0) {
    interface.segment<3>(part.rotation_row) = part.interface.tail<3>().transpose();
  }
  const VectorXd gradient = loads_.gradient(part);
  const VectorXd response = body_residual(b, part.frame.transpose(), interface);
  for (int k = 0; k < gradient.size(); ++k) {
    put(index, first_[b] + k, gradient[k], closes);
    put(first_[b] + k, index, response[k], acts);
  }
}

SparseMatrix StaticSystem::tangent(double sigma, const RestStands& stands, double give) const {
  std::vector<Triplet> entries = derivatives_;
  for (const Triplet& m : mass_) entries.emplace_back(m.row(), m.col(), sigma * m.value());
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    const bool is_closed = stands[k].regime != 0;
    for (const Triplet& own : closes_[k]) {
      entries.emplace_back(own.row(), own.col(), is_closed ? own.value() : 0.0);
    }
    const int index = first_rest_ + static_cast<int>(k);
    entries.emplace_back(index, index, is_closed ? give * compliances_[k] : 1.0);
  }
  for (int k = 0; k < size_; ++k) entries.emplace_back(k, k, 0.0);
  SparseMatrix out(size_, size_);
  out.setFromTriplets(entries.begin(), entries.end());
  out.makeCompressed();
  return out;
}

Vector StaticSystem::forces_of(const Vector& step) const {
  Vector out = step;
  out.head(first_multiplier_).setZero();
  return out;
}

double StaticSystem::force_change(std::size_t row, const Vector& step) const {
  const int index = first_rest_ + static_cast<int>(row);
  return column_scale_[index] * step[index];
}

Vector StaticSystem::force_slope(std::size_t row) const {
  return Vector::Unit(size_, first_rest_ + static_cast<int>(row));
}

Vector StaticSystem::gap_slope(std::size_t row) const {
  Vector out = Vector::Zero(size_);
  for (const Triplet& own : closes_[row]) out[own.col()] += own.value();
  return out;
}

double StaticSystem::gap_change(std::size_t row, const Vector& step) const {
  double out = 0.0;  // scaled
  for (const Triplet& own : closes_[row]) out += own.value() * step[own.col()];
  return out / row_scale_[first_rest_ + static_cast<int>(row)];
}

SparseMatrix StaticSystem::mass() const {
  SparseMatrix out(size_, size_);
  out.setFromTriplets(mass_.begin(), mass_.end());
  return out;
}

StaticPoint StaticSystem::moved(const StaticPoint& point, const Vector& step) const {
  StaticPoint out = point;
  for (std::size_t b = 0; b < first_.size(); ++b) {
    const Vector6 u = frame_step(b, step);
    out.poses[b].p += u.tail<3>();
    out.poses[b].q = (point.poses[b].q * spatial::exp_rotation(u.head<3>())).normalized();
    const Eigen::Index count = out.y[b].size();
    out.y[b] += step.segment(first_[b] + num_frame_[b], count)
                    .cwiseProduct(column_scale_.segment(first_[b] + num_frame_[b], count));
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const int index = first_multiplier_ + static_cast<int>(k);
    out.lambda[rows_in_use_[k]] += column_scale_[index] * step[index];
  }
  for (std::size_t k = 0; k < rest_.size(); ++k) out.rest[k].force += force_change(k, step);
  return out;
}

Vector6 StaticSystem::frame_step(std::size_t body, const Vector& step) const {
  const body::Body& b = model_.bodies[body];
  const Eigen::Index rotations = b.rotation_basis.cols();
  const VectorXd own = step.segment(first_[body], num_frame_[body])
                           .cwiseProduct(column_scale_.segment(first_[body], num_frame_[body]));
  Vector6 u;
  u << b.rotation_basis * own.head(rotations),
      b.translation_basis * own.tail(own.size() - rotations);
  return u;
}

std::size_t StaticSystem::body_at(int index) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), index) -
                                  first_.begin()) -
         1;
}

std::string StaticSystem::owner_at(int index) const {
  if (index >= first_rest_) {
    return fmt::format("load \"{}\"", rest_.name(static_cast<std::size_t>(index - first_rest_)));
  }
  const auto k = static_cast<std::size_t>(index - first_multiplier_);
  return fmt::format("joint \"{}\"", model_.owner_of_row(rows_in_use_[k]).first->name);
}

double StaticSystem::largest_deformation(const StaticPoint& point) const {
  double out = 0.0;
  for (std::size_t b = 0; b < first_.size(); ++b) {
    const Eigen::Index count = point.y[b].size();
    if (count == 0) continue;
    const auto scale = row_scale_.segment(first_[b] + num_frame_[b], count);
    out = std::max(out, point.y[b].cwiseProduct(scale).cwiseAbs().maxCoeff());
  }
  return out;
}

double StaticSystem::largest(const Vector& scaled, Share share) const {
  double out = 0.0;
  for (int k = 0; k < size_; ++k) {
    if (shares_[static_cast<std::size_t>(k)] == share) out = std::max(out, std::abs(scaled[k]));
  }
  return out;
}

}  // namespace buckens::analysis

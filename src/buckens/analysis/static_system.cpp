// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/static_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using dynamics::BodyRow;
using dynamics::Forces;
using Eigen::VectorXd;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

// Of the model's length, or rad: balances rounding (1e-16/step) and curvature (step²).
constexpr double kDifference = 1e-5;

}  // namespace

StaticSystem::StaticSystem(const model::Model& model,
                           const std::vector<const ElasticCompliance*>& compliance,
                           std::vector<int> rows_in_use, double t, double force)
    : model_(model),
      compliance_(compliance),
      rows_in_use_(std::move(rows_in_use)),
      t_(t),
      force_(force) {
  lay_out();
  find_neighbours();
  color_bodies();
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
  size_ = static_cast<int>(shares_.size());
  row_scale_ = Eigen::Map<const Vector>(rows.data(), size_);
  column_scale_ = Eigen::Map<const Vector>(columns.data(), size_);
}

void StaticSystem::find_neighbours() {
  neighbours_.resize(model_.bodies.size());
  for (std::size_t b = 0; b < neighbours_.size(); ++b) neighbours_[b].push_back(b);
  const auto connect = [this](const model::MarkerId& first, const model::MarkerId& second) {
    if (first.body == model::kGround || second.body == model::kGround) return;
    neighbours_[static_cast<std::size_t>(first.body)].push_back(
        static_cast<std::size_t>(second.body));
    neighbours_[static_cast<std::size_t>(second.body)].push_back(
        static_cast<std::size_t>(first.body));
  };
  for (const model::Joint& joint : model_.joints) connect(joint.first, joint.second);
  for (const model::Load& load : model_.loads) connect(load.first, load.second);
  for (auto& list : neighbours_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

void StaticSystem::color_bodies() {
  // Greedy, distance two: no body feels two bodies of one colour.
  std::vector<std::size_t> color(neighbours_.size(), neighbours_.size());
  for (std::size_t b = 0; b < neighbours_.size(); ++b) {
    std::vector<bool> taken(colors_.size() + 1, false);
    for (const std::size_t near : neighbours_[b]) {
      for (const std::size_t far : neighbours_[near]) {
        if (color[far] < taken.size()) taken[color[far]] = true;
      }
    }
    const auto free = std::find(taken.begin(), taken.end(), false);
    color[b] = static_cast<std::size_t>(free - taken.begin());
    if (color[b] == colors_.size()) colors_.emplace_back();
    colors_[color[b]].push_back(b);
  }
}

void StaticSystem::add_mass() {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const auto& T = body.rotation_basis;
    const Eigen::MatrixXd J = T.transpose() * body.J0 * T;
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

StaticBalance StaticSystem::balance(const StaticPoint& point) const {
  std::vector<dynamics::BodyMotion> motions(point.poses.size());
  for (std::size_t b = 0; b < motions.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    motions[b].frame.X_WB = point.poses[b];
    motions[b].y = motions[b].y_dot = VectorXd::Zero(body.num_rows());
    motions[b].y.head(body.num_interface_rows()) = point.y[b];
  }
  StaticBalance out;
  dynamics::evaluate_constraints(model_, motions, t_, out.constraints);
  dynamics::evaluate_forces(model_, motions, t_, out.forces, point.load_factor);
  dynamics::add_joint_forces(out.constraints, point.lambda, out.forces);
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
  return out.cwiseProduct(row_scale_);
}

void StaticSystem::linearise(const StaticPoint& point, const StaticBalance& balance) {
  derivatives_.clear();
  add_joint_derivatives(balance);
  for (std::size_t b = 0; b < first_.size(); ++b) {
    for (int k = num_frame_[b]; k < num_unknowns(b); ++k) {
      put(first_[b] + k, first_[b] + k, 1.0, derivatives_);  // y itself
    }
  }
  for (const std::vector<std::size_t>& color : colors_) {
    int most = 0;
    for (const std::size_t b : color) most = std::max(most, num_unknowns(b));
    for (int k = 0; k < most; ++k) {
      Vector step = Vector::Zero(size_);
      for (const std::size_t b : color) {
        if (k < num_unknowns(b)) step[first_[b] + k] = kDifference;
      }
      const StaticBalance plus = this->balance(moved(point, step));
      const StaticBalance minus = this->balance(moved(point, -step));
      for (const std::size_t b : color) {
        if (k < num_unknowns(b)) add_force_derivatives({b, k}, plus.forces, minus.forces);
      }
    }
  }
}

void StaticSystem::add_force_derivatives(const Perturbed& moved, const Forces& plus,
                                         const Forces& minus) {
  const int column = first_[moved.body] + moved.index;
  for (const std::size_t b : neighbours_[moved.body]) {
    const VectorXd difference =
        body_residual(b, plus.frame[b] - minus.frame[b], plus.interface[b] - minus.interface[b]);
    for (int k = 0; k < num_unknowns(b); ++k) {
      derivatives_.emplace_back(first_[b] + k, column,
                                row_scale_[first_[b] + k] * difference[k] / (2.0 * kDifference));
    }
  }
}

void StaticSystem::add_joint_derivatives(const StaticBalance& balance) {
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const auto& row = balance.constraints.rows[static_cast<std::size_t>(rows_in_use_[k])];
    for (const BodyRow* part : {&row.first, &row.second}) {
      if (part->body != model::kGround) add_row(k, *part);
    }
  }
}

void StaticSystem::add_row(std::size_t index, const BodyRow& part) {
  const auto b = static_cast<std::size_t>(part.body);
  const body::Body& body = model_.bodies[b];
  VectorXd interface = VectorXd::Zero(body.num_interface_rows());
  if (part.translation_row >= 0) {
    interface.segment<3>(part.translation_row) = part.interface.head<3>().transpose();
  }
  if (part.rotation_row >= 0) {
    interface.segment<3>(part.rotation_row) = part.interface.tail<3>().transpose();
  }
  VectorXd gradient(num_unknowns(b));
  gradient << body.rotation_basis.transpose() * part.frame.head<3>().transpose(),
      body.translation_basis.transpose() * part.frame.tail<3>().transpose(), interface;
  const VectorXd response = body_residual(b, part.frame.transpose(), interface);
  const int multiplier = first_multiplier_ + static_cast<int>(index);
  for (int k = 0; k < gradient.size(); ++k) {
    put(multiplier, first_[b] + k, gradient[k], derivatives_);
    put(first_[b] + k, multiplier, response[k], derivatives_);
  }
}

SparseMatrix StaticSystem::tangent(double sigma) const {
  std::vector<Triplet> entries = derivatives_;
  for (const Triplet& m : mass_) entries.emplace_back(m.row(), m.col(), sigma * m.value());
  for (int k = 0; k < size_; ++k) entries.emplace_back(k, k, 0.0);
  SparseMatrix out(size_, size_);
  out.setFromTriplets(entries.begin(), entries.end());
  out.makeCompressed();
  return out;
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

const model::Joint& StaticSystem::joint_at(int index) const {
  const auto k = static_cast<std::size_t>(index - first_multiplier_);
  return *model_.owner_of_row(rows_in_use_[k]).first;
}

double StaticSystem::largest(const Vector& scaled, Share share) const {
  double out = 0.0;
  for (int k = 0; k < size_; ++k) {
    if (shares_[static_cast<std::size_t>(k)] == share) out = std::max(out, std::abs(scaled[k]));
  }
  return out;
}

}  // namespace buckens::analysis

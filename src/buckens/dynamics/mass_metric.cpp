// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/mass_metric.h"

#include <algorithm>
#include <cmath>

#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/least_norm.h"
#include "buckens/linalg/small_lu.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::dynamics {

using Eigen::Matrix3d;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

constexpr double kRankTolerance = 1e-9;

/// R with R Rᵀ = A. Rows are judged by their own size: rotations and translations differ in unit.
Matrix symmetric_root(const Matrix& A) {
  if (A.rows() == 0) return A;
  const Vector size = A.diagonal().unaryExpr([](double a) { return a > 0.0 ? std::sqrt(a) : 0.0; });
  const Vector inverse = size.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const Matrix scaled = inverse.asDiagonal() * (0.5 * (A + A.transpose())) * inverse.asDiagonal();
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(scaled);
  const double largest = std::max(0.0, eigen.values.maxCoeff());
  const Vector roots = eigen.values.unaryExpr(
      [largest](double value) { return value > 1e-14 * largest ? std::sqrt(value) : 0.0; });
  return size.asDiagonal() * eigen.vectors * roots.asDiagonal();
}

Matrix loads_of(const body::Body& body) {
  const auto N = body.flexible->rows.topRows(body.num_interface_rows());
  return Matrix(SparseMatrix(N.transpose()));
}

Matrix response(const body::Body& body, const Matrix& loads) {
  if (body.flexible->is_quasi_static) return Matrix::Zero(loads.rows(), loads.cols());
  Matrix H(loads.rows(), loads.cols());
  for (Eigen::Index k = 0; k < H.cols(); ++k) {
    H.col(k) = linalg::conjugate_gradients(body.flexible->fe.M, loads.col(k));
  }
  body.flexible->sieve.apply(H);
  return H;
}

}  // namespace

Eigen::Matrix<double, 6, 6> frame_mobility(const body::Body& body, const Matrix3d& J) {
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  const auto& T = body.rotation_basis;
  if (T.cols() > 0) {
    const Eigen::MatrixXd reduced = T.transpose() * (J + body.stand_in) * T;
    out.topLeftCorner<3, 3>() = T * linalg::general_inverse(reduced) * T.transpose();
  }
  out.bottomRightCorner<3, 3>() =
      body.translation_basis * body.translation_basis.transpose() / body.mass;
  return out;
}

MassMetric::MassMetric(const model::Model& model) : model_(model) {
  for (const body::Body& body : model.bodies) {
    const Matrix mobility = frame_mobility(body, body.J0);
    const Matrix root = symmetric_root(mobility);
    frame_root_.push_back(root);
    Matrix H(body.num_dofs(), body.num_interface_rows());
    Matrix interface(H.cols(), H.cols());
    if (body.is_flexible()) {
      const Matrix loads = loads_of(body);
      H = response(body, loads);
      interface = loads.transpose() * H;
    }
    interface_root_.push_back(symmetric_root(interface));
    H_.push_back(std::move(H));
    interface_.push_back(std::move(interface));
    first_column_.push_back(num_columns_);
    num_columns_ += 6 + static_cast<int>(interface_root_.back().cols());
  }
}

const Matrix& MassMetric::H(std::size_t body) const {
  const body::Body& of = model_.bodies[body];
  Matrix& H = H_[body];
  if (H.rows() != of.num_dofs()) H = response(of, loads_of(of));
  return H;
}

void MassMetric::let_go() const {
  for (std::size_t b = 0; b < H_.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    if (body.is_flexible() && body.flexible->fe.M.is_divided()) H_[b] = Matrix();
  }
}

std::vector<BodyCompliance> MassMetric::rigid() const {
  std::vector<BodyCompliance> out;
  for (const body::Body& body : model_.bodies) {
    out.push_back({frame_mobility(body, body.J0), nullptr});
  }
  return out;
}

std::vector<BodyCompliance> MassMetric::full(const std::vector<Matrix3d>& J) const {
  std::vector<BodyCompliance> out;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    out.push_back({frame_mobility(body, J[b]), body.is_flexible() ? &interface_[b] : nullptr});
  }
  return out;
}

SparseMatrix MassMetric::weighted_jacobian(const std::vector<SystemRow>& rows) const {
  std::vector<linalg::Triplet> entries;
  const auto put = [&](int row, int first, const auto& values) {
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      if (values[k] != 0.0) entries.emplace_back(row, first + static_cast<int>(k), values[k]);
    }
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const BodyRow* part : rows[r].parts()) {
      if (part->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(part->body);
      const int row = static_cast<int>(r);
      put(row, first_column_[b], Eigen::RowVectorXd(part->frame * frame_root_[b]));
      if (part->translation_row < 0) continue;
      const Matrix& root = interface_root_[b];
      Eigen::RowVectorXd values =
          part->interface.head<3>() * root.middleRows<3>(part->translation_row);
      if (part->rotation_row >= 0) {
        values += part->interface.tail<3>() * root.middleRows<3>(part->rotation_row);
      }
      put(row, first_column_[b] + 6, values);
    }
  }
  SparseMatrix J(static_cast<int>(rows.size()), num_columns_);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

linalg::RowRank MassMetric::split(const std::vector<SystemRow>& rows) const {
  SparseMatrix J = weighted_jacobian(rows);
  Vector norms = Vector::Zero(J.rows());
  for (int k = 0; k < J.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(J, k); it; ++it) norms[it.row()] += it.value() * it.value();
  }
  norms = norms.cwiseSqrt();
  const Vector scale = norms.unaryExpr([](double x) { return x > 0.0 ? 1.0 / x : 0.0; });
  J = scale.asDiagonal() * J;
  return linalg::split_rows(J, kRankTolerance);
}

Vector least_multipliers(const model::Model& model, const MassMetric& metric,
                         const std::vector<SystemRow>& rows, const Vector& lambda) {
  // λ = D x with D = 1 for forces, L for torques: the smallest |x| with the same image.
  Vector D(lambda.size());
  for (const model::Joint& joint : model.joints) {
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      D[joint.first_row + static_cast<int>(k)] = joint.rows[k].is_length() ? 1.0 : model.length;
    }
  }
  const SparseMatrix J = metric.weighted_jacobian(rows);
  const SparseMatrix image = SparseMatrix(J.transpose()) * D.asDiagonal();
  const Vector forces = image * lambda.cwiseQuotient(D);
  return D.cwiseProduct(linalg::least_norm_solution(image, forces, kRankTolerance));
}

}  // namespace buckens::dynamics

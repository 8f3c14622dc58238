// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/system_pencil.h"

#include <algorithm>
#include <cmath>

#include "buckens/base/errors.h"
#include "buckens/body/mesh_solver.h"
#include "buckens/body/mode_operator.h"
#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/small_lu.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::analysis {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;

namespace {

// Dependent directions against the largest; differences of loads are good to 1e-10.
constexpr double kNoResistance = 1e-8;
constexpr int kLargestFrames = 2000;  // coordinates of the dense search for zero modes

void put_block(int row, int column, const Eigen::MatrixXd& block, std::vector<Triplet>& to) {
  for (int j = 0; j < block.cols(); ++j) {
    for (int i = 0; i < block.rows(); ++i) {
      if (block(i, j) != 0.0) to.emplace_back(row + i, column + j, block(i, j));
    }
  }
}

/// @param first its first row and column
void put_matrix(int first, const SparseMatrix& A, std::vector<Triplet>& to) {
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      to.emplace_back(first + static_cast<int>(it.row()), first + j, it.value());
    }
  }
}

SparseMatrix make_sparse(int rows, int columns, const std::vector<Triplet>& entries) {
  SparseMatrix out(rows, columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Orthonormal basis of {z : A z = 0}.
Matrix null_space(const Matrix& A, double tolerance) {
  if (A.size() == 0 || A.cwiseAbs().maxCoeff() == 0.0) {
    return Matrix::Identity(A.cols(), A.cols());
  }
  return linalg::PivotedQr(A.transpose(), tolerance).complement();
}

}  // namespace

SystemPencil::SystemPencil(const model::Model& model, const model::State& state,
                           const RestTangent& tangent)
    : model_(model), tangent_(tangent) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    const RestBody& place = tangent.bodies[b];
    first_.push_back(size_);
    size_ += place.num_frame() + static_cast<int>(body.num_dofs());
    Block block;
    Eigen::Matrix3d J = body.J0;
    if (body.is_flexible()) {
      block.loads = Matrix::Zero(body.num_dofs(), place.rows + place.momenta);
      block.loads.leftCols(place.rows) =
          Matrix(SparseMatrix(body.flexible->rows.topRows(place.rows).transpose()));
    }
    if (place.momenta > 0) {
      const Vector& d = state.bodies[b].d;
      const Vector zero = Vector::Zero(d.size());
      J = body.flexible->invariants.rotary_inertia(d);
      for (int a = 0; a < 3; ++a) {
        // l_a = dᵀH_aḋ = −(H_a d)ᵀḋ; the load of a unit ẇ_a is H_a d.
        block.loads.col(place.rows + a) = -body.flexible->invariants.deformation_load(
            d, zero, Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(a));
      }
    }
    const auto& T = body.rotation_basis;
    block.W = Eigen::MatrixXd::Zero(place.num_frame(), place.num_frame());
    block.W.topLeftCorner(place.rotations, place.rotations) = T.transpose() * J * T;
    block.W.bottomRightCorner(place.translations, place.translations)
        .diagonal()
        .setConstant(body.mass);
    Eigen::MatrixXd regular = block.W;
    regular.topLeftCorner(place.rotations, place.rotations) += T.transpose() * body.stand_in * T;
    block.mobility = linalg::general_inverse(regular);
    blocks_.push_back(std::move(block));
  }
  add_masses();
}

void SystemPencil::add_masses() {
  std::vector<Triplet> mass, gyration;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const RestBody& place = tangent_.bodies[b];
    put_block(first_[b], first_[b], blocks_[b].W, mass);
    // The substitute for missing inertia in the blocks A₀ is subtracted again by Γ.
    const auto& T = body.rotation_basis;
    put_block(place.first, place.first, -(T.transpose() * body.stand_in * T), gyration);
    if (!body.is_flexible()) continue;
    const int nodal = first_[b] + place.num_frame();
    if (body.flexible->fe.M.is_divided()) {
      blocks_[b].divided_mass = &body.flexible->fe.M;
    } else {
      put_matrix(nodal, body.flexible->fe.M.whole(), mass);
    }
    if (place.momenta == 0) continue;
    const Matrix L = blocks_[b].loads.rightCols(3) * body.rotation_basis;
    put_block(nodal, first_[b], L, mass);
    put_block(first_[b], nodal, L.transpose(), mass);
    const int momenta = place.first + place.num_frame() + place.rows;
    put_block(momenta, place.first, body.rotation_basis, gyration);
    put_block(place.first, momenta, body.rotation_basis.transpose(), gyration);
  }
  M_ = make_sparse(size_, size_, mass);
  gyration_ = make_sparse(tangent_.size, tangent_.size, gyration);
}

Matrix SystemPencil::times_mass(const Matrix& X) const {
  Matrix out = linalg::symmetric_product(M_, X);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (blocks_[b].divided_mass == nullptr) continue;
    const int first = first_[b] + tangent_.bodies[b].num_frame();
    const Eigen::Index count = blocks_[b].divided_mass->rows();
    out.middleRows(first, count) +=
        linalg::symmetric_product(*blocks_[b].divided_mass, X.middleRows(first, count));
  }
  return out;
}

void SystemPencil::factorise(double mu) {
  mu_ = mu;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const RestBody& place = tangent_.bodies[b];
    Block& block = blocks_[b];
    block.compliance = Eigen::MatrixXd::Zero(place.size(), place.size());
    block.compliance.topLeftCorner(place.num_frame(), place.num_frame()) = block.mobility / mu;
    if (!body.is_flexible()) continue;
    const fem::FeModel& fe = body.flexible->fe;
    const body::Sieve& sieve = body.flexible->sieve;
    try {
      block.factor = body::solver_of(*body.flexible)(body::shifted(fe.K, mu, fe.M));
    } catch (const NumericalError& error) {
      throw NumericalError("body \"" + body.name + "\": " + error.text());
    }
    Matrix load = block.loads;
    sieve.apply_transposed(load);
    block.response = block.factor->solve(load);
    sieve.apply(block.response);
    const int seen = place.rows + place.momenta;
    block.compliance.bottomRightCorner(seen, seen) = block.loads.transpose() * block.response;
  }
  factorise_small();
}

void SystemPencil::factorise_small() {
  const int n = tangent_.size;
  const int joints = static_cast<int>(tangent_.rows.rows());
  scale_ = Vector::Ones(n);
  std::vector<Triplet> entries;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Eigen::MatrixXd& F = blocks_[b].compliance;
    auto scale = scale_.segment(tangent_.bodies[b].first, F.rows());
    for (int i = 0; i < F.rows(); ++i) {
      if (F(i, i) > 0.0) scale[i] = std::sqrt(F(i, i));
    }
    const Vector inverse = scale.cwiseInverse();
    put_block(tangent_.bodies[b].first, tangent_.bodies[b].first,
              inverse.asDiagonal() * F * inverse.asDiagonal(), entries);
  }
  const SparseMatrix compliance = make_sparse(n, n, entries);
  gamma_ = tangent_.stiffness + SparseMatrix(mu_ * gyration_);
  gamma_ = SparseMatrix(scale_.asDiagonal() * gamma_ * scale_.asDiagonal());
  rows_ = tangent_.rows * scale_.asDiagonal();
  Vector size = Vector::Zero(joints);
  for (int j = 0; j < rows_.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(rows_, j); it; ++it) {
      size[it.row()] += it.value() * it.value();
    }
  }
  rows_ = SparseMatrix(size.cwiseMax(1e-300).cwiseSqrt().cwiseInverse().asDiagonal() * rows_);
  const SparseMatrix upper_left = compliance * gamma_;
  const SparseMatrix upper_right = compliance * SparseMatrix(rows_.transpose());
  entries.clear();
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, 1.0);
  for (int k = 0; k < joints; ++k) entries.emplace_back(n + k, n + k, 0.0);
  const auto put = [&](const SparseMatrix& block, int row, int column) {
    for (int j = 0; j < block.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(block, j); it; ++it) {
        entries.emplace_back(row + static_cast<int>(it.row()), column + j, it.value());
      }
    }
  };
  put(upper_left, 0, 0);
  put(upper_right, 0, n);
  put(rows_, n, 0);
  SparseMatrix A = make_sparse(n + joints, n + joints, entries);
  A.makeCompressed();
  small_ = std::make_unique<linalg::SparseLu>(A);
  if (!small_->factorise(A)) {
    throw NumericalError(
        "the linearised equations of motion are singular: joints may be redundant in this "
        "position, or a motion is exactly at its stability limit; try another position (--about)");
  }
}

/// s = E x for each column.
Matrix SystemPencil::seen(const Matrix& X) const {
  Matrix out(tangent_.size, X.cols());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const RestBody& place = tangent_.bodies[b];
    out.middleRows(place.first, place.num_frame()) = X.middleRows(first_[b], place.num_frame());
    if (blocks_[b].loads.cols() == 0) continue;
    out.middleRows(place.first + place.num_frame(), place.rows + place.momenta) =
        blocks_[b].loads.transpose() *
        X.middleRows(first_[b] + place.num_frame(), blocks_[b].loads.rows());
  }
  return out;
}

void SystemPencil::apply(Matrix& F) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const int frame = tangent_.bodies[b].num_frame();
    F.middleRows(first_[b], frame) = (block.mobility * F.middleRows(first_[b], frame) / mu_).eval();
    if (!block.factor) continue;
    const body::Sieve& sieve = model_.bodies[b].flexible->sieve;
    Matrix nodal = F.middleRows(first_[b] + frame, block.loads.rows());
    sieve.apply_transposed(nodal);
    nodal = block.factor->solve(nodal);
    sieve.apply(nodal);
    F.middleRows(first_[b] + frame, nodal.rows()) = nodal;
  }
  const int n = tangent_.size;
  Matrix small = Matrix::Zero(n + rows_.rows(), F.cols());
  small.topRows(n) = scale_.cwiseInverse().asDiagonal() * seen(F);
  small_->solve_in_place(small);
  Matrix load = gamma_ * small.topRows(n);
  load += rows_.transpose() * small.bottomRows(rows_.rows());
  load = (scale_.cwiseInverse().asDiagonal() * load).eval();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const RestBody& place = tangent_.bodies[b];
    const int frame = place.num_frame();
    F.middleRows(first_[b], frame) -= block.mobility * load.middleRows(place.first, frame) / mu_;
    if (!block.factor) continue;
    F.middleRows(first_[b] + frame, block.loads.rows()) -=
        block.response * load.middleRows(place.first + frame, place.rows + place.momenta);
  }
}

Matrix SystemPencil::zero_modes() const {
  int frames = 0;
  for (const RestBody& place : tangent_.bodies) frames += place.num_frame();
  if (frames == 0 || frames > kLargestFrames) return Matrix(size_, 0);
  // Frame coordinates of unit kinetic energy: columns over s.
  Matrix columns = Matrix::Zero(tangent_.size, frames);
  Matrix full = Matrix::Zero(size_, frames);
  int at = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const int count = tangent_.bodies[b].num_frame();
    const Matrix own = linalg::DenseCholesky(blocks_[b].mobility).lower();
    columns.block(tangent_.bodies[b].first, at, count, count) = own;
    full.block(first_[b], at, count, count) = own;
    at += count;
  }
  Matrix joints = tangent_.rows * columns;
  for (Eigen::Index k = 0; k < joints.rows(); ++k) {
    const double size = joints.row(k).norm();
    if (size > 0.0) joints.row(k) /= size;
  }
  const Matrix free = null_space(joints, kNoResistance);
  // Resistance in units of the compliance, so that forces and torques have equal weight.
  const Matrix resistance =
      scale_.asDiagonal() * Matrix(tangent_.stiffness * Matrix(columns * free));
  const Matrix lone = null_space(resistance, kNoResistance);
  Matrix out = full * (free * lone);
  if (out.cols() == 0) return out;
  const Matrix metric = out.transpose() * (M_ * out);
  return linalg::DenseCholesky(metric).solve_lower(out.transpose()).transpose();
}

std::vector<double> SystemPencil::energies(const Vector& x) const {
  std::vector<double> out;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Vector d = nodal_part(b, x);
    out.push_back(d.size() > 0 ? d.dot(model_.bodies[b].flexible->fe.K * d) : 0.0);
  }
  const Vector s = seen(x);
  out.push_back(s.dot(tangent_.stiffness * s));
  return out;
}

double SystemPencil::factor_entries() const {
  double out = small_ ? small_->num_factor_entries() : 0.0;
  for (const Block& block : blocks_) {
    if (block.factor) out += block.factor->num_factor_entries();
  }
  return out;
}

Eigen::Matrix<double, 6, 1> SystemPencil::frame_part(std::size_t body, const Vector& x) const {
  const RestBody& place = tangent_.bodies[body];
  Eigen::Matrix<double, 6, 1> out;
  out << model_.bodies[body].rotation_basis * x.segment(first_[body], place.rotations),
      model_.bodies[body].translation_basis *
          x.segment(first_[body] + place.rotations, place.translations);
  return out;
}

Vector SystemPencil::nodal_part(std::size_t body, const Vector& x) const {
  return x.segment(first_[body] + tangent_.bodies[body].num_frame(),
                   model_.bodies[body].num_dofs());
}

double SystemPencil::stiffest_frame() const {
  double out = 0.0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const int first = tangent_.bodies[b].first;
    for (int k = 0; k < tangent_.bodies[b].num_frame(); ++k) {
      out = std::max(out, std::abs(tangent_.stiffness.coeff(first + k, first + k)) *
                              blocks_[b].mobility(k, k));
    }
  }
  return out;
}

}  // namespace buckens::analysis

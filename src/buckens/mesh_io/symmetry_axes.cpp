// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/symmetry_axes.h"

#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "buckens/spatial/principal_axes.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr std::array<std::array<int, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

using CouplingTerms = Eigen::Matrix<double, 12, 1>;

/// xx, yy, zz with xy, yz, zx, and these with each other.
CouplingTerms couplings_of(const StiffnessMatrix& C) {
  CouplingTerms out;
  Eigen::Index count = 0;
  for (int column = 3; column < 6; ++column) {
    for (int row = 0; row < column; ++row) out[count++] = C(row, column);
  }
  return out;
}

int place_of_pair(int i, int j) {
  constexpr std::array<std::array<int, 3>, 3> kPlaces = {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
  return kPlaces[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
}

Matrix3d turned_by(const Matrix3d& axes, const Vector3d& by) {
  const double angle = by.norm();
  if (angle == 0.0) return axes;
  return axes * Eigen::AngleAxisd(angle, by / angle).toRotationMatrix();
}

/// Axes near these in which the couplings are least: damped Gauss–Newton steps over small turns.
Matrix3d least_coupling(const StiffnessMatrix& C, Matrix3d axes, double size) {
  constexpr int kSteps = 40;
  constexpr double kTurn = 1e-6;  // for central differences of smooth functions
  double damping = 1e-3;
  CouplingTerms here = couplings_of(in_axes(C, axes)) / size;
  for (int step = 0; step < kSteps && here.norm() > 1e-15 && damping < 1e6; ++step) {
    Eigen::Matrix<double, 12, 3> slope;
    for (int k = 0; k < 3; ++k) {
      const Vector3d turn = kTurn * Vector3d::Unit(k);
      slope.col(k) = (couplings_of(in_axes(C, turned_by(axes, turn))) -
                      couplings_of(in_axes(C, turned_by(axes, -turn)))) /
                     (2 * kTurn * size);
    }
    const Matrix3d normal = slope.transpose() * slope + damping * Matrix3d::Identity();
    const Vector3d turn = -normal.ldlt().solve(slope.transpose() * here);
    const Matrix3d next = turned_by(axes, turn);
    const CouplingTerms there = couplings_of(in_axes(C, next)) / size;
    if (there.norm() < here.norm()) {
      axes = next;
      here = there;
      damping *= 0.1;
    } else {
      damping *= 10;
    }
  }
  return axes;
}

/// Common axes of ∑ C_ijkk and ∑ C_ikjk, which are those of symmetry where these differ.
Matrix3d first_guess(const StiffnessMatrix& C) {
  Matrix3d sum = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        // Unlike shares, lest differences cancel.
        sum(i, j) += C(place_of_pair(i, j), k) + 0.37 * C(place_of_pair(i, k), place_of_pair(j, k));
      }
    }
  }
  Matrix3d axes = spatial::principal_axes(sum).vectors;
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

}  // namespace

StiffnessMatrix in_axes(const StiffnessMatrix& C, const Matrix3d& axes) {
  // Stresses in the axes are σ' = Rᵀ σ R, a matrix T of six numbers; strains with 2ε turn by T⁻ᵀ,
  // so C' = T C Tᵀ.
  StiffnessMatrix T;
  for (int column = 0; column < 6; ++column) {
    const auto& [p, q] = kPairs[static_cast<std::size_t>(column)];
    Matrix3d unit = Matrix3d::Zero();
    unit(p, q) = unit(q, p) = 1.0;
    const Matrix3d own = axes.transpose() * unit * axes;
    for (int row = 0; row < 6; ++row) {
      const auto& [i, j] = kPairs[static_cast<std::size_t>(row)];
      T(row, column) = own(i, j);
    }
  }
  const StiffnessMatrix out = T * C * T.transpose();
  return 0.5 * (out + out.transpose());
}

double coupling_of(const StiffnessMatrix& C) {
  return couplings_of(C).cwiseAbs().maxCoeff() / C.cwiseAbs().maxCoeff();
}

std::optional<Matrix3d> symmetry_axes(const StiffnessMatrix& C, double rounding) {
  const double size = C.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return std::nullopt;
  const Matrix3d guess = first_guess(C);
  // Starts around the guess, for materials whose axes are not found from it.
  constexpr int kStarts = 4;
  for (int a = 0; a < kStarts; ++a) {
    for (int b = 0; b < kStarts; ++b) {
      for (int c = 0; c < kStarts; ++c) {
        const Vector3d turn = Vector3d(a, b, c) * (1.5 / kStarts);
        const Matrix3d axes = least_coupling(C, turned_by(guess, turn), size);
        if (coupling_of(in_axes(C, axes)) <= rounding) return axes;
      }
    }
  }
  return std::nullopt;
}

std::optional<fem::OrthotropicSpec> orthotropic_constants(const StiffnessMatrix& C) {
  const Matrix3d stretch = C.topLeftCorner<3, 3>();
  if (Eigen::LLT<Matrix3d>(stretch).info() != Eigen::Success ||
      !(C.diagonal().tail<3>().minCoeff() > 0)) {
    return std::nullopt;
  }
  const Matrix3d S = stretch.inverse();
  fem::OrthotropicSpec out;
  out.E1 = 1.0 / S(0, 0);
  out.E2 = 1.0 / S(1, 1);
  out.E3 = 1.0 / S(2, 2);
  out.nu12 = -S(1, 0) / S(0, 0);
  out.nu13 = -S(2, 0) / S(0, 0);
  out.nu23 = -S(2, 1) / S(1, 1);
  out.G12 = C(3, 3);
  out.G23 = C(4, 4);
  out.G13 = C(5, 5);
  return out;
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lowest_frequency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "buckens/linalg/symmetric_eigen.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostSolves = 100;
// Error of ω² at which the iteration ends, as a share.
constexpr double kSettled = 0.01;
// It also ends when this many solves have lowered ω² by less than this share: what is left then
// falls too slowly for reports.
constexpr int kSolvesLookedAt = 4;
constexpr double kSteady = 0.001;
// Vectors whose mass beyond the others is below this fraction add nothing.
constexpr double kNothingNew = 1e-10;

constexpr double kDependentVector = 1e-10;

// Bodies whose least principal inertia is below this share of the largest are slender.
constexpr double kSlender = 0.1;
// Degree of polynomials along slender bodies.
constexpr int kMostAlong = 7;

/// A displacement along a principal axis of inertia by a monomial of the principal coordinates.
struct SmoothField {
  std::array<int, 3> powers;
  int axis;
};

/// Displacements by monomials of degree 1 to 3; along slender bodies of more, as beams bend.
/// @param inertia principal ones, ascending: the first axis is along the body
std::vector<SmoothField> smooth_fields(const Vector3d& inertia) {
  std::vector<SmoothField> out;
  for (int degree = 1; degree <= 3; ++degree) {
    for (int i = degree; i >= 0; --i) {
      for (int j = degree - i; j >= 0; --j) {
        for (int axis = 0; axis < 3; ++axis) out.push_back({{i, j, degree - i - j}, axis});
      }
    }
  }
  if (inertia[0] > kSlender * inertia[2]) return out;
  for (int degree = 4; degree <= kMostAlong; ++degree) {
    for (int axis = 0; axis < 3; ++axis) out.push_back({{degree, 0, 0}, axis});
    out.push_back({{degree - 1, 1, 0}, 0});  // sections turn
    out.push_back({{degree - 1, 0, 1}, 0});
  }
  return out;
}

double value(const std::array<int, 3>& powers, const Vector3d& p) {
  return std::pow(p.x(), powers[0]) * std::pow(p.y(), powers[1]) * std::pow(p.z(), powers[2]);
}

Vector3d gradient(const std::array<int, 3>& powers, const Vector3d& p) {
  Vector3d out = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (powers[k] == 0) continue;
    std::array<int, 3> lower = powers;
    --lower[k];
    out[static_cast<Eigen::Index>(k)] = powers[k] * value(lower, p);
  }
  return out;
}

/// Such displacements of the nodes, rotations by half their curl.
/// @param axes principal axes of inertia as columns
Vector nodal_values(const body::FlexiblePart& part, const SmoothField& field,
                    const Eigen::Matrix3d& axes) {
  const fem::FeModel& fe = part.fe;
  // Lengths of one keep high and low powers comparable.
  const double size = std::sqrt(0.5 * fe.shape.J0.trace() / fe.shape.mass);
  const Vector3d along = Vector3d::Unit(field.axis);
  Vector out = Vector::Zero(part.num_dofs());
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Vector3d p = axes.transpose() * (fe.nodes[node].position - fe.shape.com) / size;
    Eigen::Matrix<double, 6, 1> u;
    u.head<3>() = size * value(field.powers, p) * (axes * along);
    u.tail<3>() = axes * (0.5 * gradient(field.powers, p).cross(along));
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[node][k];
      if (dof >= 0 && dof < out.size()) out[dof] = u[static_cast<Eigen::Index>(k)];
    }
  }
  return out;
}

/// The combination of vectors with the least Rayleigh quotient. @param M, K their projections
Vector least_combination(const Matrix& M, const Matrix& K) {
  const Vector scale = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const linalg::SymmetricEigen mass =
      linalg::symmetric_eigen(scale.asDiagonal() * M * scale.asDiagonal());
  const auto kept = (mass.values.array() > kNothingNew * mass.values.maxCoeff());
  const auto rank = static_cast<Eigen::Index>(kept.count());
  if (rank == 0) return Vector::Zero(M.rows());
  const Matrix T = scale.asDiagonal() * mass.vectors.rightCols(rank) *
                   mass.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  return T * linalg::symmetric_eigen(T.transpose() * K * T).vectors.col(0);
}

/// XᵀA X, column by column: A X would take as much memory as X.
Matrix projected(const linalg::SymmetricMatrix& A, const Eigen::Ref<const Matrix>& X) {
  Matrix out(X.cols(), X.cols());
  Vector image(X.rows());
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    image = A * X.col(k);
    out.col(k).noalias() = X.transpose() * image;
  }
  return out;
}

/// The best shape among polynomials of the place.
Vector smooth_shape(const body::FlexiblePart& part) {
  const spatial::PrincipalAxes principal = spatial::principal_axes(part.fe.shape.J0);
  Eigen::Matrix3d axes = principal.vectors;
  axes.col(2) = axes.col(0).cross(axes.col(1));  // curls ask for a right-handed system
  const auto fields = smooth_fields(principal.values);
  Matrix basis(part.num_dofs(), std::ssize(fields));
  Eigen::Index count = 0;
  for (const SmoothField& field : fields) {
    Vector x = nodal_values(part, field, axes);
    const double before = x.norm();
    part.sieve.apply(x);
    // Of rigid motion only rounding is left.
    if (x.norm() > kDependentVector * before) basis.col(count++) = x;
  }
  const auto kept = basis.leftCols(count);
  const Matrix M = projected(part.fe.M, kept);
  const Matrix K = projected(part.fe.K, kept);
  Vector out = kept * least_combination(M, K);
  part.sieve.apply(out);
  return out;
}

bool is_steady(std::span<const double> squares, int k) {
  if (k < kSolvesLookedAt) return false;
  const double before = squares[static_cast<std::size_t>(k - kSolvesLookedAt)];
  return before - squares[static_cast<std::size_t>(k)] < kSteady * before;
}

}  // namespace

double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op) {
  if (part.num_dofs() <= part.sieve.rank()) return 0.0;
  const linalg::SymmetricMatrix& M = part.fe.M;
  const linalg::SymmetricMatrix& K = part.fe.K;
  // Shape, correction, last way, and what M and K make of them.
  Matrix span(part.num_dofs(), 3), with_M(part.num_dofs(), 3), with_K(part.num_dofs(), 3);
  span.col(0) = smooth_shape(part);
  Vector product_M, product_K;
  int columns = 1;
  double square = 0;
  std::array<double, kMostSolves + 1> squares{};
  for (int k = 0; k <= kMostSolves; ++k) {
    const int fresh = columns == 1 ? 0 : 1;
    const Vector direction = span.col(fresh);
    linalg::multiply({{&M, &direction, &product_M}, {&K, &direction, &product_K}});
    with_M.col(fresh) = product_M;
    with_K.col(fresh) = product_K;
    Vector best = Vector::Ones(1);
    const auto vectors = span.leftCols(columns);
    if (columns > 1) {
      best = least_combination(vectors.transpose() * with_M.leftCols(columns),
                               vectors.transpose() * with_K.leftCols(columns));
    }
    const Vector x = vectors * best;
    const Vector Mx = with_M.leftCols(columns) * best;
    const Vector Kx = with_K.leftCols(columns) * best;
    const double mass = x.dot(Mx);
    if (!(mass > 0.0)) break;
    square = std::max(0.0, x.dot(Kx) / mass);
    squares[static_cast<std::size_t>(k)] = square;
    if (k == kMostSolves || is_steady(squares, k)) break;
    const Vector residual = Kx - square * Mx;
    Vector correction = residual;
    op.solve(correction);
    // ‖r‖² in the metric of M⁻¹, nearly: slow shapes see the mass part of the step matrix only.
    double stiffness = op.scheme().mass * mass + op.scheme().stiffness * x.dot(Kx);
    if (part.is_damped()) stiffness += op.scheme().damping * x.dot(part.C * x);
    const double error = residual.dot(correction) * stiffness / (mass * mass);
    if (!(error > kSettled * square * square)) break;
    if (columns > 1) {
      const auto way = best.segment(1, columns - 1);
      for (Matrix* of : {&span, &with_M, &with_K}) {
        of->col(2) = (of->middleCols(1, columns - 1) * way).eval();
      }
      columns = 3;
    } else {
      columns = 2;
    }
    span.col(0) = x;
    with_M.col(0) = Mx;
    with_K.col(0) = Kx;
    span.col(1) = correction;
  }
  return std::sqrt(square);
}

}  // namespace buckens::stepping

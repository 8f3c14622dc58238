// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lowest_frequency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "buckens/stepping/least_quotient.h"
#include "buckens/stepping/smooth_shape.h"

namespace buckens::stepping {

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

bool is_steady(std::span<const double> squares, int k) {
  if (k < kSolvesLookedAt) return false;
  const double before = squares[static_cast<std::size_t>(k - kSolvesLookedAt)];
  return before - squares[static_cast<std::size_t>(k)] < kSteady * before;
}

}  // namespace

double lowest_frequency(const body::FlexiblePart& part, BodyStepOperator& op, TaskPool* pool) {
  if (part.num_dofs() <= part.sieve.rank()) return 0.0;
  const linalg::SymmetricMatrix& M = part.fe.M;
  const linalg::SymmetricMatrix& K = part.fe.K;
  // Shape, correction, last way, and what M and K make of them.
  Matrix span(part.num_dofs(), 3), with_M(part.num_dofs(), 3), with_K(part.num_dofs(), 3);
  span.col(0) = smooth_shape(part, pool);
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
    op.solve(correction, pool);
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

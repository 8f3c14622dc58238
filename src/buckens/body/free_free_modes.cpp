// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/free_free_modes.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/dense_free_modes.h"
#include "buckens/body/iterated_modes.h"
#include "buckens/body/mesh_solver.h"
#include "buckens/body/shared_free_modes.h"
#include "buckens/body/shift_estimate.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr Eigen::Index kFewModes = 8;

/// μ somewhat below the estimate, which is an upper bound.
double first_shift(const FlexiblePart& part) {
  const double bound = lowest_square_estimate(part);
  return bound > 0.0 ? 0.3 * bound : cautious_shift(part.fe.M, part.fe.K);
}

bool has_shared_factor(const FlexiblePart& part) {
  if (!linalg::is_shared_work(part.num_dofs())) return false;
  linalg::MatrixSum sum;
  sum.add(1.0, part.fe.K);
  sum.add(1.0, part.fe.M);
  return !decide_solver(part.solver, sum).iterates;
}

/// @throws ModelError if the method needs other processes and there are none for this body
void require_shared_factor(const FlexiblePart& part) {
  if (has_shared_factor(part)) return;
  throw ModelError(
      fmt::format("method slepc: no processes share the factor of this body of {} variables; start "
                  "several with mpirun, for a large body without an iterative solver, or use the "
                  "method subspace",
                  part.num_dofs()));
}

IteratedModes iterate(const FlexiblePart& part, FreeModeMethod method,
                      const FreeModesSettings& settings, int count) {
  const linalg::SymmetricMatrix& M = part.fe.M;
  const linalg::SymmetricMatrix& K = part.fe.K;
  switch (method) {
    case FreeModeMethod::augmented:
      return iterate_modes(M, part.sieve, augmented_operator(K, part.sieve), count,
                           settings.tolerance);
    case FreeModeMethod::penalty:
      return iterate_modes(M, part.sieve,
                           penalty_operator(M, K, part.sieve, highest_square(M, K),
                                            first_shift(part), solver_of(part)),
                           count, settings.tolerance);
    case FreeModeMethod::spectra: {
      // The shift comes from the iteration for one mode, which corrects the estimate.
      IteratedModes probe =
          iterate_with_shift(M, K, part.sieve, first_shift(part), 1, 1e-3, solver_of(part));
      IteratedModes out = lanczos_modes(M, std::move(probe.op), count, settings.tolerance);
      out.solves += probe.solves;
      out.factorisations = probe.factorisations;
      return out;
    }
    case FreeModeMethod::slepc:
      return shared_free_modes(M, K, part.sieve, first_shift(part), count, settings.tolerance);
    default:
      return iterate_with_shift(M, K, part.sieve, first_shift(part), count, settings.tolerance,
                                solver_of(part));
  }
}

FreeFreeModes solve_dense(const FlexiblePart& part) {
  if (part.num_dofs() > kLargestDense) {
    throw ModelError(
        fmt::format("method dense: {} nodal variables, more than {}; use the method subspace",
                    part.num_dofs(), kLargestDense));
  }
  FreeFreeModes out;
  static_cast<FreeModes&>(out) =
      dense_free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), part.sieve);
  out.factorisations = 1;
  const auto n = static_cast<double>(part.num_dofs());
  out.factor_entries = 0.5 * n * (n + 1.0);
  return out;
}

/// Residuals and errors of some of the modes.
void judge(const FlexiblePart& part, const ModeOperator& op, Eigen::Index first, Eigen::Index count,
           FreeFreeModes& out) {
  TaskPool* pool = op.pool;
  const Matrix shapes = out.shapes.middleCols(first, count);
  const Vector scale = variable_scale(part.fe.M, part.fe.K);
  const Matrix Mphi = linalg::symmetric_product(part.fe.M, shapes, pool);
  const Vector squares = out.omega.segment(first, count).cwiseAbs2();
  const Matrix inertia = Mphi * squares.asDiagonal();
  const Matrix left = linalg::symmetric_product(part.fe.K, shapes, pool) - inertia;
  out.residual.segment(first, count) =
      (scale.asDiagonal() * left)
          .colwise()
          .norm()
          .cwiseQuotient((scale.asDiagonal() * inertia).colwise().norm())
          .transpose();
  Matrix image = Mphi;
  op.inverse(image);
  out.solves += image.cols();
  image = shapes - image * (squares.array() + op.shift).matrix().asDiagonal();
  const Matrix of_image = linalg::symmetric_product(part.fe.M, image, pool);
  out.error.segment(first, count) =
      image.cwiseProduct(of_image).colwise().sum().cwiseMax(0.0).cwiseSqrt();
}

/// A process that has nothing else of so large a body takes few vectors at a time.
void judge(const FlexiblePart& part, const ModeOperator& op, FreeFreeModes& out) {
  const Eigen::Index count = out.omega.size();
  const Eigen::Index most = out.method == FreeModeMethod::slepc ? kFewModes : count;
  out.residual.resize(count);
  out.error.resize(count);
  for (Eigen::Index first = 0; first < count; first += most) {
    judge(part, op, first, std::min(most, count - first), out);
  }
}

}  // namespace

std::string to_string(FreeModeMethod method) {
  return choice_names(method)[static_cast<std::size_t>(method)];
}

FreeFreeModes free_free_modes(const FlexiblePart& part, const FreeModesSettings& settings) {
  const Eigen::Index elastic = part.num_dofs() - part.sieve.rank();
  const Eigen::Index wanted = std::clamp<Eigen::Index>(settings.count, 0, elastic);
  FreeFreeModes out;
  out.method = settings.method;
  if (out.method == FreeModeMethod::automatic) {
    refuse_too_many_modes(part.num_dofs(), wanted);
    if (is_dense_better(part.num_dofs(), wanted)) {
      out.method = FreeModeMethod::dense;
    } else {
      out.method = has_shared_factor(part) ? FreeModeMethod::slepc : FreeModeMethod::subspace;
    }
  } else if (out.method == FreeModeMethod::slepc) {
    require_shared_factor(part);
  }
  if (wanted == 0) {
    out.shapes.resize(part.num_dofs(), 0);
    return out;
  }
  const bool is_dense = out.method == FreeModeMethod::dense;
  ModeOperator op;
  if (is_dense) {
    const FreeModeMethod method = out.method;
    out = solve_dense(part);
    out.method = method;
    const Eigen::Index found = std::min(wanted, out.omega.size());
    out.omega = out.omega.head(found).eval();
    out.shapes = out.shapes.leftCols(found).eval();
  } else {
    IteratedModes iterated = iterate(part, out.method, settings, static_cast<int>(wanted));
    static_cast<FreeModes&>(out) = std::move(iterated.modes);
    op = std::move(iterated.op);
    out.shift = op.shift;
    out.penalty = op.penalty;
    out.factor_entries = op.factor_entries;
    out.sweeps = iterated.sweeps;
    out.solves = iterated.solves;
    out.factorisations = iterated.factorisations;
  }
  if (out.omega.size() == 0) return out;
  if (is_dense && (settings.judge || settings.condition)) {
    const double lowest = out.omega[0] * out.omega[0];
    op = sieved_operator(part.fe.M, part.fe.K, part.sieve,
                         std::max(lowest, 1e-13 * highest_square(part.fe.M, part.fe.K)));
  }
  if (settings.judge) judge(part, op, out);
  if (settings.condition) out.condition = estimate_condition(op);
  return out;
}

FreeFreeModes free_free_modes(const FlexiblePart& part, int count) {
  return free_free_modes(part, {.count = count, .judge = false});
}

}  // namespace buckens::body

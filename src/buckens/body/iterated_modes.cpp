// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/iterated_modes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/dense_free_modes.h"
#include "buckens/body/shift_search.h"
#include "buckens/linalg/cholmod_factor.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

constexpr int kRestarts = 300;  // of Lanczos
// A factor takes right-hand sides in fours (linalg::side_multiple()): six cost as much as eight.
constexpr int kBlock = 8;
// Rigid modes of the penalty form hold all of their inertia in rigid motion, others none.
constexpr double kRigidShare = 0.5;

linalg::InverseIterationSettings settings_for(int count, double tolerance) {
  linalg::InverseIterationSettings settings;
  settings.count = count;
  settings.tolerance = tolerance;
  settings.block = kBlock;
  return settings;
}

/// Takes ω and shapes from the eigenpairs, without rigid ones.
FreeModes elastic_modes(const linalg::InversePairs& pairs, const Sieve& sieve,
                        const ModeOperator& op, int count) {
  std::vector<Eigen::Index> kept;
  const Vector rigid = (sieve.P().transpose() * pairs.shapes).colwise().squaredNorm().transpose();
  for (Eigen::Index k = 0; k < pairs.theta.size(); ++k) {
    if (static_cast<int>(kept.size()) < count && rigid[k] < kRigidShare) kept.push_back(k);
  }
  FreeModes modes{Vector(static_cast<Eigen::Index>(kept.size())),
                  Matrix(pairs.shapes.rows(), static_cast<Eigen::Index>(kept.size()))};
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto to = static_cast<Eigen::Index>(k);
    modes.omega[to] = std::sqrt(std::max(0.0, 1.0 / pairs.theta[kept[k]] - op.shift));
    modes.shapes.col(to) = pairs.shapes.col(kept[k]);
  }
  return modes;
}

void check_complete(const linalg::InversePairs& pairs, int count) {
  if (pairs.is_complete) return;
  throw NumericalError(fmt::format(
      "free vibration: the {} lowest modes did not converge in {} sweeps; ask for fewer modes",
      count, pairs.sweeps));
}

/// The operator in the shape that Spectra calls.
struct SpectraInverse {
  using Scalar = double;
  const ModeOperator* op;
  Eigen::Index size;
  long* solves;

  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void set_shift(double /*sigma*/) {}
  void perform_op(const double* x, double* y) const {
    Matrix work = Eigen::Map<const Vector>(x, size);
    op->inverse(work);
    Eigen::Map<Vector>(y, size) = work;
    ++*solves;
  }
};

struct SpectraMass {
  using Scalar = double;
  const SymmetricMatrix* M;

  Eigen::Index rows() const { return M->rows(); }
  Eigen::Index cols() const { return M->cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()).noalias() = *M * Eigen::Map<const Vector>(x, rows());
  }
};

}  // namespace

double highest_square(const SymmetricMatrix& M, const SymmetricMatrix& K) {
  const Vector scale = variable_scale(M, K);
  return K.diagonal().cwiseProduct(scale.cwiseAbs2()).maxCoeff();
}

double cautious_shift(const SymmetricMatrix& M, const SymmetricMatrix& K) {
  return 1e-9 * highest_square(M, K);
}

IteratedModes iterate_modes(const SymmetricMatrix& M, const Sieve& sieve, ModeOperator op,
                            int count, double tolerance) {
  // If a large part of all modes is wanted, the rigid ones of the penalty form would be among them,
  // mixed with vibrations of the same eigenvalue.
  const bool may_meet_rigid_ones = op.penalty > 0.0 && 20 * count > M.rows();
  linalg::InverseIterationSettings settings = settings_for(count, tolerance);
  settings.pool = op.pool;
  const linalg::InversePairs pairs = linalg::largest_inverse_pairs(
      M, op.inverse, may_meet_rigid_ones ? sieve.Phi() : Matrix(M.rows(), 0), settings);
  check_complete(pairs, count);
  IteratedModes out{elastic_modes(pairs, sieve, op, count), std::move(op), pairs.sweeps,
                    pairs.solves, 1};
  return out;
}

IteratedModes iterate_with_shift(const SymmetricMatrix& M, const SymmetricMatrix& K,
                                 const Sieve& sieve, double first_shift, int count,
                                 double tolerance, const linalg::MakeFactor& make) {
  ShiftSearch search(first_shift, highest_square(M, K));
  long solves = 0;
  linalg::InverseIterationSettings settings = settings_for(count, tolerance);
  for (;;) {
    const double shift = search.shift();
    std::optional<ModeOperator> op;
    try {
      op = sieved_operator(M, K, sieve, shift, make);
    } catch (const linalg::IndefiniteMatrix&) {
      if (!search.raise()) throw;
      continue;
    }
    std::optional<double> far_below;  // the lowest ω² where the shift is too high
    settings.is_worthwhile = [&](double theta) {
      const double square = 1.0 / theta - shift;
      if (search.is_too_high(square)) far_below = square;
      return !far_below.has_value();
    };
    settings.pool = op->pool;
    const linalg::InversePairs pairs =
        linalg::largest_inverse_pairs(M, op->inverse, Matrix(M.rows(), 0), settings);
    solves += pairs.solves;
    if (far_below) {
      search.lower(*far_below);
      continue;
    }
    check_complete(pairs, count);
    return {elastic_modes(pairs, sieve, *op, count), std::move(*op), pairs.sweeps, solves,
            search.attempt()};
  }
}

IteratedModes lanczos_modes(const SymmetricMatrix& M, ModeOperator op, int count,
                            double tolerance) {
  IteratedModes out;
  out.op = std::move(op);
  out.factorisations = 1;
  SpectraInverse inverse{&out.op, M.rows(), &out.solves};
  SpectraMass mass{&M};
  const auto basis = std::min(M.rows(), std::max<Eigen::Index>(2 * count + 8, 24));
  Spectra::SymGEigsShiftSolver<SpectraInverse, SpectraMass, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, mass, count, basis, -out.op.shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, kRestarts, std::min(1e-10, tolerance),
                 Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) {
    throw NumericalError(fmt::format(
        "free vibration: the {} lowest modes did not converge in {} Lanczos restarts; ask for "
        "fewer modes or use the method subspace",
        count, kRestarts));
  }
  out.sweeps = static_cast<int>(solver.num_iterations());
  out.modes = {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), solver.eigenvectors()};
  return out;
}

}  // namespace buckens::body

// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/shared_free_modes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/shared_modes.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

// θ = 1/(ω² + μ) tells little about an ω² that is so many times smaller than μ.
constexpr double kShiftOverLowest = 30.0;
constexpr double kRoundingOfSquares = 1e-13;  // μ against the largest ω²
constexpr int kMostFactors = 12;

}  // namespace

IteratedModes shared_free_modes(const SymmetricMatrix& M, const SymmetricMatrix& K,
                                const Sieve& sieve, double first_shift, int count,
                                double tolerance) {
  const double least = kRoundingOfSquares * highest_square(M, K);
  double shift = std::max(first_shift, least);
  double drowned = 0.0;  // largest shift that did not work
  long solves = 0;
  const Matrix Phi = sieve.Phi();
  for (int attempt = 1; attempt <= kMostFactors; ++attempt) {
    std::shared_ptr<const linalg::Factor> factor;
    ModeOperator op;  // the one that the search has, for vectors of this process
    try {
      op = sieved_operator(M, K, sieve, shift, [&factor](const linalg::MatrixSum& A) {
        return factor = linalg::make_large_factor(A);
      });
    } catch (const linalg::IndefiniteMatrix&) {
      if (attempt == kMostFactors) throw;
      drowned = shift;
      shift *= 30.0;
      continue;
    }
    linalg::InversePairs pairs;
    if (!factor->find_pairs({&K, &M, shift, &Phi, count, tolerance}, pairs)) {
      throw NumericalError("free vibration: the factor of this body is not one of processes");
    }
    solves += pairs.solves;
    if (!pairs.is_complete) {
      throw NumericalError(
          fmt::format("free vibration: the {} lowest modes did not converge in {} restarts of "
                      "SLEPc; ask for fewer modes or use the method subspace",
                      count, pairs.sweeps));
    }
    const Vector squares = (pairs.theta.cwiseInverse().array() - shift).cwiseMax(0.0);
    const double lowest_useful = std::max(least, 10.0 * drowned);
    if (squares[0] * kShiftOverLowest < shift && shift > lowest_useful && attempt < kMostFactors) {
      shift = std::max(lowest_useful, std::max(0.3 * squares[0], 1e-3 * shift));
      continue;
    }
    IteratedModes out;
    out.modes = {squares.cwiseSqrt(), std::move(pairs.shapes)};
    out.op = std::move(op);
    out.sweeps = pairs.sweeps;
    out.solves = solves;
    out.factorisations = attempt;
    return out;
  }
  throw NumericalError("free vibration: no shift makes K + μM positive definite; check the masses");
}

}  // namespace buckens::body

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/free_modes.h"
#include "buckens/body/mode_operator.h"

namespace buckens::body {

/// Modes from an iteration, with the operator used and its cost.
struct IteratedModes {
  FreeModes modes;
  ModeOperator op;
  int sweeps = 0;
  long solves = 0;
  int factorisations = 0;
};

/// Simultaneous inverse iteration with an operator; rigid motions that it lets through are dropped.
/// @throws NumericalError if it does not converge
IteratedModes iterate_modes(const linalg::SymmetricMatrix& M, const Sieve& sieve, ModeOperator op,
                            int count, double tolerance);

/// The same on Y (K + μM)⁻¹M, FM (31), with a suitable μ: it starts with `first_shift`; if the
/// lowest ω² turns out to be far below, it restarts with that, and a shift lost in the rounding of
/// K is raised.
IteratedModes iterate_with_shift(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K,
                                 const Sieve& sieve, double first_shift, int count,
                                 double tolerance,
                                 const linalg::MakeFactor& make = linalg::make_cholesky);

/// Lanczos with implicit restarts of the Spectra library.
/// @throws NumericalError if it does not converge
IteratedModes lanczos_modes(const linalg::SymmetricMatrix& M, ModeOperator op, int count,
                            double tolerance);

/// First shift when nothing is known: far above rounding, below most ω² [1/s²].
double cautious_shift(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K);
/// Approximate upper bound of ω²: the largest of K_ii/M_ii [1/s²].
double highest_square(const linalg::SymmetricMatrix& M, const linalg::SymmetricMatrix& K);

}  // namespace buckens::body

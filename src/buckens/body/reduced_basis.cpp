// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduced_basis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/body/elastic_inverse.h"
#include "buckens/body/fixed_interface_modes.h"
#include "buckens/body/free_modes.h"
#include "buckens/body/mode_groups.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/pseudo_inverse.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Residuals whose mass is below this fraction of the largest follow from the others and the modes:
// rounding leaves 1e-16 · (ω/ω₁)², a real one about 1e-6.
constexpr double kDependent = 1e-11;
// Rounding of the sieve leaves 1e-15.
constexpr double kStraining = 1e-9;
// Vibrations computed at first where only a cutoff frequency is given.
constexpr int kFirstTrial = 16;

/// M-orthonormal basis of the span of the columns, dependent ones left out.
Matrix orthonormalised(const linalg::SymmetricMatrix& M, const Matrix& columns) {
  if (columns.cols() == 0) return columns;
  const Vector size = (columns.transpose() * (M * columns)).diagonal().cwiseMax(0.0).cwiseSqrt();
  Matrix scaled = columns;
  for (Eigen::Index k = 0; k < size.size(); ++k) {
    if (size[k] > 0.0) scaled.col(k) /= size[k];
  }
  const Matrix gram = scaled.transpose() * (M * scaled);
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(gram);
  Matrix out(columns.rows(), 0);
  for (Eigen::Index k = gram.cols() - 1; k >= 0; --k) {
    if (eigen.values[k] < kDependent) break;
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    out.rightCols<1>() = scaled * eigen.vectors.col(k) / std::sqrt(eigen.values[k]);
  }
  return out;
}

/// As many modes, but no more than variables, so that others can be added.
int at_most(const FlexiblePart& part, int modes) {
  return static_cast<int>(std::min<Eigen::Index>(modes, part.num_dofs()));
}

/// Unit loads on the interface rows, Nᵀ, those along patterns included.
Matrix interface_loads(const FlexiblePart& part) {
  const SparseMatrix N = part.rows.topRows(part.num_interface_rows);
  return Matrix(SparseMatrix(N.transpose()));
}

/// The loads that do more than accelerate the body as a whole: those whose sieved part exceeds
/// rounding.
Matrix straining(const FlexiblePart& part, const Matrix& loads) {
  const Vector weight = part.fe.K.diagonal().unaryExpr(
      [](double stiffness) { return stiffness > 0.0 ? 1.0 / std::sqrt(stiffness) : 0.0; });
  Matrix kept(loads.rows(), 0);
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    Vector sieved = loads.col(k);
    part.sieve.apply_transposed(sieved);
    const double whole = weight.cwiseProduct(loads.col(k)).norm();
    if (!(weight.cwiseProduct(sieved).norm() > kStraining * whole)) continue;
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    kept.rightCols<1>() = sieved;
  }
  return kept;
}

/// Straining loads and the deformations K⁺f.
struct StaticShapes {
  Matrix loads, shapes;
};

StaticShapes static_shapes(const FlexiblePart& part, const ElasticInverse& inverse,
                           const Matrix& all_loads) {
  StaticShapes out{straining(part, all_loads), {}};
  out.shapes = inverse.solve_checked(out.loads);
  return out;
}

/// The part of the shapes beyond the modes, (1 − φφᵀM) s, M-orthonormal.
Matrix residuals(const linalg::SymmetricMatrix& M, const Matrix& modes, Matrix shapes) {
  const Vector whole = (shapes.transpose() * (M * shapes)).diagonal();
  // Twice, so that what is left is orthogonal to rounding.
  for (int pass = 0; pass < 2; ++pass) shapes -= modes * (modes.transpose() * (M * shapes));
  const Vector left = (shapes.transpose() * (M * shapes)).diagonal();
  Matrix kept(shapes.rows(), 0);
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    if (!(left[k] > kDependent * whole[k])) continue;
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    kept.rightCols<1>() = shapes.col(k);
  }
  return orthonormalised(M, kept);
}

/// Largest share of the static compliance fᵀK⁺f that K-orthogonal shapes lack.
double lacking_share(const StaticShapes& exact, const Matrix& Z, const Vector& omega) {
  double share = 0;
  for (Eigen::Index k = 0; k < exact.loads.cols(); ++k) {
    const double whole = exact.loads.col(k).dot(exact.shapes.col(k));
    const Vector amplitudes = (Z.transpose() * exact.loads.col(k)).cwiseQuotient(omega);
    if (whole > 0.0) share = std::max(share, 1.0 - amplitudes.squaredNorm() / whole);
  }
  return share;
}

Matrix beside(const Matrix& left, const Matrix& right) {
  Matrix out(left.rows(), left.cols() + right.cols());
  out << left, right;
  return out;
}

/// Brings the columns to ZᵀMZ = 1 and ZᵀKZ = diag(ω²).
void diagonalise(const FlexiblePart& part, const Matrix& columns, ReducedBasis& out) {
  if (columns.cols() == 0) {  // which Eigen's solver does not take
    out.omega.resize(0);
    out.Z = columns;
    out.num_residuals = -out.num_modes;
    return;
  }
  const Matrix K = columns.transpose() * (part.fe.K * columns);
  const Matrix M = columns.transpose() * (part.fe.M * columns);
  const auto eigen =
      linalg::generalised_eigen(0.5 * (K + K.transpose()), 0.5 * (M + M.transpose()));
  if (!eigen) throw NumericalError("reduced body: its shapes depend on each other");
  out.omega = eigen->values.cwiseMax(0.0).cwiseSqrt();
  out.Z = columns * eigen->vectors;
  out.num_residuals = static_cast<int>(columns.cols()) - out.num_modes;
}

/// Interface loads that only strain the body, whatever its inertia: ΦᵀNᵀE = 0.
Matrix self_equilibrated(const FlexiblePart& part, const Matrix& loads) {
  const Matrix resultants = part.sieve.Phi().transpose() * loads;
  return loads * linalg::PivotedQr(resultants.transpose(), kStraining).complement();
}

/// Patterns, held by interface loads as far as those have resultants, and not by inertia.
Matrix held_by(const FlexiblePart& part, const Matrix& patterns, const Matrix& loads) {
  if (patterns.cols() == 0 || loads.cols() == 0) return patterns;
  const Matrix Phi = part.sieve.Phi();
  linalg::PseudoInverse from_resultants;
  from_resultants.compute(Phi.transpose() * loads);
  const Matrix amounts = from_resultants * Matrix(Phi.transpose() * patterns);
  return patterns - loads * amounts;
}

/// The lowest free vibrations, without leaving out partners of equal frequency.
FreeModes free_groups(const FlexiblePart& part, int modes) {
  return lowest_groups(at_most(part, modes), [&part, Phi = part.sieve.Phi()](int count) {
    return free_modes(part.fe.M, part.fe.K, Phi, count);
  });
}

/// Elastic vibrations with held interface, sieved.
struct HeldModes {
  Matrix shapes;
  Vector omega;
};

HeldModes held_modes(const FlexiblePart& part, const CraigBamptonChoice& choice) {
  const Matrix N = part.rows.topRows(part.num_held_rows());
  const linalg::PivotedQr held(N * part.sieve.Phi(), kStraining);
  const auto loose = static_cast<int>(part.sieve.rank() - held.rank());
  const auto lowest = [&part](int count) { return fixed_interface_modes(part, count); };
  const FreeModes found = choice.modes ? lowest_groups(at_most(part, *choice.modes) + loose, lowest)
                                       : groups_up_to(choice.cutoff, kFirstTrial + loose, lowest);
  const Eigen::Index first = std::min<Eigen::Index>(loose, found.omega.size());
  const Eigen::Index count = found.omega.size() - first;
  HeldModes out{found.shapes.rightCols(count), found.omega.tail(count)};
  part.sieve.apply(out.shapes);
  return out;
}

}  // namespace

ReducedBasis free_free_basis(const std::string& body, const FlexiblePart& part, int modes,
                             bool static_correction, double length) {
  const FreeModes free = free_groups(part, modes);
  ReducedBasis out;
  out.num_modes = static_cast<int>(free.omega.size());
  Matrix columns = free.shapes;
  if (part.num_interface_rows > 0 && free.omega.size() > 0) {
    const ElasticInverse inverse(body, part.fe, part.sieve, length, linalg::make_large_factor);
    const StaticShapes exact = static_shapes(part, inverse, interface_loads(part));
    out.static_share = lacking_share(exact, free.shapes, free.omega);
    if (static_correction) {
      columns = beside(free.shapes, residuals(part.fe.M, free.shapes, exact.shapes));
    }
  }
  if (free.omega.size() > 0) out.highest_mode = free.omega[free.omega.size() - 1];
  diagonalise(part, columns, out);
  return out;
}

ReducedBasis craig_bampton_basis(const std::string& body, const FlexiblePart& part,
                                 const CraigBamptonChoice& choice, double length) {
  const linalg::SymmetricMatrix& M = part.fe.M;
  const ElasticInverse inverse(body, part.fe, part.sieve, length, linalg::make_large_factor);
  const Matrix all_loads = interface_loads(part);
  const Matrix loads = all_loads.leftCols(part.num_held_rows());
  const Matrix displaced = inverse.solve_checked(self_equilibrated(part, loads));
  const HeldModes held = held_modes(part, choice);
  ReducedBasis out;
  out.num_modes = static_cast<int>(held.omega.size());
  if (held.omega.size() > 0) out.highest_mode = held.omega[held.omega.size() - 1];
  Matrix columns = orthonormalised(M, beside(held.shapes, displaced));
  diagonalise(part, columns, out);
  out.static_share = lacking_share(static_shapes(part, inverse, loads), out.Z, out.omega);
  if (choice.static_correction) {
    const Matrix distributed = all_loads.rightCols(part.num_pattern_rows);
    const Matrix patterns = beside(beside(distributed, held_by(part, distributed, loads)),
                                   part.invariants.centrifugal_patterns());
    const Matrix spun = static_shapes(part, inverse, patterns).shapes;
    columns = beside(columns, residuals(M, columns, spun));
    diagonalise(part, columns, out);
  }
  return out;
}

ReducedBasis quasi_static_basis(const std::string& body, const FlexiblePart& part, int modes,
                                double length) {
  ReducedBasis out;
  Matrix shapes(part.num_dofs(), 0);
  if (modes > 0) {
    const FreeModes free = free_groups(part, modes);
    shapes = free.shapes;
    out.num_modes = static_cast<int>(shapes.cols());
    if (out.num_modes > 0) out.highest_mode = free.omega[free.omega.size() - 1];
  }
  const ElasticInverse inverse(body, part.fe, part.sieve, length, linalg::make_large_factor);
  const Matrix loads = beside(interface_loads(part), part.invariants.centrifugal_patterns());
  const StaticShapes exact = static_shapes(part, inverse, loads);
  diagonalise(part, beside(shapes, residuals(part.fe.M, shapes, exact.shapes)), out);
  return out;
}

}  // namespace buckens::body

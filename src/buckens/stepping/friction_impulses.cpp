// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/friction_impulses.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "buckens/stepping/impacts.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostSweeps = 1000;
constexpr int kMostAgreements = 200;
// Changes of rates by this share of what impulses do to them, and those that may be rounding where
// they do not fall any more. How places share an impulse is known to less, which no rate feels.
constexpr double kSameRates = 1e-14;
constexpr double kRoundingOfRates = 1e-10;
constexpr int kHalvings = 200;
// Answers of a slip by this share of the largest answer of all.
constexpr double kNoAnswerOfSlip = 1e-12;

/// Impulse of one slip that stops it, or the one on the cone that is against what remains of it.
/// @param B answers of the slip to it, @param v slip without it, @param most μ P_n
/// @param none answers up to this are rounding: guides hold the bodies in such a direction
Vector rub(const Matrix& B, const Vector& v, double most, double none) {
  if (!(most > 0.0)) return Vector::Zero(v.size());
  const Eigen::SelfAdjointEigenSolver<Matrix> modes(B);
  const Vector& answers = modes.eigenvalues();
  Vector parts = modes.eigenvectors().transpose() * v;
  for (Eigen::Index k = 0; k < parts.size(); ++k) {
    if (answers[k] <= none) parts[k] = 0.0;
  }
  if (parts.norm() == 0.0) return Vector::Zero(v.size());
  // P = −(B + s)⁻¹ v: its size falls with s, the ratio of the slip that remains to the impulse.
  const auto at = [&](double s) -> Vector {
    Vector out(parts.size());
    for (Eigen::Index k = 0; k < parts.size(); ++k) {
      out[k] = parts[k] == 0.0 ? 0.0 : -parts[k] / (answers[k] + s);
    }
    return out;
  };
  const Vector stops = at(0.0);
  if (stops.norm() <= most) return modes.eigenvectors() * stops;
  double low = 0.0;
  double high = parts.norm() / most;  // there the size is at most `most`
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (at(middle).norm() > most ? low : high) = middle;
  }
  const Vector slides = at(high);
  return modes.eigenvectors() * (slides * (most / slides.norm()));
}

/// What impulses do to the rates at most.
double size_of_rates(const Matrix& D, const Vector& P) {
  return (D.cwiseAbs() * P.cwiseAbs()).maxCoeff();
}

/// Impulses along the surfaces for given ones across them. @return whether the rates have settled
bool solve_slips(const Matrix& D, const Vector& b, const std::vector<ImpactSlip>& slips,
                 Vector& P) {
  const double none = kNoAnswerOfSlip * D.diagonal().maxCoeff();
  double change = 0.0, size = 0.0;
  Vector last = P;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    for (const ImpactSlip& slip : slips) {
      const auto own = Eigen::seqN(slip.first, slip.count);
      const Matrix B = D(own, own);
      const Vector v = D(own, Eigen::all) * P - b(own) - B * P(own);
      P(own) = rub(B, v, slip.coefficient * P[slip.across], none);
    }
    change = (D * (P - last)).cwiseAbs().maxCoeff();
    size = size_of_rates(D, P);
    if (change <= kSameRates * size) return true;
    last = P;
  }
  return change <= kRoundingOfRates * size;
}

}  // namespace

Vector solve_impact(const Matrix& D, const Vector& b, Eigen::Index num_across,
                    const std::vector<ImpactSlip>& slips) {
  const auto across = Eigen::seqN(Eigen::Index{0}, num_across);
  const auto along = Eigen::seqN(num_across, D.rows() - num_across);
  Vector P = Vector::Zero(D.rows());
  const Matrix pressing = D(across, across);
  P(across) = solve_complementarity(pressing, b(across));
  if (slips.empty()) return P;
  double change_before = HUGE_VAL;
  for (int round = 0; round < kMostAgreements; ++round) {
    const bool has_settled = solve_slips(D, b, slips, P);
    const Vector before = P(across);
    const Vector asked = b(across) - D(across, along) * P(along);
    P(across) = solve_complementarity(pressing, asked);
    const double change =
        (D(Eigen::all, across) * (P(across) - before)).cwiseAbs().maxCoeff() / size_of_rates(D, P);
    const bool is_rounding = change <= kRoundingOfRates &&
                             (change >= 0.5 * change_before || round + 1 == kMostAgreements);
    if (has_settled && (!(change > kSameRates) || is_rounding)) {
      solve_slips(D, b, slips, P);
      return P;
    }
    change_before = change;
  }
  throw StepFailure(
      "no impulses satisfy all rigid contacts with friction that are struck at once: friction "
      "jams; give the contact a `stiffness`, or less `static`");
}

}  // namespace buckens::stepping

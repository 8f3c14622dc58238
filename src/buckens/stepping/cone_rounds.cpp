// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/cone_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/stepping/cone_program.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

constexpr int kMostSlipRounds = 128;
// Finishing is tried after this many rounds, and again whenever their number has doubled.
constexpr int kFirstFinish = 2;
// Slips of this fraction of the largest rate are rounding of the convex problems.
constexpr double kSameSlip = 1e-8;
// Sliding places may separate at this fraction of the largest rate if rounds lead away from a
// solution that cannot be finished: wedged bodies with hardly any impulses to spare.
constexpr double kHardlyOtherSlip = 1e-6;
// Newton's method may change rates by this fraction of the largest one, starting from a round.
constexpr double kNear = 0.1;

/// μ |w_t| of a place.
double parting(const ConeRows& place, const Vector& w) {
  double square = 0.0;
  for (std::size_t k = 1; k < place.rows.size(); ++k) {
    square += w[place.rows[k]] * w[place.rows[k]];
  }
  return place.coefficient * std::sqrt(square);
}

}  // namespace

ConeEnd find_in_cones(const linalg::SparseMatrix& D, const Vector& b,
                      const std::vector<ConeRows>& places,
                      const std::function<bool(Vector&)>& finish, Vector& P) {
  ConeProgram program(D, places);
  const double size = b.cwiseAbs().maxCoeff();
  Vector eased = b;
  int next_finish = kFirstFinish;
  Vector best;
  double least = HUGE_VAL;
  for (int round = 1; round <= kMostSlipRounds; ++round) {
    if (!program.solve(eased, P)) return ConeEnd::none;
    const Vector w = D * P - b;
    double change = 0.0;
    for (const ConeRows& place : places) {
      const Eigen::Index across = place.rows.front();
      const double wanted = b[across] - parting(place, w);
      change = std::max(change, std::abs(wanted - eased[across]));
      eased[across] = wanted;
    }
    if (change < least) {
      least = change;
      best = P;
    }
    const bool is_same = change <= kSameSlip * size;
    if (round < next_finish && !is_same) continue;
    Vector exact = P;
    // Where friction nearly jams, Newton's method ends elsewhere, with impulses that make rates
    // grow.
    if (finish(exact) && (D * (exact - P)).cwiseAbs().maxCoeff() <= kNear * size) {
      P = std::move(exact);
      return ConeEnd::exact;
    }
    if (is_same) break;
    next_finish *= 2;
  }
  P = std::move(best);
  return least <= kHardlyOtherSlip * size ? ConeEnd::near : ConeEnd::none;
}

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/friction_impulses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/stepping/complementarity.h"
#include "buckens/stepping/cone_impulse.h"
#include "buckens/stepping/cone_newton.h"
#include "buckens/stepping/cone_rounds.h"
#include "buckens/stepping/large_impact.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

// Changes of rates, as a fraction of the effect of the impulses; and those that may be rounding if
// they no longer fall. How places share an impulse is less certain, but no rate depends on it.
constexpr double kSameRates = 1e-14;
constexpr double kRoundingOfRates = 1e-10;
// Response of a place, as a fraction of the largest of all.
constexpr double kNoAnswerOfPlace = 1e-12;
constexpr int kMostNewtonRounds = 12;
constexpr int kSweepsBetween = 20;        // place by place, between Newton's
constexpr int kMostAgreements = 50;       // rounds of across and along
constexpr int kMostSlipSweeps = 1000;     // over those along, per round
constexpr int kMostSweeps = 500;          // place by place
constexpr int kMostHalfSweeps = 2000;     // the same by half of each change
constexpr int kMostBlows = 10000;         // one after the other
constexpr Eigen::Index kMostDense = 150;  // rows; more of them as a sparse system

/// The places that are struck, each with its rows: normal ("across"), then tangential ("along").
class Places {
 public:
  Places(const Matrix& D, const Vector& b, Eigen::Index num_across,
         const std::vector<ImpactSlip>& slips)
      : D_(D), sizes_(D.cwiseAbs()), b_(b), none_(kNoAnswerOfPlace * D.diagonal().maxCoeff()) {
    for (Eigen::Index across = 0; across < num_across; ++across) {
      places_.push_back({{across}, {}, {}, 0.0});
    }
    for (const ImpactSlip& slip : slips) {
      Place& place = places_[static_cast<std::size_t>(slip.across)];
      place.coefficient = slip.coefficient;
      for (Eigen::Index k = 0; k < slip.count; ++k) place.rows.push_back(slip.first + k);
    }
    for (Place& place : places_) {
      const auto along = static_cast<Eigen::Index>(place.rows.size()) - 1;
      place.answers = D(place.rows, place.rows);
      place.answers_along = place.answers.bottomRightCorner(along, along);
    }
  }

  std::vector<ConeRows> rows() const {
    std::vector<ConeRows> out;
    for (const Place& place : places_) out.push_back({place.rows, place.coefficient});
    return out;
  }

  /// The impulses of (I1) and (I2): all normal ones with the tangential ones fixed, and the other
  /// way round. Places that hold the same thing get equal shares. @return whether both agree
  bool agree(Vector& P) const {
    const auto count = static_cast<Eigen::Index>(places_.size());
    const auto across = Eigen::seqN(Eigen::Index{0}, count);
    const auto along = Eigen::seqN(count, D_.rows() - count);
    const Matrix pressing = D_(across, across);
    double change_before = HUGE_VAL;
    for (int round = 0; round < kMostAgreements; ++round) {
      const bool has_settled = settle_slips(P);
      const Vector before = P(across);
      try {
        P(across) = solve_complementarity(pressing, b_(across) - D_(across, along) * P(along));
      } catch (const StepFailure&) {
        return false;
      }
      const double change =
          (D_(Eigen::all, across) * (P(across) - before)).cwiseAbs().maxCoeff() / size_of_rates(P);
      const bool is_rounding = change <= kRoundingOfRates &&
                               (change >= 0.5 * change_before || round + 1 == kMostAgreements);
      if (has_settled && (!(change > kSameRates) || is_rounding)) {
        settle_slips(P);
        return true;
      }
      change_before = change;
    }
    return false;
  }

  /// The impulses of (I1) and (I2): those of each place in turn, with those of the others fixed.
  /// @param share fraction of each change that is made @return whether the rates have settled
  bool settle(Vector& P, double share, int most_sweeps) const {
    double change = 0.0, size = 0.0;
    Vector last = P;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      for (const Place& place : places_) {
        const PlaceVector own = P(place.rows);
        const PlaceVector v = rates(place, P, 0) - place.answers * own;
        P(place.rows) += share * (cone_impulse(place.answers, v, place.coefficient, none_) - own);
      }
      change = (D_ * (P - last)).cwiseAbs().maxCoeff();
      size = size_of_rates(P);
      if (change <= kSameRates * share * size) return true;
      last = P;
    }
    return change <= kRoundingOfRates * share * size;
  }

  /// Impacts one after the other, always where the bodies approach fastest, until none approach any
  /// more. None of them takes back the effect of another. @return whether they come to an end
  bool strike_in_turn(Vector& P) const {
    P.setZero(D_.rows());
    for (int blow = 0; blow < kMostBlows; ++blow) {
      const Place* next = nullptr;
      double approach = kRoundingOfRates * std::max(size_of_rates(P), b_.cwiseAbs().maxCoeff());
      for (const Place& place : places_) {
        const double rate = D_.row(place.rows.front()).dot(P) - b_[place.rows.front()];
        if (-rate <= approach || place.answers(0, 0) <= none_) continue;
        approach = -rate;
        next = &place;
      }
      if (next == nullptr) return true;
      P(next->rows) += cone_impulse(next->answers, rates(*next, P, 0), next->coefficient, none_);
    }
    return false;
  }

 private:
  /// Tangential impulses for given normal ones. @return whether the rates have settled
  bool settle_slips(Vector& P) const {
    double change = 0.0, size = 0.0;
    Vector last = P;
    for (int sweep = 0; sweep < kMostSlipSweeps; ++sweep) {
      for (const Place& place : places_) {
        const auto n = static_cast<Eigen::Index>(place.rows.size()) - 1;
        if (n == 0) continue;
        PlaceVector own(n);
        for (Eigen::Index k = 0; k < n; ++k) own[k] = P[place.row(k + 1)];
        const PlaceVector v = rates(place, P, 1) - place.answers_along * own;
        own = rub_impulse(place.answers_along, v, place.coefficient * P[place.row(0)], none_);
        for (Eigen::Index k = 0; k < n; ++k) P[place.row(k + 1)] = own[k];
      }
      change = (D_ * (P - last)).cwiseAbs().maxCoeff();
      size = size_of_rates(P);
      if (change <= kSameRates * size) return true;
      last = P;
    }
    return change <= kRoundingOfRates * size;
  }

  struct Place {
    std::vector<Eigen::Index> rows;
    PlaceMatrix answers, answers_along;
    double coefficient = 0;

    Eigen::Index row(Eigen::Index k) const { return rows[static_cast<std::size_t>(k)]; }
  };

  /// Rates of the rows of a place, from the given one on.
  PlaceVector rates(const Place& place, const Vector& P, Eigen::Index first) const {
    PlaceVector out(static_cast<Eigen::Index>(place.rows.size()) - first);
    for (Eigen::Index k = 0; k < out.size(); ++k) {
      const Eigen::Index row = place.row(first + k);
      out[k] = D_.row(row).dot(P) - b_[row];
    }
    return out;
  }
  /// Largest effect of impulses on the rates.
  double size_of_rates(const Vector& P) const { return (sizes_ * P.cwiseAbs()).maxCoeff(); }

  const Matrix& D_;
  Matrix sizes_;  // of its entries
  const Vector& b_;
  double none_;
  std::vector<Place> places_;
};

/// Whether the effects of impulses cancel to more digits than they have: rows hold the same thing,
/// and friction jams.
bool do_cancel(const Matrix& D, const Vector& b, const Vector& P) {
  const double size = (D.cwiseAbs() * P.cwiseAbs()).maxCoeff();
  return !(size <= kMostCancelled * b.cwiseAbs().maxCoeff());
}

/// Impulses of one group of places that influence each other.
class GroupSolver {
 public:
  GroupSolver(const Matrix& D, const Vector& b, Eigen::Index num_across,
              const std::vector<ImpactSlip>& slips)
      : D_(D), b_(b), places_(D, b, num_across, slips), rows_(places_.rows()) {}

  /// Newton's method and places in turn. @param P start and result @return whether they are found
  bool find_in_turn(Vector& P) const {
    const Vector start = P;
    const auto from_start = [&]() -> Vector& { return P = start; };
    try {
      for (int round = 0; round < kMostNewtonRounds; ++round) {
        if (finish(P)) return true;
        // Sweeps make progress.
        if (round == 0 || !is_good(P)) P = start;
        const double share = round % 2 == 0 ? 1.0 : 0.5;
        if (places_.settle(P, share, kSweepsBetween) && is_good(P)) return true;
      }
      return (places_.settle(from_start(), 1.0, kMostSweeps) && is_good(P)) ||
             (places_.settle(from_start(), 0.5, kMostHalfSweeps) && is_good(P)) ||
             (places_.agree(from_start()) && is_good(P)) ||
             (places_.strike_in_turn(P) && is_good(P));
    } catch (const StepFailure&) {  // one place jams on its own, given the impulses of others
      return false;
    }
  }

  /// All places at once, for wedged bodies.
  ConeEnd find_in_cones(Vector& P) const {
    const auto exact = [this](Vector& near) { return finish(near); };
    const ConeEnd end = stepping::find_in_cones(D_.sparseView(), b_, rows_, exact, P);
    return is_good(P) ? end : ConeEnd::none;
  }

 private:
  bool finish(Vector& P) const { return find_by_newton(D_, b_, rows_, P) && is_good(P); }
  bool is_good(const Vector& P) const { return !do_cancel(D_, b_, P); }

  const Matrix& D_;
  const Vector& b_;
  Places places_;
  std::vector<ConeRows> rows_;
};

/// @param are_near see solve_impact()
Vector solve_together(const Matrix& D, const Vector& b, Eigen::Index num_across,
                      const std::vector<ImpactSlip>& slips, bool* are_near) {
  const auto across = Eigen::seqN(Eigen::Index{0}, num_across);
  Vector P = Vector::Zero(D.rows());
  try {
    P(across) = solve_complementarity(D(across, across), b(across));
  } catch (const StepFailure&) {
    if (slips.empty()) throw;  // otherwise it is only an initial guess
  }
  if (slips.empty()) return P;
  const GroupSolver solver(D, b, num_across, slips);
  if (solver.find_in_turn(P)) return P;
  const ConeEnd end = solver.find_in_cones(P);
  if (are_near != nullptr && end == ConeEnd::near) *are_near = true;
  if (end != ConeEnd::none) return P;
  throw StepFailure(
      "no impulses satisfy all rigid contacts with friction that are struck at once: friction "
      "jams; give the contact a `stiffness`, or less `static`");
}

/// One-sided rows and their slips that influence each other, group by group; ascending.
class ImpactGroups {
 public:
  ImpactGroups(const linalg::SparseMatrix& D, const std::vector<ImpactSlip>& slips)
      : leaders_(static_cast<std::size_t>(D.rows())) {
    for (std::size_t k = 0; k < leaders_.size(); ++k) leaders_[k] = static_cast<Eigen::Index>(k);
    for (const ImpactSlip& slip : slips) {
      for (Eigen::Index k = 0; k < slip.count; ++k) unite(slip.across, slip.first + k);
    }
    for (Eigen::Index j = 0; j < D.outerSize(); ++j) {
      for (linalg::SparseMatrix::InnerIterator it(D, j); it; ++it) {
        if (it.value() != 0.0) unite(it.row(), it.col());
      }
    }
    std::vector<int> number(leaders_.size(), -1);
    for (Eigen::Index row = 0; row < std::ssize(leaders_); ++row) {
      int& own = number[static_cast<std::size_t>(leader(row))];
      if (own < 0) {
        own = static_cast<int>(rows_.size());
        rows_.emplace_back();
      }
      rows_[static_cast<std::size_t>(own)].push_back(row);
    }
  }

  const std::vector<std::vector<Eigen::Index>>& rows() const { return rows_; }

 private:
  Eigen::Index leader(Eigen::Index row) {
    Eigen::Index& above = leaders_[static_cast<std::size_t>(row)];
    if (above != row) above = leader(above);
    return above;
  }
  void unite(Eigen::Index a, Eigen::Index b) {
    leaders_[static_cast<std::size_t>(leader(a))] = leader(b);
  }

  std::vector<Eigen::Index> leaders_;
  std::vector<std::vector<Eigen::Index>> rows_;
};

/// The part of a matrix with these rows and columns, ascending.
linalg::SparseMatrix part_of(const linalg::SparseMatrix& D, const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> place(static_cast<std::size_t>(D.rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    place[static_cast<std::size_t>(rows[k])] = static_cast<Eigen::Index>(k);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (const Eigen::Index j : rows) {
    for (linalg::SparseMatrix::InnerIterator it(D, j); it; ++it) {
      const Eigen::Index i = place[static_cast<std::size_t>(it.row())];
      if (i < 0) continue;
      entries.emplace_back(static_cast<int>(i),
                           static_cast<int>(place[static_cast<std::size_t>(j)]), it.value());
    }
  }
  linalg::SparseMatrix out(std::ssize(rows), std::ssize(rows));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

std::vector<ConeRows> cones_of(Eigen::Index num_across, const std::vector<ImpactSlip>& slips) {
  std::vector<ConeRows> out;
  for (Eigen::Index across = 0; across < num_across; ++across) out.push_back({{across}, 0.0});
  for (const ImpactSlip& slip : slips) {
    ConeRows& cone = out[static_cast<std::size_t>(slip.across)];
    cone.coefficient = slip.coefficient;
    for (Eigen::Index k = 0; k < slip.count; ++k) cone.rows.push_back(slip.first + k);
  }
  return out;
}

}  // namespace

Vector solve_impact(const linalg::SparseMatrix& D, const Vector& b, Eigen::Index num_across,
                    const std::vector<ImpactSlip>& slips, std::vector<Eigen::Index>* jammed,
                    bool* are_near) {
  if (slips.empty() && D.rows() <= kMostDense) {
    return solve_together(Matrix(D), b, num_across, slips, are_near);
  }
  Vector P(D.rows());
  const ImpactGroups groups(D, slips);
  for (const std::vector<Eigen::Index>& group : groups.rows()) {
    // Rows keep their order: normal, then tangential.
    const auto place_of = [&](Eigen::Index row) {
      return std::lower_bound(group.begin(), group.end(), row) - group.begin();
    };
    std::vector<ImpactSlip> own;
    for (const ImpactSlip& slip : slips) {
      if (!std::binary_search(group.begin(), group.end(), slip.first)) continue;
      own.push_back({place_of(slip.across), place_of(slip.first), slip.count, slip.coefficient});
    }
    const linalg::SparseMatrix part = part_of(D, group);
    const Eigen::Index across = place_of(num_across);
    try {
      P(group) = part.rows() <= kMostDense
                     ? solve_together(Matrix(part), b(group), across, own, are_near)
                     : solve_large_impact(part, b(group), cones_of(across, own), are_near);
    } catch (const StepFailure&) {
      if (jammed == nullptr) throw;
      jammed->insert(jammed->end(), group.begin(), group.end());
      P(group).setZero();
    }
  }
  return P;
}

}  // namespace buckens::stepping

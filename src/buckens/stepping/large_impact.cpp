// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/large_impact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "buckens/stepping/cone_impulse.h"
#include "buckens/stepping/cone_rounds.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kRounds = 20;  // of Newton's method and sweeps
constexpr int kNewtonsInRound = 15;
constexpr int kIdleNewtons = 3;  // in a row without progress
constexpr int kSweepsInRound = 50;
constexpr int kLastSweeps = 5000;
constexpr int kMostJams = 3;  // rounds in which a place jams on its own
// Residuals that are rounding, as a fraction of the effect of impulses; and those that may be
// rounding if they fall no further.
constexpr double kClosed = 1e-13;
constexpr double kNearlyClosed = 1e-10;
// Fraction of its own response by which a row yields in Newton's matrix: rows that hold the same
// thing leave it regular, and residuals are exact.
constexpr double kGives = 1e-9;
// Response, as a fraction of the largest one.
constexpr double kAnswersNothing = 1e-12;

using RowsOfAnswers = Eigen::SparseMatrix<double, Eigen::RowMajor>;

class ManyPlaces {
 public:
  ManyPlaces(const linalg::SparseMatrix& D, const Vector& b, const std::vector<ConeRows>& places)
      : D_(D),
        given_(D),
        sizes_(D_.cwiseAbs()),
        b_(b),
        places_(places),
        none_(kAnswersNothing * Vector(D.diagonal()).maxCoeff()),
        F_(b.size()) {
    for (const ConeRows& place : places) {
      rubs_ = rubs_ || place.rows.size() > 1;
      const auto n = std::ssize(place.rows);
      Matrix B(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
          B(i, j) = D.coeff(place.rows[static_cast<std::size_t>(i)],
                            place.rows[static_cast<std::size_t>(j)]);
        }
      }
      const double most = B.diagonal().maxCoeff();
      scales_.push_back(most > 0.0 ? most : 1.0);
      answers_.push_back(std::move(B));
    }
  }

  /// @param are_near see solve_large_impact()
  Vector solve(bool* are_near) {
    Vector P = Vector::Zero(b_.size());
    if (find_in_turn(P)) return P;
    const auto exact = [this](Vector& near) { return find_by_newton(near) && is_good(near); };
    const ConeEnd end = rubs_ ? find_in_cones(given_, b_, places_, exact, P) : ConeEnd::none;
    if (end != ConeEnd::none && is_good(P)) {
      if (are_near != nullptr && end == ConeEnd::near) *are_near = true;
      return P;
    }
    throw StepFailure(fmt::format(
        "no impulses were found that satisfy all {} rigid contacts that press each other at once; "
        "give them a `stiffness`, or less `static`",
        places_.size()));
  }

 private:
  /// Largest effect of impulses on the rates.
  double size_of(const Vector& P) const {
    return std::max((sizes_ * P.cwiseAbs()).maxCoeff(), b_.cwiseAbs().maxCoeff());
  }
  /// Whether impulses do not merely cancel each other, as when friction jams.
  bool is_good(const Vector& P) const {
    return !rubs_ || size_of(P) <= kMostCancelled * b_.cwiseAbs().maxCoeff();
  }
  /// Largest residual of the equations [m/s].
  double open(const Vector& P) {
    form(P);
    return F_.cwiseAbs().maxCoeff();
  }

  /// Newton's method, and places in turn. @param P start and result @return whether they are found
  bool find_in_turn(Vector& P) {
    int jams = 0;
    for (int round = 0; round < kRounds; ++round) {
      try {
        const double share = round % 2 == 0 ? 1.0 : 0.5;
        if (sweep(P, share, kSweepsInRound) && is_good(P)) return true;
      } catch (const StepFailure&) {  // one place by itself, with what the others do so far
        if (++jams == kMostJams) return false;
      }
      Vector trial = P;
      if (find_by_newton(trial) && is_good(trial)) {
        P = std::move(trial);
        return true;
      }
      if (!is_good(P)) P.setZero();
    }
    try {
      return (sweep(P, 1.0, kLastSweeps) || open(P) <= kNearlyClosed * size_of(P)) && is_good(P);
    } catch (const StepFailure&) {
      return false;
    }
  }

  /// Each place's impulses in turn, with those of the others. @return whether all agree
  bool sweep(Vector& P, double share, int most) {
    for (int k = 0; k < most; ++k) {
      double change = 0.0;
      for (std::size_t m = 0; m < places_.size(); ++m) {
        const ConeRows& place = places_[m];
        const Vector own = P(place.rows);
        Vector v = -answers_[m] * own;
        for (std::size_t i = 0; i < place.rows.size(); ++i) {
          v[static_cast<Eigen::Index>(i)] += D_.row(place.rows[i]).dot(P) - b_[place.rows[i]];
        }
        const Vector wanted = cone_impulse(answers_[m], v, place.coefficient, none_);
        P(place.rows) += share * (wanted - own);
        change = std::max(change, (answers_[m] * (wanted - own)).cwiseAbs().maxCoeff());
      }
      if (change <= kClosed * size_of(P)) return true;
    }
    return false;
  }

  bool find_by_newton(Vector& P) {
    double before = HUGE_VAL;
    int idle = 0;
    for (int k = 0; k < kNewtonsInRound; ++k) {
      const double left = open(P), size = size_of(P);
      if (!(left < HUGE_VAL)) return false;
      const bool falls_no_further = left <= kNearlyClosed * size && left >= 0.5 * before;
      if (left <= kClosed * size || falls_no_further) {
        let_go(P);
        return true;
      }
      idle = left < 0.5 * before ? 0 : idle + 1;
      if (idle >= kIdleNewtons) return false;
      before = left;
      linalg::SparseMatrix A(b_.size(), b_.size());
      A.setFromTriplets(entries_.begin(), entries_.end());
      Eigen::SparseLU<linalg::SparseMatrix> factor(A);
      if (factor.info() != Eigen::Success) return false;
      P -= factor.solve(F_);
    }
    return false;
  }

  /// Places that are not pressed have no impulses but rounding: none.
  void let_go(Vector& P) const {
    for (const ConeRows& place : places_) {
      if (P[place.rows.front()] > 0.0) continue;
      for (const Eigen::Index row : place.rows) P[row] = 0.0;
    }
  }

  /// The equations, and their derivatives, as stepping/cone_newton.cpp has them.
  void form(const Vector& P) {
    const Vector w = D_ * P - b_;
    entries_.clear();
    for (std::size_t k = 0; k < places_.size(); ++k) form_place(k, P, w);
  }

  void add_row_of_answers(Eigen::Index row, Eigen::Index of, double factor) {
    if (factor == 0.0) return;
    for (RowsOfAnswers::InnerIterator it(D_, of); it; ++it) add(row, it.col(), factor * it.value());
  }
  void add(Eigen::Index row, Eigen::Index column, double value) {
    entries_.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  }

  void form_place(std::size_t k, const Vector& P, const Vector& w) {
    const ConeRows& place = places_[k];
    const double d = scales_[k];
    const Eigen::Index across = place.rows.front();
    if (!(d * P[across] - w[across] > 0.0)) {
      for (const Eigen::Index row : place.rows) {
        F_[row] = d * P[row];
        add(row, row, d);
      }
      return;
    }
    F_[across] = w[across];
    add_row_of_answers(across, across, 1.0);
    add(across, across, kGives * d);
    const Eigen::Index count = std::ssize(place.rows) - 1;
    if (count == 0) return;
    const std::vector<Eigen::Index> along(place.rows.begin() + 1, place.rows.end());
    const auto slide = sliding_cone(d * P(along) - w(along), place.coefficient, d * P[across]);
    if (!slide) {
      F_(along) = w(along);
      for (const Eigen::Index row : along) {
        add_row_of_answers(row, row, 1.0);
        add(row, row, kGives * d);
      }
      return;
    }
    F_(along) = d * P(along) - slide->most * slide->towards;
    for (Eigen::Index m = 0; m < count; ++m) {
      const Eigen::Index row = along[static_cast<std::size_t>(m)];
      for (Eigen::Index c = 0; c < count; ++c) {
        const Eigen::Index other = along[static_cast<std::size_t>(c)];
        add_row_of_answers(row, other, slide->turns(m, c));
        add(row, other, d * ((m == c ? 1.0 : 0.0) - slide->turns(m, c)));
      }
      add(row, across, -place.coefficient * d * slide->towards[m]);
    }
  }

  RowsOfAnswers D_;
  const linalg::SparseMatrix& given_;  // D
  RowsOfAnswers sizes_;
  const Vector& b_;
  const std::vector<ConeRows>& places_;
  double none_;
  bool rubs_ = false;  // any of the places
  std::vector<Matrix> answers_;
  std::vector<double> scales_;
  Vector F_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

Vector solve_large_impact(const linalg::SparseMatrix& D, const Vector& b,
                          const std::vector<ConeRows>& places, bool* are_near) {
  return ManyPlaces(D, b, places).solve(are_near);
}

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/cone_newton.h"

#include <algorithm>
#include <cmath>

#include "buckens/linalg/pseudo_inverse.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostNewtons = 15;
// So many in a row that gain nothing: it stands where two regimes meet.
constexpr int kMostIdle = 3;
// Residuals by this share of what impulses do are rounding.
constexpr double kSolved = 1e-13;
// Directions that answer less than this share of the largest are held by others: least impulses.
constexpr double kHeldByOthers = 1e-10;

/// The equations F(P) = 0 as rates, and their derivatives.
class ConeEquations {
 public:
  ConeEquations(const Matrix& D, const Vector& b, const std::vector<ConeRows>& places)
      : D_(D), b_(b), places_(places), F_(b.size()), A_(D.rows(), D.cols()) {
    for (const ConeRows& place : places) {
      double sum = 0.0;
      for (const Eigen::Index row : place.rows) sum = std::max(sum, D(row, row));
      scales_.push_back(sum > 0.0 ? sum : 1.0);
    }
  }

  void form(const Vector& P) {
    const Vector w = D_ * P - b_;
    for (std::size_t k = 0; k < places_.size(); ++k) form_place(k, P, w);
  }
  /// What is open of the equations [m/s].
  const Vector& residual() const { return F_; }
  /// Its derivative with respect to the impulses.
  const Matrix& jacobian() const { return A_; }

 private:
  void form_place(std::size_t k, const Vector& P, const Vector& w) {
    const ConeRows& place = places_[k];
    const double d = scales_[k];  // rates per impulse
    const Eigen::Index across = place.rows.front();
    const bool is_pressed = d * P[across] - w[across] > 0.0;
    const Eigen::Index count = static_cast<Eigen::Index>(place.rows.size()) - 1;
    if (!is_pressed) {
      for (const Eigen::Index row : place.rows) {
        F_[row] = d * P[row];
        A_.row(row).setZero();
        A_(row, row) = d;
      }
      return;
    }
    F_[across] = w[across];
    A_.row(across) = D_.row(across);
    if (count == 0) return;
    const std::vector<Eigen::Index> along(place.rows.begin() + 1, place.rows.end());
    const auto slide = sliding_cone(d * P(along) - w(along), place.coefficient, d * P[across]);
    if (!slide) {
      F_(along) = w(along);
      A_(along, Eigen::all) = D_(along, Eigen::all);
      return;
    }
    F_(along) = d * P(along) - slide->most * slide->towards;
    Matrix rows = slide->turns * D_(along, Eigen::all);
    for (Eigen::Index m = 0; m < count; ++m) {
      for (Eigen::Index c = 0; c < count; ++c) {
        rows(m, along[static_cast<std::size_t>(c)]) +=
            d * ((m == c ? 1.0 : 0.0) - slide->turns(m, c));
      }
      rows(m, across) -= place.coefficient * d * slide->towards[m];
    }
    A_(along, Eigen::all) = rows;
  }

  const Matrix& D_;
  const Vector& b_;
  const std::vector<ConeRows>& places_;
  std::vector<double> scales_;  // of each place
  Vector F_;
  Matrix A_;
};

/// Places that are not pressed have no impulses but rounding: none.
void let_go(const std::vector<ConeRows>& places, Vector& P) {
  for (const ConeRows& place : places) {
    if (P[place.rows.front()] > 0.0) continue;
    for (const Eigen::Index row : place.rows) P[row] = 0.0;
  }
}

}  // namespace

std::optional<SlidingCone> sliding_cone(const Vector& trial, double coefficient, double pressed) {
  SlidingCone out;
  out.most = coefficient * std::max(pressed, 0.0);
  const double size = trial.norm();
  if (size <= out.most) return std::nullopt;
  out.towards = trial / size;
  out.turns = (out.most / size) * (Matrix::Identity(trial.size(), trial.size()) -
                                   out.towards * out.towards.transpose());
  return out;
}

bool find_by_newton(const Matrix& D, const Vector& b, const std::vector<ConeRows>& places,
                    Vector& P) {
  ConeEquations equations(D, b, places);
  linalg::PseudoInverse inverse(kHeldByOthers);
  double before = HUGE_VAL;
  int idle = 0;
  for (int k = 0; k < kMostNewtons; ++k) {
    equations.form(P);
    const double open = equations.residual().cwiseAbs().maxCoeff();
    const double size = std::max((D.cwiseAbs() * P.cwiseAbs()).maxCoeff(), b.cwiseAbs().maxCoeff());
    if (!(open < HUGE_VAL)) return false;
    // Rounding is reached where it falls no further.
    if (open <= kSolved * size || (open <= 100.0 * kSolved * size && open >= 0.5 * before)) {
      let_go(places, P);
      return true;
    }
    idle = open < 0.5 * before ? 0 : idle + 1;
    if (idle >= kMostIdle) return false;
    before = open;
    inverse.compute(equations.jacobian());
    P -= inverse * equations.residual();
  }
  return false;
}

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/cone_program.h"

#include <algorithm>
#include <cmath>

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr int kMostRounds = 60;
// Of what is open, as a share of the rates: solved, and so little that rounding may keep it there.
constexpr double kMet = 1e-14;
constexpr double kNearlyMet = 1e-7;
// Share of the way to the border of a cone that a round goes.
constexpr double kWithinCones = 0.99;
// Share of the largest answer that each row gives: what holds the same shares alike, and impulses
// that cancel each other come to an end.
constexpr double kShares = 1e-13;

/// √(u_n² − |u_t|²), of a vector within a cone.
double depth_in_cone(const Vector& u) {
  const double along = u.tail(u.size() - 1).norm();
  return std::sqrt(std::max((u[0] - along) * (u[0] + along), 1e-300));
}

/// u ∘ v = (u·v, u_n v_t + v_n u_t), the product for which a cone is the squares.
Vector product_in_cone(const Vector& u, const Vector& v) {
  const Eigen::Index n = u.size() - 1;
  Vector out(n + 1);
  out << u.dot(v), u[0] * v.tail(n) + v[0] * u.tail(n);
  return out;
}

/// v of u ∘ v = product.
Vector quotient_in_cone(const Vector& u, const Vector& product) {
  const Eigen::Index n = u.size() - 1;
  const double square = depth_in_cone(u) * depth_in_cone(u);
  const double across = (u[0] * product[0] - u.tail(n).dot(product.tail(n))) / square;
  Vector out(n + 1);
  out << across, (product.tail(n) - across * u.tail(n)) / u[0];
  return out;
}

/// Share of a change after which a vector leaves its cone.
double way_to_border(const Vector& u, const Vector& change) {
  const Eigen::Index n = u.size() - 1;
  const double a = change[0] * change[0] - change.tail(n).squaredNorm();
  const double b = u[0] * change[0] - u.tail(n).dot(change.tail(n));
  const double c = depth_in_cone(u) * depth_in_cone(u);
  double way = change[0] < 0.0 ? -u[0] / change[0] : HUGE_VAL;
  if (b * b < a * c) return way;
  const double q = -(b + std::copysign(std::sqrt(b * b - a * c), b));
  for (const double root : {q / a, c / q}) {
    if (root > 0.0) way = std::min(way, root);
  }
  return way;
}

}  // namespace

ConeProgram::ConeProgram(const linalg::SparseMatrix& D, const std::vector<ConeRows>& places)
    : answer_(Vector(D.diagonal()).maxCoeff()) {
  std::vector<Eigen::Index> place_of(static_cast<std::size_t>(D.rows()), -1);
  std::vector<double> scales;
  for (const ConeRows& place : places) {
    const bool rubs = place.coefficient > 0.0 && place.rows.size() > 1;
    const std::size_t count = rubs ? place.rows.size() : 1;
    blocks_.push_back({std::ssize(rows_), static_cast<Eigen::Index>(count), {}, {}});
    for (std::size_t k = 0; k < count; ++k) {
      place_of[static_cast<std::size_t>(place.rows[k])] = std::ssize(rows_);
      rows_.push_back(place.rows[k]);
      scales.push_back(rubs && k == 0 ? 1.0 / place.coefficient : 1.0);
    }
  }
  scales_ = Eigen::Map<const Vector>(scales.data(), std::ssize(scales));
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  for (Eigen::Index column = 0; column < D.outerSize(); ++column) {
    const Eigen::Index j = place_of[static_cast<std::size_t>(column)];
    for (linalg::SparseMatrix::InnerIterator it(D, column); it; ++it) {
      const Eigen::Index i = place_of[static_cast<std::size_t>(it.row())];
      if (i < 0 || j < 0) continue;
      // Half of both: rounding makes D a little unsymmetric.
      const double value = 0.5 * scales_[i] * it.value() * scales_[j] / answer_;
      add(i, j, value);
      add(j, i, value);
    }
  }
  for (Eigen::Index i = 0; i < std::ssize(rows_); ++i) add(i, i, kShares);
  Q_.resize(std::ssize(rows_), std::ssize(rows_));
  Q_.setFromTriplets(entries.begin(), entries.end());
}

bool ConeProgram::solve(const Vector& b, Vector& P) {
  const Eigen::Index n = std::ssize(rows_);
  P.setZero(b.size());
  const double size = b.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return true;
  const Vector c = -scales_.cwiseProduct(b(rows_)) / size;
  Iterate now{Vector::Zero(n), Vector::Zero(n), Vector::Zero(n), Vector::Zero(n)};
  for (const Block& block : blocks_) now.x[block.first] = now.s[block.first] = 1.0;
  Vector best = now.x;
  double least = HUGE_VAL;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vector open = Q_ * now.x + c - now.s;
    const double gap = now.x.dot(now.s);
    const double left =
        std::max(open.cwiseAbs().maxCoeff(), gap / std::max(1.0, std::abs(c.dot(now.x))));
    if (!(left < HUGE_VAL)) break;
    if (left < least) {
      least = left;
      best = now.x;
    }
    if (left <= kMet || (least <= kNearlyMet && left > 10.0 * least)) break;
    scale(now);
    if (!factorise()) break;
    find_direction(-lambda_, open, now);
    const double reached = longest_step(now);
    const double after = (now.x + reached * now.dx).dot(now.s + reached * now.ds);
    const double share = std::pow(std::max(after, 0.0) / gap, 3);
    find_direction(corrected(now, share * gap / static_cast<double>(blocks_.size())), open, now);
    const double step = std::min(1.0, kWithinCones * longest_step(now));
    now.x += step * now.dx;
    now.s += step * now.ds;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    P[rows_[static_cast<std::size_t>(k)]] = scales_[k] * best[k] * size / answer_;
  }
  return least <= kNearlyMet;
}

void ConeProgram::scale(const Iterate& now) {
  lambda_.resize(now.x.size());
  for (Block& block : blocks_) {
    const Eigen::Index n = block.size - 1;
    const Vector x = now.x.segment(block.first, block.size);
    const Vector s = now.s.segment(block.first, block.size);
    const double of_x = depth_in_cone(x), of_s = depth_in_cone(s);
    const double middle = std::sqrt(0.5 * (1.0 + x.dot(s) / (of_x * of_s)));
    Vector w(block.size);
    w << x[0] / of_x + s[0] / of_s, x.tail(n) / of_x - s.tail(n) / of_s;
    w /= 2.0 * middle;
    Matrix W(block.size, block.size);
    W(0, 0) = w[0];
    W.bottomLeftCorner(n, 1) = w.tail(n);
    W.topRightCorner(1, n) = w.tail(n).transpose();
    W.bottomRightCorner(n, n) =
        Matrix::Identity(n, n) + w.tail(n) * w.tail(n).transpose() / (1.0 + w[0]);
    const double ratio = std::sqrt(of_x / of_s);
    block.scaling = ratio * W;
    block.inverse = W / ratio;
    block.inverse.bottomLeftCorner(n, 1) *= -1.0;
    block.inverse.topRightCorner(1, n) *= -1.0;
    lambda_.segment(block.first, block.size) = block.scaling * s;
  }
}

bool ConeProgram::factorise() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Block& block : blocks_) {
    const Matrix square = block.inverse * block.inverse;
    for (Eigen::Index j = 0; j < block.size; ++j) {
      for (Eigen::Index i = 0; i < block.size; ++i) {
        entries.emplace_back(static_cast<int>(block.first + i), static_cast<int>(block.first + j),
                             square(i, j));
      }
    }
  }
  linalg::SparseMatrix scaling(Q_.rows(), Q_.cols());
  scaling.setFromTriplets(entries.begin(), entries.end());
  scaled_ = Q_ + scaling;
  if (!is_analysed_) factor_.analyse(scaled_);
  is_analysed_ = true;
  return factor_.factorise(scaled_);
}

void ConeProgram::find_direction(const Vector& wanted, const Vector& open, Iterate& now) {
  Vector asked = -open;
  for (const Block& block : blocks_) {
    asked.segment(block.first, block.size) +=
        block.inverse * wanted.segment(block.first, block.size);
  }
  now.dx = factor_.solve(asked);
  now.dx += factor_.solve(asked - scaled_ * now.dx);
  now.ds = Q_ * now.dx + open;
}

Vector ConeProgram::corrected(const Iterate& now, double centre) const {
  Vector out(lambda_.size());
  for (const Block& block : blocks_) {
    const auto part = Eigen::seqN(block.first, block.size);
    const Vector own = lambda_(part);
    Vector asked = -product_in_cone(own, own) -
                   product_in_cone(block.inverse * now.dx(part), block.scaling * now.ds(part));
    asked[0] += centre;
    out(part) = quotient_in_cone(own, asked);
  }
  return out;
}

double ConeProgram::longest_step(const Iterate& now) const {
  double step = HUGE_VAL;
  for (const Block& block : blocks_) {
    const auto part = Eigen::seqN(block.first, block.size);
    step = std::min(
        {step, way_to_border(now.x(part), now.dx(part)), way_to_border(now.s(part), now.ds(part))});
  }
  return step;
}

}  // namespace buckens::stepping

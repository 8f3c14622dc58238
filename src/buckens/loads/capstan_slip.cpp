// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/capstan_slip.h"

#include <algorithm>
#include <cmath>

namespace buckens::loads {

namespace {

// Frictionless pulleys in a row share like heat along a bar: a few hundred sweeps for sixteen.
constexpr int kMostSlipSweeps = 5000;
// Change of the last sweep, relative to the largest tension: rounding, and what rounding may leave
// where spans differ much in length.
constexpr double kShared = 1e-15, kSharedEnough = 1e-10;

}  // namespace

void CapstanSlip::reset(std::size_t spans, std::size_t pulleys, bool is_closed) {
  spans_ = spans;
  pulleys_ = pulleys;
  is_closed_ = is_closed;
  factor_.fill(HUGE_VAL);
  slip_.fill(0.0);
}

void CapstanSlip::set_span(std::size_t span, double stiffness, double resistance, double elastic,
                           double viscous) {
  k_[span] = stiffness;
  c_[span] = resistance;
  elastic_[span] = elastic;
  viscous_[span] = viscous;
}

double CapstanSlip::tension(std::size_t span) const {
  return std::max(0.0, elastic_[span] + viscous_[span]);
}

double CapstanSlip::of_spans(const Values& slips, std::size_t span) const {
  double out = 0.0;
  for (std::size_t i = 0; i < pulleys_; ++i) {
    if (before(i) == span) out += slips[i];
    if (behind(i) == span) out -= slips[i];
  }
  return out;
}

void CapstanSlip::add(std::size_t pulley, double slip) {
  slip_[pulley] += slip;
  const std::size_t a = before(pulley), b = behind(pulley);
  elastic_[a] += k_[a] * slip;
  elastic_[b] -= k_[b] * slip;
  viscous_[a] += c_[a] * slip;
  viscous_[b] -= c_[b] * slip;
}

bool CapstanSlip::solve() {
  double largest = 0.0;
  for (std::size_t j = 0; j < spans_; ++j) largest = std::max(largest, tension(j));
  if (largest == 0.0) return true;
  double change = 0.0;
  for (int sweep = 0; sweep < kMostSlipSweeps; ++sweep) {
    change = 0.0;
    for (std::size_t i = 0; i < pulleys_; ++i) {
      const double m = factor_[i];
      if (std::isinf(m)) continue;
      const std::size_t a = before(i), b = behind(i);
      const double had = slip_[i], k_a = k_[a] + c_[a], k_b = k_[b] + c_[b];
      // As if nothing had slipped here.
      const double T_a = elastic_[a] + viscous_[a] - k_a * had;
      const double T_b = elastic_[b] + viscous_[b] + k_b * had;
      double slip = 0.0;
      if (T_b > 0.0 && T_b > m * T_a) {
        slip = (T_b - m * T_a) / (k_b + m * k_a);
        if (T_a + k_a * slip < 0.0) slip = T_b / k_b;  // both end up slack
      } else if (T_a > 0.0 && T_a > m * T_b) {
        slip = -(T_a - m * T_b) / (k_a + m * k_b);
        if (T_b - k_b * slip < 0.0) slip = -T_a / k_a;
      }
      add(i, slip - had);
      slip_[i] = slip;
      change = std::max(change, std::abs(slip - had) * std::max(k_a, k_b));
    }
    if (change <= kShared * largest) return true;
  }
  return change <= kSharedEnough * largest;
}

bool CapstanSlip::has_slipped() const {
  return std::any_of(slip_.begin(), slip_.begin() + static_cast<std::ptrdiff_t>(pulleys_),
                     [](double slip) { return slip != 0.0; });
}

int CapstanSlip::regime() const {
  unsigned sum = 1;
  for (std::size_t i = 0; i < pulleys_; ++i) {
    sum = sum * 3U + (slip_[i] > 0.0 ? 1U : slip_[i] < 0.0 ? 2U : 0U);
  }
  for (std::size_t j = 0; j < spans_; ++j) sum = sum * 1000003U + (tension(j) > 0.0 ? 1U : 0U);
  return static_cast<int>(sum & 0x7fffffffU);
}

CapstanSlip::Square CapstanSlip::slips_by_elongations(const std::array<int, kMost>& directions,
                                                      Square& equations) const {
  const auto n = static_cast<Eigen::Index>(pulleys_), s = static_cast<Eigen::Index>(spans_);
  Square A = Square::Identity(n, n), right = Square::Zero(n, s);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto pulley = static_cast<std::size_t>(i);
    const std::size_t a = before(pulley), b = behind(pulley);
    const double m = factor_[pulley];
    // Derivative of what vanishes, T_b − m T_a or m T_b − T_a, by both tensions.
    const int way = directions[pulley];
    const double of_a = (way > 0 ? -m : -1.0) * taut_stiffness(a);
    const double of_b = (way > 0 ? 1.0 : m) * taut_stiffness(b);
    if (way == 0 || (of_a == 0.0 && of_b == 0.0)) continue;
    A.row(i).setZero();
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto other = static_cast<std::size_t>(k);
      if (directions[other] == 0) continue;
      if (before(other) == a) A(i, k) += of_a;
      if (behind(other) == a) A(i, k) -= of_a;
      if (before(other) == b) A(i, k) += of_b;
      if (behind(other) == b) A(i, k) -= of_b;
    }
    right(i, static_cast<Eigen::Index>(a)) -= of_a;
    right(i, static_cast<Eigen::Index>(b)) -= of_b;
  }
  equations = A;
  return right;
}

RowMix CapstanSlip::mix() const {
  const auto s = static_cast<Eigen::Index>(spans_);
  RowMix mix = RowMix::Identity(s, s);
  if (!has_slipped()) return mix;
  std::array<int, kMost> directions{};
  for (std::size_t i = 0; i < pulleys_; ++i) {
    directions[i] = slip_[i] > 0.0 ? 1 : slip_[i] < 0.0 ? -1 : 0;
  }
  Square A;
  const Square right = slips_by_elongations(directions, A);
  const Square slips = A.fullPivLu().solve(right);
  for (std::size_t i = 0; i < pulleys_; ++i) {
    if (directions[i] == 0) continue;
    mix.row(static_cast<Eigen::Index>(before(i))) += slips.row(static_cast<Eigen::Index>(i));
    mix.row(static_cast<Eigen::Index>(behind(i))) -= slips.row(static_cast<Eigen::Index>(i));
  }
  // From elongations to forces.
  for (Eigen::Index i = 0; i < s; ++i) {
    for (Eigen::Index j = 0; j < s; ++j) {
      const double k_i = taut_stiffness(static_cast<std::size_t>(i));
      const double k_j = taut_stiffness(static_cast<std::size_t>(j));
      if (i != j) mix(i, j) = k_j > 0.0 ? mix(i, j) * k_i / k_j : 0.0;
    }
  }
  return mix;
}

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/cone_impulse.h"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

namespace {

constexpr int kMostTries = 200;
// Of a value that is looked for between two bounds.
constexpr double kLastDigits = 4e-16;
// After so many tries in a row that only one bound moved in, the middle is tried.
constexpr int kTriesToMiddle = 8;

/// What friction along the surface does.
class Rubbing {
 public:
  /// @param B answers of the slip, @param none answers up to this are rounding
  Rubbing(const PlaceMatrix& B, double none) {
    if (B.rows() == 0) return;
    const Eigen::SelfAdjointEigenSolver<PlaceMatrix> modes(B);
    answers_ = modes.eigenvalues();
    directions_ = modes.eigenvectors();
    for (double& answer : answers_) {
      if (answer <= none) answer = HUGE_VAL;  // takes no impulse
    }
  }

  /// The impulse that stops a slip, or the one of the size `most` against what remains of it.
  PlaceVector against(const PlaceVector& slip, double most) const {
    const PlaceVector parts = parts_of(slip);
    if (!(most > 0.0) || !(parts.norm() > 0.0)) return PlaceVector::Zero(slip.size());
    const PlaceVector stops = impulse(parts, 0.0);
    if (stops.norm() <= most) return directions_ * stops;
    const PlaceVector slides = impulse(parts, remaining_slip(parts, most));
    return directions_ * (slides * (most / slides.norm()));
  }

  /// a·B⁻¹ b, without the directions that do not answer.
  double product(const PlaceVector& a, const PlaceVector& b) const {
    return -parts_of(a).dot(impulse(parts_of(b), 0.0));
  }

 private:
  PlaceVector parts_of(const PlaceVector& v) const {
    PlaceVector out = directions_.transpose() * v;
    for (Eigen::Index k = 0; k < out.size(); ++k) {
      if (answers_[k] == HUGE_VAL) out[k] = 0.0;
    }
    return out;
  }

  /// −(B + s)⁻¹ v by modes.
  PlaceVector impulse(const PlaceVector& parts, double s) const {
    PlaceVector out(parts.size());
    for (Eigen::Index k = 0; k < parts.size(); ++k) {
      out[k] = parts[k] == 0.0 ? 0.0 : -parts[k] / (answers_[k] + s);
    }
    return out;
  }

  /// Ratio s of the slip that remains to the impulse with |(B + s)⁻¹ v| = `most`: Newton's method
  /// on the inverse of that size, which is nearly linear in s, between bounds.
  double remaining_slip(const PlaceVector& parts, double most) const {
    double low = 0.0, high = parts.norm() / most;
    double s = 0.0;
    for (int k = 0; k < kMostTries; ++k) {
      const PlaceVector P = impulse(parts, s);
      const double size = P.norm();
      (size > most ? low : high) = s;
      double slope = 0.0;
      for (Eigen::Index m = 0; m < parts.size(); ++m) slope += P[m] * P[m] / (answers_[m] + s);
      double next = s + (size / most) * (size - most) * size / slope;
      if (std::abs(next - s) <= kLastDigits * s) return next;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next == low || next == high) break;
      s = next;
    }
    return s;
  }

  PlaceVector answers_;
  PlaceMatrix directions_;
};

/// Impulse across at which `rate` becomes positive: regula falsi (Illinois) between bounds.
template <class Rate>
double root(const Rate& rate, double at_zero, double first_guess) {
  double low = 0.0, rate_low = at_zero;
  double high = first_guess, rate_high = rate(high);
  for (int k = 0; k < kMostTries && !(rate_high >= 0.0); ++k) {
    low = high;
    rate_low = rate_high;
    high *= 2.0;
    rate_high = rate(high);
  }
  if (!(rate_high >= 0.0)) {
    throw StepFailure(
        "friction takes all that would part the bodies, it jams; give the contact a "
        "`stiffness`, or less `static`");
  }
  bool was_high = false;
  for (int k = 0; k < kMostTries && high - low > kLastDigits * high; ++k) {
    double middle = (low * rate_high - high * rate_low) / (rate_high - rate_low);
    if (!(middle > low && middle < high) || k % kTriesToMiddle == kTriesToMiddle - 1) {
      middle = 0.5 * (low + high);
    }
    if (middle == low || middle == high) break;
    const double there = rate(middle);
    const bool is_high = there >= 0.0;
    (is_high ? high : low) = middle;
    (is_high ? rate_high : rate_low) = there;
    if (there == 0.0) break;
    if (k > 0 && is_high == was_high) (is_high ? rate_low : rate_high) *= 0.5;
    was_high = is_high;
  }
  return high;
}

}  // namespace

PlaceVector rub_impulse(const PlaceMatrix& B, const PlaceVector& slip, double most, double none) {
  return Rubbing(B, none).against(slip, most);
}

PlaceVector cone_impulse(const PlaceMatrix& B, const PlaceVector& v, double coefficient,
                         double none) {
  PlaceVector P = PlaceVector::Zero(v.size());
  if (v[0] >= 0.0 || B(0, 0) <= none) return P;
  const Eigen::Index n = v.size() - 1;
  const Rubbing rubbing(B.bottomRightCorner(n, n), none);
  const PlaceVector coupling = B.col(0).tail(n);
  const PlaceVector slip = v.tail(n);
  const auto press = [&](double across) {
    P[0] = across;
    P.tail(n) = rubbing.against(slip + coupling * across, coefficient * across);
  };
  // Where it sticks, w₀ is linear in P₀.
  const double held = B(0, 0) - rubbing.product(coupling, coupling);
  if (held > none) {
    press((rubbing.product(coupling, slip) - v[0]) / held);
    const PlaceVector w = B.bottomRows(n) * P + slip;
    const double stopped = 16.0 * kLastDigits * (v.norm() + (B.cwiseAbs() * P.cwiseAbs()).norm());
    if (P[0] >= 0.0 && w.norm() <= stopped) return P;
  }
  const auto rate = [&](double across) {
    press(across);
    return v[0] + B.row(0).dot(P);
  };
  press(root(rate, v[0], -v[0] / B(0, 0)));
  return P;
}

}  // namespace buckens::stepping

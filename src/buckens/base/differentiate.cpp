// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/differentiate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace buckens::base {

namespace {

constexpr double kRatio = 1.6;  // no two distances have a common period
constexpr int kMostLevels = 46;
constexpr int kMostColumns = 8;
constexpr double kFastestFall = 2.5;
constexpr double kAgreement = 10.0;
constexpr double kFirstDoubt = 20.0;
constexpr double kEps = std::numeric_limits<double>::epsilon();

/// One central difference with its expected rounding error.
struct Difference {
  double h = 0;
  double value = 0;
  double noise = 0;
};

Difference central(const std::function<double(double)>& f, double t, double f_t, double h,
                   int order) {
  // The actual distance of the two arguments.
  const volatile double ahead = t + h;
  const volatile double behind = t - h;
  const double f_ahead = f(ahead);
  const double f_behind = f(behind);
  Difference out;
  out.h = 0.5 * (ahead - behind);
  const double slope = std::abs(f_ahead - f_behind) / (2.0 * out.h);
  // f is rounded, and so is its argument.
  const double rounding = kEps * (std::max({std::abs(f_ahead), std::abs(f_behind), std::abs(f_t)}) +
                                  std::abs(t) * slope);
  if (order == 1) {
    out.value = (f_ahead - f_behind) / (2.0 * out.h);
    out.noise = rounding / out.h;
  } else {
    out.value = ((f_ahead - f_t) - (f_t - f_behind)) / (out.h * out.h);
    out.noise = 4.0 * rounding / (out.h * out.h);
  }
  return out;
}

/// Neville's scheme in h², rows added with growing h.
class ExtrapolationTable {
 public:
  struct Estimate {
    double value = 0;
    double error = std::numeric_limits<double>::infinity();
  };

  /// The best entry of the new row that agrees with the best one so far.
  Estimate add(const Difference& difference, const Estimate& best) {
    Row row;
    row[0] = difference.value;
    differences_[static_cast<std::size_t>(count_)] = difference;
    Estimate found;
    const int columns = std::min(count_, kMostColumns - 1);
    for (int j = 1; j <= columns; ++j) {
      const auto k = static_cast<std::size_t>(j);
      const Difference& narrow = differences_[static_cast<std::size_t>(count_ - j)];
      const double q = difference.h * difference.h / (narrow.h * narrow.h);
      row[k] = last_[k - 1] + (last_[k - 1] - row[k - 1]) / (q - 1.0);
      const double spread =
          std::max(std::abs(row[k] - row[k - 1]), std::abs(row[k] - last_[k - 1]));
      const double error = spread + 2.0 * narrow.noise;
      const bool agrees = std::abs(row[k] - best.value) <= kAgreement * best.error;
      if (agrees && error < found.error) found = {row[k], error};
    }
    // Two differences may agree by chance; an error that falls faster than this per row is not
    // trusted.
    if (count_ > 1) found.error = std::max(found.error, last_error_ / kFastestFall);
    if (count_ == 1) found.error *= kFirstDoubt;
    if (std::isfinite(found.error)) last_error_ = found.error;
    last_ = row;
    ++count_;
    return found;
  }

 private:
  using Row = std::array<double, kMostColumns>;
  Row last_{};
  std::array<Difference, kMostLevels> differences_{};
  double last_error_ = 0;
  int count_ = 0;
};

}  // namespace

std::optional<double> derivative(const std::function<double(double)>& f, double t, int order) {
  const double f_t = f(t);
  if (!std::isfinite(f_t)) return std::nullopt;
  double h = std::max(order == 1 ? 1e-7 : 1e-6, 1e-8 * std::abs(t));
  ExtrapolationTable table;
  ExtrapolationTable::Estimate best;
  std::optional<double> fallback;
  int rows_without_agreement = 0;
  for (int level = 0; level < kMostLevels && rows_without_agreement < 3; ++level, h *= kRatio) {
    const Difference difference = central(f, t, f_t, h, order);
    if (!std::isfinite(difference.value)) break;
    if (!fallback) fallback = difference.value;
    const auto found = table.add(difference, best);
    if (level == 0) continue;
    rows_without_agreement = std::isfinite(found.error) ? 0 : rows_without_agreement + 1;
    if (found.error < best.error) best = found;
  }
  if (std::isfinite(best.error)) return best.value;
  return fallback;
}

namespace {

// Distance of one-sided differences: short against whatever a mechanism does.
constexpr double kAhead = 1e-7;
constexpr double kAheadOfSecond = 1e-5;
// Slopes that differ by this share, and by kNoSlope of the slope over longer times, make a kink.
constexpr double kKink = 1e-2;
constexpr double kNoSlope = 1e-6;
// A difference that grows as much while its distance shrinks to a sixteenth has no limit.
constexpr double kGrowth = 1.5;

/// Second-order one-sided difference.
double ahead(const std::function<double(double)>& f, double t, double h, int order) {
  if (order == 1) return (-3.0 * f(t) + 4.0 * f(t + h) - f(t + 2.0 * h)) / (2.0 * h);
  return (2.0 * f(t) - 5.0 * f(t + h) + 4.0 * f(t + 2.0 * h) - f(t + 3.0 * h)) / (h * h);
}

double mean_slope(const std::function<double(double)>& f, double t) {
  double out = 0;
  for (const double s : {1e-3, 1e-2, 1e-1, 1.0}) {
    const double slope = std::abs(f(t + s) - f(t)) / s;
    if (std::isfinite(slope)) out = std::max(out, slope);
  }
  return out;
}

}  // namespace

std::optional<double> starting_derivative(const std::function<double(double)>& f, double t,
                                          int order) {
  const std::optional<double> central = derivative(f, t, order);
  const std::optional<double> slope = derivative(f, t, 1);
  const double slope_ahead = ahead(f, t, kAhead, 1);
  if (!std::isfinite(slope_ahead)) return central;
  const bool is_two_sided = slope && std::isfinite(f(t - kAhead));
  const double off = is_two_sided ? std::abs(*slope - slope_ahead) : HUGE_VAL;
  const double rounding = 100.0 * kEps * std::max(std::abs(f(t)), std::abs(f(t + kAhead))) / kAhead;
  const bool is_kink = off > kKink * std::max(std::abs(slope_ahead), std::abs(slope.value_or(0))) &&
                       off > kNoSlope * mean_slope(f, t) && off > rounding;
  if (!is_kink) return central;
  const double h = order == 1 ? kAhead : kAheadOfSecond;
  const double value = ahead(f, t, h, order);
  const double nearer = ahead(f, t, h / 16.0, order);
  const double noise = 100.0 * kEps * std::max(std::abs(f(t)), std::abs(f(t + h)));
  const bool grows = std::abs(nearer) > kGrowth * std::abs(value) &&
                     std::abs(nearer) * std::pow(h / 16.0, order) > noise;
  if (!grows) return value;
  // No limit, as of the second derivative of t^1.5: nothing is right.
  return is_two_sided && central ? central : 0.0;
}

}  // namespace buckens::base

// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/time_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/differentiate.h"
#include "buckens/base/errors.h"
#include "buckens/base/running_integral.h"

namespace buckens::base {

/// A law that is not simply a number.
class TimeLaw::Body {
 public:
  virtual ~Body() = default;
  virtual double value(double t) const = 0;
  virtual double rate(double t) const = 0;
  virtual double acceleration(double t) const = 0;
  virtual bool is_constant() const = 0;
  virtual std::vector<double> corners() const { return {}; }
  virtual std::optional<TimeRange> range() const { return std::nullopt; }
  virtual std::string text() const = 0;
};

namespace {

// Share of its length by which t may lie outside of a table: sums of steps round.
constexpr double kRangeRounding = 1e-9;

/// The last two values of a costly function of time. The iterations of a step ask for the same one
/// or two instants again and again; a derivative by differences takes a hundred evaluations.
class LastValues {
 public:
  template <class F>
  double at(double t, F&& f) const {
    {
      const std::scoped_lock lock(mutex_);
      for (const Known& one : known_) {
        if (one.t == t) return one.value;
      }
    }
    const double value = f();
    const std::scoped_lock lock(mutex_);
    known_[1] = std::exchange(known_[0], Known{t, value});
    return value;
  }

 private:
  struct Known {
    double t = std::numeric_limits<double>::quiet_NaN();
    double value = 0;
  };
  mutable std::mutex mutex_;
  mutable std::array<Known, 2> known_;
};

class Formula final : public TimeLaw::Body {
 public:
  Formula(Expression expression, double scale)
      : expression_(std::move(expression)), scale_(scale) {}

  double value(double t) const override { return scale_ * expression_({t}); }
  double rate(double t) const override {
    return scale_ * rates_.at(t, [&] { return differentiate(t, 1); });
  }
  double acceleration(double t) const override {
    return scale_ * accelerations_.at(t, [&] { return differentiate(t, 2); });
  }
  bool is_constant() const override { return false; }
  std::string text() const override { return '"' + expression_.text() + '"'; }

 private:
  double differentiate(double t, int order) const {
    expression_({t});  // says what is wrong if the value itself does not exist
    const auto f = [this](double s) { return expression_.unchecked({s}); };
    // Motions start at t = 0: what a law does before is no part of it.
    const std::optional<double> out =
        t == 0.0 ? starting_derivative(f, t, order) : derivative(f, t, order);
    if (out) return *out;
    throw NumericalError(
        expression_.where(),
        fmt::format(
            "expression \"{}\" has no {} at t = {:.9g}: it is not defined around this time. "
            "Write it so that it is, e.g. with max(t, 0) in place of t",
            expression_.text(), order == 1 ? "rate" : "acceleration", t));
  }

  Expression expression_;
  double scale_;
  LastValues rates_, accelerations_;
};

/// Piecewise cubic through points; piecewise linear is a special case.
class Table final : public TimeLaw::Body {
 public:
  Table(std::vector<double> times, std::vector<double> values, Interpolation interpolation,
        Extrapolation extrapolation, SourceLocation where)
      : t_(std::move(times)),
        y_(std::move(values)),
        curvature_(t_.size(), 0.0),
        interpolation_(interpolation),
        is_held_(extrapolation == Extrapolation::hold),
        where_(std::move(where)) {
    if (interpolation == Interpolation::spline) solve_natural_spline();
  }

  double value(double t) const override {
    require(t);
    if (t <= t_.front()) return y_.front();
    if (t >= t_.back()) return y_.back();
    const auto [i, h, a, b] = interval(t);
    return a * y_[i] + b * y_[i + 1] +
           ((a * a * a - a) * curvature_[i] + (b * b * b - b) * curvature_[i + 1]) * h * h / 6.0;
  }

  double rate(double t) const override {
    require(t);
    if (is_held_ && (t < t_.front() || t >= t_.back())) return 0.0;
    return rate_within(std::clamp(t, t_.front(), t_.back()));
  }

  double acceleration(double t) const override {
    require(t);
    if (is_held_ && (t < t_.front() || t >= t_.back())) return 0.0;
    const auto [i, h, a, b] = interval(std::clamp(t, t_.front(), t_.back()));
    return a * curvature_[i] + b * curvature_[i + 1];
  }

  bool is_constant() const override {
    return std::all_of(y_.begin(), y_.end(), [this](double y) { return y == y_.front(); });
  }
  std::string text() const override { return "a table"; }

  std::vector<double> corners() const override {
    std::vector<double> out;
    double largest = 0;
    for (std::size_t i = 0; i + 1 < t_.size(); ++i)
      largest = std::max(largest, std::abs(slope_of(i)));
    if (interpolation_ == Interpolation::spline) {
      for (const double end : {t_.front(), t_.back()}) {
        if (is_held_ && std::abs(rate_within(end)) > 1e-9 * largest) out.push_back(end);
      }
      return out;
    }
    double slope = is_held_ ? 0.0 : slope_of(0);
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const double outside = is_held_ ? 0.0 : slope;
      const double next = i + 1 < t_.size() ? slope_of(i) : outside;
      if (std::abs(next - slope) > 1e-9 * largest) out.push_back(t_[i]);
      slope = next;
    }
    return out;
  }

  std::optional<TimeRange> range() const override {
    if (is_held_) return std::nullopt;
    return TimeRange{t_.front(), t_.back(), where_};
  }

 private:
  struct Interval {
    std::size_t i;   // t_[i] ≤ t < t_[i+1]
    double h, a, b;  // its length, and the weights of its ends
  };

  void require(double t) const {
    const double rounding = kRangeRounding * (t_.back() - t_.front());
    if (is_held_ || (t >= t_.front() - rounding && t <= t_.back() + rounding)) return;
    throw NumericalError(
        where_, fmt::format("the table covers t = {:.9g} s to {:.9g} s, but its value at t = "
                            "{:.9g} s is needed; add points, or write `extrapolation: hold`",
                            t_.front(), t_.back(), t));
  }

  /// Rate at a time of the range, at its ends from within.
  double rate_within(double t) const {
    const auto [i, h, a, b] = interval(t);
    return (y_[i + 1] - y_[i]) / h +
           ((1.0 - 3.0 * a * a) * curvature_[i] + (3.0 * b * b - 1.0) * curvature_[i + 1]) * h /
               6.0;
  }

  double slope_of(std::size_t i) const { return (y_[i + 1] - y_[i]) / (t_[i + 1] - t_[i]); }

  Interval interval(double t) const {
    const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
    const auto i = static_cast<std::size_t>(above - t_.begin()) - 1;
    const double h = t_[i + 1] - t_[i];
    return {i, h, (t_[i + 1] - t) / h, (t - t_[i]) / h};
  }

  /// Second derivatives at the points, zero at both ends: a tridiagonal system by elimination.
  void solve_natural_spline() {
    const std::size_t n = t_.size();
    if (n < 3) return;
    std::vector<double> upper(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double left = t_[i] - t_[i - 1];
      const double right = t_[i + 1] - t_[i];
      const double jump = (y_[i + 1] - y_[i]) / right - (y_[i] - y_[i - 1]) / left;
      const double pivot = 2.0 * (left + right) - left * upper[i - 1];
      upper[i] = right / pivot;
      curvature_[i] = (6.0 * jump - left * curvature_[i - 1]) / pivot;
    }
    for (std::size_t i = n - 2; i > 0; --i) curvature_[i] -= upper[i] * curvature_[i + 1];
  }

  std::vector<double> t_, y_, curvature_;
  Interpolation interpolation_;
  bool is_held_;
  SourceLocation where_;
};

/// The law with a given rate that is zero at t = 0.
class Integral final : public TimeLaw::Body {
 public:
  explicit Integral(const TimeLaw& rate)
      : rate_(rate), sum_([rate](double t) { return rate.value(t); }, rate.corners()) {}

  double value(double t) const override {
    return rate_.is_constant() ? rate_.value(t) * t : sum_.to(t);
  }
  double rate(double t) const override { return rate_.value(t); }
  double acceleration(double t) const override { return rate_.rate(t); }
  bool is_constant() const override { return rate_.is_constant() && rate_.value(0.0) == 0.0; }
  std::optional<TimeRange> range() const override { return rate_.range(); }
  std::string text() const override { return "with the speed " + rate_.text(); }

 private:
  TimeLaw rate_;
  RunningIntegral sum_;
};

void check_table(const std::vector<double>& times, const std::vector<double>& values) {
  if (times.empty() || times.size() != values.size()) {
    throw InputError(fmt::format(
        "a table needs as many times as values, and at least one; found {} times and {} values",
        times.size(), values.size()));
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(values[i])) {
      throw InputError(fmt::format("row {} of the table contains {} and {}; both must be finite",
                                   i + 1, times[i], values[i]));
    }
    if (i > 0 && times[i] <= times[i - 1]) {
      throw InputError(fmt::format(
          "the times of a table must increase, but row {} has {:g} s after {:g} s; sort the rows "
          "and remove repetitions",
          i + 1, times[i], times[i - 1]));
    }
  }
}

}  // namespace

TimeLaw TimeLaw::constant(double value) {
  TimeLaw law;
  law.constant_ = value;
  return law;
}

TimeLaw TimeLaw::expression(Expression expression, double scale) {
  if (expression.is_constant()) return constant(scale * expression({0.0}));
  return TimeLaw(std::make_shared<const Formula>(std::move(expression), scale));
}

TimeLaw TimeLaw::table(std::vector<double> times, std::vector<double> values,
                       Interpolation interpolation, Extrapolation extrapolation,
                       SourceLocation where) {
  check_table(times, values);
  if (times.size() == 1) return constant(values.front());
  return TimeLaw(std::make_shared<const Table>(std::move(times), std::move(values), interpolation,
                                               extrapolation, std::move(where)));
}

TimeLaw TimeLaw::integral(const TimeLaw& rate) {
  return TimeLaw(std::make_shared<const Integral>(rate));
}

double TimeLaw::value(double t) const { return body_ ? body_->value(t) : constant_; }
double TimeLaw::rate(double t) const { return body_ ? body_->rate(t) : 0.0; }
double TimeLaw::acceleration(double t) const { return body_ ? body_->acceleration(t) : 0.0; }
std::vector<double> TimeLaw::corners() const {
  return body_ ? body_->corners() : std::vector<double>{};
}
std::optional<TimeRange> TimeLaw::range() const { return body_ ? body_->range() : std::nullopt; }
std::string TimeLaw::text() const { return body_ ? body_->text() : fmt::format("{:g}", constant_); }
bool TimeLaw::is_constant() const { return !body_ || body_->is_constant(); }

}  // namespace buckens::base

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/control_block.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigen::Map<const VectorXd> states_of(std::span<const double> x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

class LinearBlock final : public ControlBlock {
 public:
  LinearBlock(MatrixXd A, VectorXd b, VectorXd c, double d, VectorXd start)
      : A_(std::move(A)), b_(std::move(b)), c_(std::move(c)), d_(d), start_(std::move(start)) {}

  int num_states() const override { return static_cast<int>(A_.rows()); }
  void start(std::span<double> x) const override {
    std::copy(start_.begin(), start_.end(), x.begin());
  }
  double value(std::span<const double> x, double u) const override {
    return c_.dot(states_of(x)) + d_ * u;
  }
  bool feeds_through() const override { return d_ != 0.0; }
  bool is_linear() const override { return true; }
  int relative_degree() const override {
    if (feeds_through()) return 0;
    VectorXd effect = b_;
    for (int k = 1; k < 3; ++k) {
      if (c_.dot(effect) != 0.0) return k;
      effect = VectorXd(A_ * effect);
    }
    return 3;
  }
  void rates(std::span<const double> x, double u, std::span<double> x_dot) const override {
    Eigen::Map<VectorXd> out(x_dot.data(), A_.rows());
    out.noalias() = A_ * states_of(x);
    out += u * b_;
  }

 private:
  MatrixXd A_;
  VectorXd b_, c_;
  double d_;
  VectorXd start_;
};

class ContinuousPid final : public ControlBlock {
 public:
  explicit ContinuousPid(const PidData& data) : data_(data) {}

  // The integral part, and the input as the filter of the derivative sees it.
  int num_states() const override { return 2; }
  void start(std::span<double> x) const override { std::fill(x.begin(), x.end(), 0.0); }
  bool feeds_through() const override {
    return data_.proportional != 0.0 || data_.derivative != 0.0;
  }
  double value(std::span<const double> x, double u) const override {
    return std::clamp(unlimited(x, u), data_.lowest, data_.highest);
  }
  void rates(std::span<const double> x, double u, std::span<double> x_dot) const override {
    const double wanted = unlimited(x, u);
    const double given = std::clamp(wanted, data_.lowest, data_.highest);
    x_dot[0] = data_.integral * u;
    if (given != wanted) x_dot[0] += (given - wanted) / data_.tracking;
    x_dot[1] = data_.filter > 0.0 ? (u - x[1]) / data_.filter : 0.0;
  }

 private:
  double unlimited(std::span<const double> x, double u) const {
    const double rate = data_.filter > 0.0 ? (u - x[1]) / data_.filter : 0.0;
    return data_.proportional * u + x[0] + data_.derivative * rate;
  }

  PidData data_;
};

class SampledPid final : public ControlBlock {
 public:
  explicit SampledPid(const PidData& data) : data_(data) {}

  // What is held; the integral part; the derivative part; the last input; whether there was one.
  int num_states() const override { return 5; }
  void start(std::span<double> x) const override { std::fill(x.begin(), x.end(), 0.0); }
  bool is_held() const override { return true; }
  bool feeds_through() const override { return false; }
  double value(std::span<const double> x, double /*u*/) const override { return x[0]; }
  void rates(std::span<const double>, double, std::span<double> x_dot) const override {
    std::fill(x_dot.begin(), x_dot.end(), 0.0);
  }
  double sample_time() const override { return data_.sample; }

  void sample(std::span<double> x, double u) const override {
    const double T = data_.sample;
    // D s/(1 + filter s) with s = (1 − 1/z)/T.
    const double change = x[4] != 0.0 ? u - x[3] : 0.0;
    x[2] = (data_.filter * x[2] + data_.derivative * change) / (data_.filter + T);
    const double wanted = data_.proportional * u + x[1] + x[2];
    x[0] = std::clamp(wanted, data_.lowest, data_.highest);
    const double growth = data_.integral * T * u;
    const bool makes_worse =
        (wanted > data_.highest && growth > 0.0) || (wanted < data_.lowest && growth < 0.0);
    if (!makes_worse) x[1] += growth;
    x[3] = u;
    x[4] = 1.0;
  }

 private:
  PidData data_;
};

class Switch final : public ControlBlock {
 public:
  Switch(double on, std::optional<double> off, bool start) : on_(on), off_(off), start_(start) {}

  int num_states() const override { return 1; }
  void start(std::span<double> x) const override { x[0] = start_ ? 1.0 : 0.0; }
  bool is_held() const override { return true; }
  bool feeds_through() const override { return false; }
  double value(std::span<const double> x, double /*u*/) const override { return x[0]; }
  void rates(std::span<const double>, double, std::span<double> x_dot) const override {
    x_dot[0] = 0.0;
  }
  bool samples_each_step() const override { return true; }
  void sample(std::span<double> x, double u) const override {
    const bool is_upwards = !off_ || *off_ < on_;
    if (is_upwards ? u >= on_ : u <= on_) {
      x[0] = 1.0;
    } else if (off_ && (is_upwards ? u <= *off_ : u >= *off_)) {
      x[0] = 0.0;
    }
  }

 private:
  double on_;
  std::optional<double> off_;
  bool start_;
};

class SampleHold final : public ControlBlock {
 public:
  explicit SampleHold(double sample) : sample_(sample) {}

  int num_states() const override { return 1; }
  void start(std::span<double> x) const override { x[0] = 0.0; }
  bool is_held() const override { return true; }
  bool feeds_through() const override { return false; }
  double value(std::span<const double> x, double /*u*/) const override { return x[0]; }
  void rates(std::span<const double>, double, std::span<double> x_dot) const override {
    x_dot[0] = 0.0;
  }
  double sample_time() const override { return sample_; }
  void sample(std::span<double> x, double u) const override { x[0] = u; }

 private:
  double sample_;
};

class TableBlock final : public ControlBlock {
 public:
  explicit TableBlock(base::TimeLaw function) : function_(std::move(function)) {}

  int num_states() const override { return 0; }
  void start(std::span<double>) const override {}
  bool feeds_through() const override { return true; }
  double value(std::span<const double>, double u) const override {
    const std::optional<base::TimeRange> range = function_.range();
    if (range && (u < range->first || u > range->last)) {
      throw NumericalError(
          range->where,
          fmt::format("the table of a signal covers inputs from {:g} to {:g}, but is asked for "
                      "{:.6g}; give it more points, or `extrapolation: hold`",
                      range->first, range->last, u));
    }
    return function_.value(u);
  }
  void rates(std::span<const double>, double, std::span<double>) const override {}

 private:
  base::TimeLaw function_;
};

class RateLimit final : public ControlBlock {
 public:
  RateLimit(double rising, double falling, double time_constant, double start)
      : rising_(rising), falling_(falling), time_constant_(time_constant), start_(start) {}

  int num_states() const override { return 1; }
  void start(std::span<double> x) const override { x[0] = start_; }
  bool feeds_through() const override { return false; }
  double value(std::span<const double> x, double /*u*/) const override { return x[0]; }
  void rates(std::span<const double> x, double u, std::span<double> x_dot) const override {
    x_dot[0] = std::clamp((u - x[0]) / time_constant_, -falling_, rising_);
  }

 private:
  double rising_, falling_, time_constant_, start_;
};

/// y = x, which stays until it is set.
class Setting final : public ControlBlock {
 public:
  explicit Setting(double start) : start_(start) {}

  int num_states() const override { return 1; }
  void start(std::span<double> x) const override { x[0] = start_; }
  bool is_held() const override { return true; }
  bool feeds_through() const override { return false; }
  double value(std::span<const double> x, double /*u*/) const override { return x[0]; }
  void rates(std::span<const double>, double, std::span<double> x_dot) const override {
    x_dot[0] = 0.0;
  }

 private:
  double start_;
};

}  // namespace

std::shared_ptr<const ControlBlock> make_linear_block(MatrixXd A, VectorXd b, VectorXd c, double d,
                                                      VectorXd start) {
  return std::make_shared<LinearBlock>(std::move(A), std::move(b), std::move(c), d,
                                       std::move(start));
}

std::shared_ptr<const ControlBlock> make_transfer_function(const std::vector<double>& numerator,
                                                           const std::vector<double>& denominator) {
  // Controllable canonical form: the states are one function and its derivatives.
  const auto n = static_cast<Eigen::Index>(denominator.size()) - 1;
  const double leading = denominator.front();
  const auto above = [&](Eigen::Index power) {
    const auto place = static_cast<Eigen::Index>(numerator.size()) - 1 - power;
    return place < 0 ? 0.0 : numerator[static_cast<std::size_t>(place)] / leading;
  };
  const auto below = [&](Eigen::Index power) {
    return denominator[static_cast<std::size_t>(n - power)] / leading;
  };
  MatrixXd A = MatrixXd::Zero(n, n);
  VectorXd b = VectorXd::Zero(n), c(n);
  const double d = above(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k + 1 < n) A(k, k + 1) = 1.0;
    A(n - 1, k) = -below(k);
    c[k] = above(k) - below(k) * d;
  }
  if (n > 0) b[n - 1] = 1.0;
  return make_linear_block(std::move(A), std::move(b), std::move(c), d, VectorXd::Zero(n));
}

std::shared_ptr<const ControlBlock> make_pid(const PidData& data) {
  if (data.sample > 0.0) return std::make_shared<SampledPid>(data);
  return std::make_shared<ContinuousPid>(data);
}

std::shared_ptr<const ControlBlock> make_switch(double on, std::optional<double> off, bool start) {
  return std::make_shared<Switch>(on, off, start);
}

std::shared_ptr<const ControlBlock> make_table_block(base::TimeLaw function) {
  return std::make_shared<TableBlock>(std::move(function));
}

std::shared_ptr<const ControlBlock> make_rate_limit(double rising, double falling,
                                                    double time_constant, double start) {
  return std::make_shared<RateLimit>(rising, falling, time_constant, start);
}

std::shared_ptr<const ControlBlock> make_setting(double start) {
  return std::make_shared<Setting>(start);
}

std::shared_ptr<const ControlBlock> make_sample_hold(double sample) {
  return std::make_shared<SampleHold>(sample);
}

}  // namespace buckens::model

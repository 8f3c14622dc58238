// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/time_law.h"

namespace buckens::model {

/// A block with states x, one input u and one value y.
///
/// Continuous blocks have rates ẋ = f(x, u) and values y = g(x, u). Sampled blocks update their
/// states at multiples of their sample time and hold their value in between.
class ControlBlock {
 public:
  virtual ~ControlBlock() = default;

  virtual int num_states() const = 0;
  /// Writes the states at t = 0.
  virtual void start(std::span<double> x) const = 0;
  virtual double value(std::span<const double> x, double u) const = 0;
  /// Whether the value depends on the input at the same instant.
  virtual bool feeds_through() const = 0;
  /// Writes ẋ, zero for sampled blocks.
  virtual void rates(std::span<const double> x, double u, std::span<double> x_dot) const = 0;

  /// Whether rates and value are linear in states and input.
  virtual bool is_linear() const { return false; }
  /// Number of times that the value must be differentiated until the input appears; 3 means more.
  virtual int relative_degree() const { return feeds_through() ? 0 : 1; }
  /// Whether the value is constant between samples, switches or settings.
  virtual bool is_held() const { return false; }

  /// Sample time [s]; 0: continuous.
  virtual double sample_time() const { return 0.0; }
  /// Whether it is sampled at the end of every step, whatever its length.
  virtual bool samples_each_step() const { return false; }
  /// Advances the states of a sampled block by one sample.
  virtual void sample(std::span<double> /*x*/, double /*u*/) const {}
};

/// ẋ = A x + b u, y = c·x + d u.
std::shared_ptr<const ControlBlock> make_linear_block(Eigen::MatrixXd A, Eigen::VectorXd b,
                                                      Eigen::VectorXd c, double d,
                                                      Eigen::VectorXd start);

/// The same from coefficients of a proper transfer function by falling powers of s, at rest.
/// @pre neither is empty, the first of the denominator is not zero, and the numerator is no longer
std::shared_ptr<const ControlBlock> make_transfer_function(const std::vector<double>& numerator,
                                                           const std::vector<double>& denominator);

/// Gains and limits of a controller.
struct PidData {
  double proportional = 0, integral = 0, derivative = 0;
  double filter = 0;  ///< [s]; 0 only if sampled or without derivative
  double lowest = 0, highest = 0;
  double tracking = 0;  ///< [s] > 0 of a continuous one with limits
  double sample = 0;    ///< [s]; 0: continuous
};

/// v = P e + I ∫e + D s/(1 + T s) e, y = v within its limits; the integral follows by
/// (y − v)/tracking. Sampled: the integral by the rule of rectangles, the derivative by backward
/// differences, and no integral while the value is limited and would grow.
std::shared_ptr<const ControlBlock> make_pid(const PidData& data);

/// y = f(u), without states. @param function over its input in place of time
std::shared_ptr<const ControlBlock> make_table_block(base::TimeLaw function);

/// T ẋ = u − x within −falling … rising, y = x.
/// @param rising,falling,time_constant > 0
std::shared_ptr<const ControlBlock> make_rate_limit(double rising, double falling,
                                                    double time_constant, double start);

/// y is 1 from the time the input reaches `on` until it reaches `off`, evaluated at ends of steps.
/// @param off none: it stays on
std::shared_ptr<const ControlBlock> make_switch(double on, std::optional<double> off, bool start);

/// y is its only state, which changes only when it is set between steps. @param start its value
/// at t = 0
std::shared_ptr<const ControlBlock> make_setting(double start);

/// y is the input at the last sample. @param sample [s]
std::shared_ptr<const ControlBlock> make_sample_hold(double sample);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "buckens/model/control_block.h"
#include "buckens/model/signal.h"

namespace buckens::model {

/// The value of a signal from a function in code, which depends on time and on other signals at
/// the same instant.
///
/// A block without states. Other blocks have one input, this one takes all signals; evaluation of
/// signals calls function_of() first.
class FunctionSignal final : public ControlBlock {
 public:
  /// f(t, values of the inputs). It is called several times per step and must return the same
  /// value for the same arguments.
  using Law = std::function<double(double t, std::span<const double> values)>;

  /// @param name of the signal, for messages
  /// @param inputs names of signals, @param places their indices among all signals
  FunctionSignal(std::string name, std::vector<std::string> inputs, std::vector<int> places,
                 Law law);

  const std::vector<std::string>& inputs() const { return inputs_; }
  bool takes(const std::string& signal) const;
  /// @param signals t and the values of all signals
  /// @throws NumericalError naming the signal if the function returns something that is not finite
  double value_at(double t, std::span<const double> signals) const;

  int num_states() const override { return 0; }
  void start(std::span<double>) const override {}
  bool feeds_through() const override { return true; }
  void rates(std::span<const double>, double, std::span<double>) const override {}
  /// Not for this block, see value_at().
  double value(std::span<const double> x, double u) const override;

 private:
  std::string name_;
  std::vector<std::string> inputs_;
  std::vector<int> places_;
  Law law_;
};

/// The function that computes the value of a signal, or null.
const FunctionSignal* function_of(const Signal& signal);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/function_signal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model {

FunctionSignal::FunctionSignal(std::string name, std::vector<std::string> inputs,
                               std::vector<int> places, Law law)
    : name_(std::move(name)),
      inputs_(std::move(inputs)),
      places_(std::move(places)),
      law_(std::move(law)) {}

bool FunctionSignal::takes(const std::string& signal) const {
  return std::find(inputs_.begin(), inputs_.end(), signal) != inputs_.end();
}

double FunctionSignal::value_at(double t, std::span<const double> signals) const {
  std::vector<double> values;
  values.reserve(places_.size());
  for (const int place : places_) values.push_back(signals[static_cast<std::size_t>(place) + 1]);
  const double value = law_(t, values);
  if (std::isfinite(value)) return value;
  std::string given;
  for (std::size_t k = 0; k < values.size(); ++k) {
    given += fmt::format(", {} = {:.6g}", inputs_[k], values[k]);
  }
  throw NumericalError(fmt::format("signal \"{}\": its function gives {} at t = {:.6g} s{}", name_,
                                   value, t, given));
}

double FunctionSignal::value(std::span<const double> /*x*/, double /*u*/) const {
  BUCKENS_ASSERT(false && "value_at() is meant");
  return 0.0;
}

const FunctionSignal* function_of(const Signal& signal) {
  return dynamic_cast<const FunctionSignal*>(signal.block.get());
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/signal_law.h"

#include <algorithm>
#include <array>
#include <utility>

#include "buckens/base/errors.h"

namespace buckens::base {

namespace {

using Values = std::array<double, SignalLaw::kMostSignals + 1>;

template <std::size_t... k>
double call(const Expression& formula, const Values& values, std::index_sequence<k...> /*first*/) {
  return formula({values[k]...});
}

/// Calls a formula with the first `count` of the values: expressions take a list of known length.
template <std::size_t most = SignalLaw::kMostSignals + 1>
double call_with(const Expression& formula, const Values& values, std::size_t count) {
  if (count == most) return call(formula, values, std::make_index_sequence<most>());
  if constexpr (most > 1) return call_with<most - 1>(formula, values, count);
  return formula({});
}

}  // namespace

SignalLaw SignalLaw::of(std::string signal, int place) {
  SignalLaw out;
  out.formula = Expression("s", {"t", "s"}, {}, {});
  out.names = {std::move(signal)};
  out.places = {place};
  return out;
}

bool SignalLaw::uses(const std::string& signal) const {
  return formula && std::find(names.begin(), names.end(), signal) != names.end();
}

double SignalLaw::value(double t, std::span<const double> signals) const {
  if (!formula) return law.value(t);
  BUCKENS_ASSERT(!signals.empty() && places.size() <= kMostSignals);
  Values values{};
  values[0] = t;
  for (std::size_t k = 0; k < places.size(); ++k) {
    values[k + 1] = signals[static_cast<std::size_t>(places[k]) + 1];
  }
  return scale * call_with(*formula, values, places.size() + 1);
}

}  // namespace buckens::base

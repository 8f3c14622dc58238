// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/base/errors.h"
#include "buckens/base/saved_values.h"
#include "buckens/model/model.h"

namespace buckens::analysis {

/// Whether anything in the model acts by the value of a signal.
bool follows_signals(const model::Model& model);

/// Notes when signals double, to tell those that a diverging controller drives from others where a
/// step fails. Theory: docs/theory/24-control.md §4.
class SignalGrowth {
 public:
  explicit SignalGrowth(const model::Model& model);

  /// @param signals t and the values of all signals at the end of a step
  void follow(const std::vector<double>& signals);

  /// @throws NumericalError naming the signals that have grown exponentially, and the failure
  void check_failed(const NumericalError& failure) const;

  void visit_saved(const base::SaveVisit& visit);

 private:
  /// An instant at which a signal was at least twice as large as ever before it.
  struct Doubling {
    double t = 0, size = 0;
  };
  /// The stretch in which a signal has grown exponentially up to now; none if it has not.
  struct Stretch {
    Doubling from, to;
  };
  std::optional<Stretch> growth(std::size_t signal) const;

  const model::Model& model_;
  bool acts_ = false;  ///< whether anything in the model follows signals
  std::vector<std::vector<Doubling>> doublings_;
};

}  // namespace buckens::analysis

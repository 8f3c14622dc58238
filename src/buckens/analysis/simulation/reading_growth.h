// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/model.h"

namespace buckens::analysis {

/// Finds readings of sensors whose changes grow from step to step: what follows a reading answers
/// to each change of it by a larger one. Theory: docs/theory/24-control.md §3.
class ReadingGrowth {
 public:
  explicit ReadingGrowth(const model::Model& model);

  /// @param signals t and the values of all signals at the end of a step, with its readings
  /// @throws NumericalError naming the signal, its sensor and what to do
  void follow(const std::vector<double>& signals);

  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Reading {
    std::size_t signal = 0;
    double last = 0;
    double change = 0;          ///< in the last step
    double largest = 0;         ///< ever
    double first_change = 0;    ///< of those that have grown from step to step
    double largest_before = 0;  ///< before these
    double since = 0;           ///< instant of the first [s]
    long count = 0;             ///< of those after the first
    double ratio = 0;           ///< of the last change to that before
  };
  [[noreturn]] void refuse(const Reading& reading, double t) const;

  const model::Model& model_;
  std::vector<Reading> readings_;
};

}  // namespace buckens::analysis

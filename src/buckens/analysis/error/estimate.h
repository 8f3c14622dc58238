// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/analysis/error/sensor_curves.h"
#include "buckens/results/error_statement.h"

namespace buckens::analysis {

/// Uncertainty of a run over its difference from a finer one, for errors that fall with order 2:
///
///     |f − f₁| = |f₂ − f₁| r²/(r² − 1),   times a safety of 3
///
/// Covers the error down to an observed order of 0.42 where r = 2. Source: P. J. Roache,
/// Verification and Validation in Computational Science and Engineering, 1998, §5 (grid convergence
/// index; 3 is his safety for two grids, 1.25 that for three).
/// @param refinement r > 1, how many times finer
double two_grid_factor(double refinement);

/// The same if the further run has no error of this kind: the difference, times 1.25.
double exact_factor();

/// Estimates the uncertainty of the sensors of a run from further runs that each improve one thing.
class ErrorEstimate {
 public:
  /// @param run must outlive the estimate
  explicit ErrorEstimate(const SensorCurves& run);

  /// Adds a further run. Values are compared at equal times, interpolated linearly between its
  /// records.
  void add(results::ErrorSource source, const SensorCurves& further);
  void note(std::string text) { out_.notes.push_back(std::move(text)); }
  void set_incomplete() { out_.is_complete = false; }

  results::ErrorStatement statement() const;

 private:
  const SensorCurves& run_;
  results::ErrorStatement out_;
};

}  // namespace buckens::analysis

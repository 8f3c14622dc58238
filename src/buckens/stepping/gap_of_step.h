// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::stepping {

/// A gap over one step: the cubic through gaps and rates at both ends.
struct GapOfStep {
  double start, rate_start;
  double end, rate_end;
  double h;

  /// Part of the step after which the cubic goes below zero for good, 0 … 1.
  double closes_at() const;
  /// Rate of the cubic after the part s of the step.
  double rate_at(double s) const;
  /// The same, but no faster or slower than at both ends by more than a tenth: a cubic that is has
  /// gone through more than one place.
  double likely_rate_at(double s) const;
  /// Whether the gap has changed over the step by clearly other than its rates allow: then its
  /// place at the start is another one than at the end, as where an edge takes over from a face.
  bool begins_elsewhere() const;
};

}  // namespace buckens::stepping

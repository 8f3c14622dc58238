// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::stepping {

/// A gap over one step: the cubic through gaps and rates at both ends.
struct GapOfStep {
  double start, rate_start;
  double end, rate_end;
  double h;

  /// Fraction of the step after which the cubic stays below zero, 0 … 1.
  double closes_at() const;
  /// Rate of the cubic after the fraction s of the step.
  double rate_at(double s) const;
  /// The same, but limited to the rates at both ends, extended by a tenth of the larger one: beyond
  /// that, the cubic has passed through more than one contact point.
  double likely_rate_at(double s) const;
  /// Whether the gap has changed by clearly more or less than its rates allow: its contact point at
  /// the start then differs from that at the end, as where an edge takes over from a face.
  bool begins_elsewhere() const;
};

}  // namespace buckens::stepping

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <vector>

namespace buckens::base {

/// ∫₀ᵗ f(s) ds for successive t, to about 1e-13 of ∫|f|.
///
/// Goes from 0 upwards in panels of 15 Gauss–Kronrod points that adapt to f, and keeps their sums.
/// Panels depend on f alone and never reach beyond the largest t asked for, so the same t gives the
/// same number whatever was asked before. Thread-safe.
class RunningIntegral {
 public:
  /// @param f may throw; to() lets the exception through
  /// @param breaks times at which f or its derivative jumps; panels end there. Ascending
  explicit RunningIntegral(std::function<double(double)> f, std::vector<double> breaks = {});

  /// @throws NumericalError if f varies so fast that more than a few million panels are needed
  double to(double t) const;

 private:
  struct Mark {
    double at, sum;  // sum: ∫ from 0 to here
    double reach;  // end of the first panel tried from here, or of an earlier one that went further
  };

  double next_break(double after) const;
  Mark mark_at(double at, double sum) const;
  void advance(double t) const;
  double within_panel(double a, double b) const;

  std::function<double(double)> f_;
  std::vector<double> breaks_;
  mutable std::mutex mutex_;
  mutable std::vector<Mark> marks_;
  mutable double width_;  // of the next panel
};

}  // namespace buckens::base

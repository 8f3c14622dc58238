// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::body {

/// A shift μ with which K + μM is definite and tells the lowest ω² well: it must not be lost in the
/// rounding of K, nor be far above ω². Each shift that is tried takes a factor.
class ShiftSearch {
 public:
  /// @param first shift to be tried [1/s²] @param highest_square of the frequencies [1/s²]
  ShiftSearch(double first, double highest_square);

  double shift() const { return shift_; }
  /// Which shift this is, from 1.
  int attempt() const { return attempt_; }
  /// K + μM was not definite: goes on to a larger shift. @return false after the last one
  bool raise();
  /// Whether a lower one is worth a further factor. @param square the lowest ω² as far as known
  bool is_too_high(double square) const;
  /// Goes on to it. @pre is_too_high(square)
  void lower(double square);

 private:
  double lowest_useful() const;

  double least_, shift_;
  double drowned_ = 0.0;  // the largest that was lost
  int attempt_ = 1;
};

}  // namespace buckens::body

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "buckens/loads/row_mix.h"

namespace buckens::loads {

/// How spans in a row share their length where the tensions on both sides of a pulley may differ by
/// no more than a factor.
///
/// With σ_i the length that slips forwards over pulley i, the spans before and behind it have the
/// tensions T_a + k_a σ_i and T_b − k_b σ_i. Either σ_i = 0 and T_b/m ≤ T_a ≤ m T_b, or the
/// tension in the direction of slip is m times the other. Solved pulley by pulley until
/// nothing moves.                                                                          (R32)
class CapstanSlip {
 public:
  static constexpr int kMost = 16;
  using Square = RowMix;
  using Values = std::array<double, kMost>;

  void reset(std::size_t spans, std::size_t pulleys, bool is_closed);
  /// @param stiffness of the elastic tension, @param resistance of the viscous one to what slips
  /// within the step [N/m]
  /// @param elastic tension without slip, negative: slack [N], @param viscous share [N]
  void set_span(std::size_t span, double stiffness, double resistance, double elastic,
                double viscous);
  /// @param factor m ≥ 1; without one, nothing slips
  void set_pulley(std::size_t pulley, double factor) { factor_[pulley] = factor; }
  /// @return false if the pulleys found no balance
  bool solve();

  /// At least zero [N].
  double tension(std::size_t span) const;
  /// Its elastic share, negative: slack [N].
  double elastic(std::size_t span) const { return elastic_[span]; }
  /// By which its elongation would stretch it if nothing slipped [N/m]; zero while it is slack.
  double taut_stiffness(std::size_t span) const { return tension(span) > 0.0 ? k_[span] : 0.0; }
  /// Elongation by slip [m].
  double lengthened(std::size_t span) const { return of_spans(slip_, span); }
  /// What slips over all pulleys give to one span. @param slips one per pulley
  double of_spans(const Values& slips, std::size_t span) const;
  /// σ [m].
  double slipped(std::size_t pulley) const { return slip_[pulley]; }
  bool has_slipped() const;
  int regime() const;

  /// How tensions follow those that spans would have if nothing slipped from here on.
  RowMix mix() const;

 private:
  std::size_t before(std::size_t pulley) const {
    return is_closed_ ? (pulley + spans_ - 1) % spans_ : pulley;
  }
  std::size_t behind(std::size_t pulley) const { return is_closed_ ? pulley : pulley + 1; }
  void add(std::size_t pulley, double slip);
  /// Equations of the pulleys that slip, directions given: slips by elongations.
  Square slips_by_elongations(const std::array<int, kMost>& directions, Square& equations) const;

  std::size_t spans_ = 0, pulleys_ = 0;
  bool is_closed_ = false;
  Values k_{}, c_{}, elastic_{}, viscous_{}, factor_{}, slip_{};
};

}  // namespace buckens::loads

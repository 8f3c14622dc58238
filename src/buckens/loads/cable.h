// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// A place that a cable passes: a pulley, or one of its ends: a point without a radius, or a drum
/// to whose rim it is fixed.
struct CableNode {
  double radius = 0;  ///< [m], negative: the cable runs around it clockwise; 0: a point
  Eigen::Vector3d mark = Eigen::Vector3d::UnitX();  ///< across the axis, in its marker
  std::optional<double> coefficient;                ///< of friction; none: it does not slip here
};

/// Parameters of a cable.
struct CableData {
  std::vector<CableNode> nodes;  ///< in the order in which it passes them, at most kMostNodes
  bool is_closed = false;
  std::size_t first_pulley = 0;                     ///< node in whose marker the axis stands
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector
  double stiffness = 0;                             ///< E A [N]
  double damping_time = 0;                          ///< [s]
  std::vector<double> placed;                       ///< its states as placed
};

/// What a cable does at one instant.
struct CableReading {
  std::vector<double> tensions;  ///< one per span [N]
  std::vector<double> wraps;     ///< one per pulley [rad]
  std::vector<double> slips;     ///< by which it has slipped forwards over each pulley [m]
};

/// A cable over pulleys with parallel axes: elastic spans that only pull.
///
/// Of each span, L is the length between the points where it touches, and ℓ the unstretched length
/// in it. Pulleys take in and give out ℓ as they turn and as the spans turn about them; the tension
/// is E A (L − ℓ)/ℓ. Where the tensions on both sides of a pulley differ by more than the factor
/// exp(μ φ), φ being the wrap, ℓ slips over it. States: of each pulley its angle from both spans,
/// its wrap, the slip so far and its rate, and the rates of both angles; ℓ of each span; the
/// instant; the angles of both ends and their rates. Theory: docs/theory/22-rows.md §7 (R31).
class Cable final : public ForceElement {
 public:
  static constexpr std::size_t kMostNodes = 16;

  explicit Cable(CableData data);

  /// Nothing: it needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  void add_to_others(const Sight& sight, std::span<spatial::Wrench> wrenches) const override;
  int num_soft_rows() const override { return static_cast<int>(num_spans()); }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  void append_others_of_rows(const Sight& sight, std::vector<TwistRow>& rows) const override;
  bool mix_rows(const Sight& sight, RowMix& mix) const override;
  int num_states() const override;
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;

  CableReading read(const Sight& sight) const;

  const CableData& data() const { return data_; }
  std::size_t num_spans() const { return data_.nodes.size() - (data_.is_closed ? 0 : 1); }
  std::size_t num_pulleys() const { return data_.nodes.size() - (data_.is_closed ? 0 : 2); }
  /// Node of a pulley; drums at its ends are none.
  std::size_t node_of(std::size_t pulley) const { return pulley + (data_.is_closed ? 0 : 1); }

  /// States as placed. @param markers one per node, @param pretension [N], @param turns whole turns
  /// around each pulley in addition
  /// @throws InputError without a place if a span cannot be formed
  static std::vector<double> placed_states(const CableData& data,
                                           std::span<const spatial::MarkerMotion> markers,
                                           double pretension, std::span<const int> turns);
  /// Where its spans begin and end, world axes [m]: two per span.
  static std::vector<Eigen::Vector3d> span_ends(const CableData& data,
                                                std::span<const spatial::MarkerMotion> markers);

 private:
  struct Stand;
  std::size_t last_node() const { return data_.nodes.size() - 1; }
  /// Finds the spans, with what was in them at the start of the step.
  /// @param states as at the start of the step
  void find_spans(const Sight& sight, const double* states, Stand& s) const;
  /// Takes in and gives out what pulleys wind; finds their wraps.
  void wind_pulleys(const Sight& sight, const double* states, Stand& s) const;
  /// The same of drums at its ends.
  void wind_ends(const Sight& sight, const double* states, Stand& s) const;
  /// Of all spans, before anything slips within the step.
  void set_tensions(const double* states, Stand& s) const;
  Stand look(const Sight& sight) const;
  /// @param before states of the pulley @throws StepTooLong if its turns cannot be counted
  static void require_followed(std::size_t pulley, const double* before, const Stand& s);
  bool may_slip() const;

  CableData data_;
};

}  // namespace buckens::loads

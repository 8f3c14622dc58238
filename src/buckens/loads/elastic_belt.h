// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Parameters of a belt over two pulleys.
struct ElasticBeltData {
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();  ///< unit vector, first marker
  Eigen::Vector3d x_F = Eigen::Vector3d::UnitX();     ///< across the axis, first marker
  Eigen::Vector3d x_M = Eigen::Vector3d::UnitX();     ///< across the axis, second marker
  double first_radius = 0;                            ///< [m]
  double second_radius = 0;                           ///< [m], negative: the belt is crossed
  double stiffness = 0;                               ///< of one span [N/m]
  double damping = 0;                                 ///< of one span [N s/m]
  double pretension = 0;                              ///< [N]
  double way = 0;                     ///< of a span and its share of the wraps, as placed [m]
  std::optional<double> coefficient;  ///< none: it does not slip
  double placed_angle = 0;            ///< of both pulleys from the line of centres, as placed [rad]
};

/// What a belt does at one instant.
struct BeltReading {
  double left = 0, right = 0;  ///< tensions of both spans, seen against the axis [N]
  double slip = 0;             ///< by which it has slipped in all [m]
};

/// A belt over two pulleys: two elastic spans that only pull, and slip by the capstan law.
///
/// With δ = L − L₀ the elongation that moving centres cause and x what the rims have wound from
/// one span to the other, the tensions are T₀ + k (δ ± x) and at least zero. Their difference is
/// friction between belt and rims: it is at most the share (m − 1)/(m + 1) of their sum,
/// m = exp(μ φ) with the smaller wrap φ, and x yields there as in JointFriction. States: the angles
/// of both pulleys from the line of centres, x, the slip so far, and the rates of both angles with
/// the instant to which they belong.
/// Theory: docs/theory/22-rows.md §6.
class ElasticBelt final : public ForceElement {
 public:
  explicit ElasticBelt(const ElasticBeltData& data) : data_(data) {}

  /// Nothing: it needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override { return 2; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  int num_states() const override { return kStates; }
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;

  BeltReading read(const Sight& sight) const;
  /// Of the pulleys, unit vector in the first marker.
  const Eigen::Vector3d& axis() const { return data_.axis_F; }
  /// Of both pulleys; the second is negative where the belt is crossed [m].
  std::array<double, 2> radii() const { return {data_.first_radius, data_.second_radius}; }

  /// Length of a span and its share of the wraps [m]. @param distance of the centres [m]
  /// @pre the pulleys do not overlap
  static double way(double distance, double first_radius, double second_radius);

 private:
  /// Geometry and forces at one instant.
  struct Stand;
  static constexpr int kStates = 7;
  Stand look(const Sight& sight) const;

  ElasticBeltData data_;
};

}  // namespace buckens::loads

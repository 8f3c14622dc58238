// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/joints/coordinate_measure.h"
#include "buckens/joints/space_curve.h"

namespace buckens::joints {

/// The way of a point of M along a curve c(u) fixed in F, from where it is placed:
///
///     σ = ∫ |c′| du,   c′(u)·(ρ − c(u)) = 0,   σ̇ = |c′| c′·ρ̇ / (|c′|² − c″·(ρ − c))        (R37)
///
/// with the point's place ρ in F. On closed curves laps add up; a point that the joint has let go
/// is followed by the nearest of all places. Of a plane curve, distances out of
/// its plane do not count.
class PathCoordinate final : public CoordinateMeasure {
 public:
  /// @param across unit normal of a plane curve in F, or zero
  /// @param r_F_placed position of M in F as placed [m]
  PathCoordinate(std::shared_ptr<const SpaceCurve> curve, const Eigen::Vector3d& across,
                 const Eigen::Vector3d& r_F_placed);

  bool is_angle() const override { return false; }
  CoordinateLook look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                      const CountedValue* before) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const CountedValue* before) const override;

  /// Length along the whole curve [m].
  double lap() const { return ways_.back(); }
  /// Length along the curve from its first point to a parameter, over laps [m].
  double way(double u) const;

 private:
  /// Where the point is nearest, all in F and without what is out of the plane.
  struct Place {
    double u = 0;
    Eigen::Vector3d tangent, curvature, off;  // c′, c″, ρ − c
    double steep = 0;                         // |c′|² − c″·(ρ − c)
  };
  Place place(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const CountedValue* before) const;
  Eigen::Vector3d flat(const Eigen::Vector3d& v) const { return v - across_.dot(v) * across_; }
  /// Integral of |c′| between two parameters within a piece.
  double length_between(double from, double to) const;
  /// A parameter near a length along the curve.
  double parameter_near(double way) const;

  std::shared_ptr<const SpaceCurve> curve_;
  Eigen::Vector3d across_;
  std::vector<double> parameters_, ways_;  // ends of pieces over which |c′| is smooth
  double start_ = 0;                       // as placed [m]
};

}  // namespace buckens::joints

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "buckens/joints/curve_gap.h"
#include "buckens/joints/row_law.h"

namespace buckens::joints {

/// A point of M on a curve c(s) fixed in F: one direction n across the curve.
///
///     g = n(s)·(ρ − c(s)),   c′(s)·(ρ − c(s)) = 0 (R11)
///
/// with the point's place ρ in F. s is that of the nearest point, sought from the one of the step
/// before, which is the row's state: at the nearest point changes of s do not change g, so the
/// force acts along n at the point.
class PathRow final : public RowLaw {
 public:
  /// @param normal unit vector in F across the plane of the curve; none: a curve in space
  /// @param number of the row: 0, or 1 for the second direction in space
  PathRow(std::shared_ptr<const SpaceCurve> curve, const std::optional<Eigen::Vector3d>& normal,
          int number);

  const SpaceCurve& curve() const { return *curve_; }
  const std::shared_ptr<const SpaceCurve>& shared_curve() const { return curve_; }
  /// Unit normal of a plane curve; zero in space.
  const Eigen::Vector3d& across() const { return across_; }

  int num_states() const override { return 2; }
  bool turns_second() const override { return false; }
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  /// @throws NumericalError if the point has left an open curve
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;

 private:
  CurveTouch look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                  const double* states) const;

  std::shared_ptr<const SpaceCurve> curve_;
  Eigen::Vector3d across_;  // of a plane curve, zero in space
  Eigen::Vector3d hint_;    // in space: a direction that the curve never follows for long
  int number_;
};

/// Rows of a point on a curve: one across a plane curve, two in space.
std::vector<std::shared_ptr<const RowLaw>> make_path_rows(
    const std::shared_ptr<const SpaceCurve>& curve, const std::optional<Eigen::Vector3d>& normal);

}  // namespace buckens::joints

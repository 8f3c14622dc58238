// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/row_law.h"

namespace buckens::joints {

/// A wheel with centre M that rolls on a plane through F: one direction d at the place of contact.
///
///     x = r − (R − b) e − b n,   e = (n − a (a·n))/|n − a (a·n)| (R17) ġ = d·(v_M + ω_M × (x − r)
///     − v_F − ω_F × x)
///
/// with r from F to M, the plane's normal n, the wheel's axis a, its radius R and that of its edge
/// b. Along n this is the rate of the height g = n·x. Along the plane it is that of no position:
/// such a row holds its rate only.
class RollingRow final : public RowLaw {
 public:
  struct Data {
    Eigen::Vector3d normal_F = Eigen::Vector3d::UnitZ();  ///< unit vector
    Eigen::Vector3d axis_M = Eigen::Vector3d::UnitY();    ///< unit vector
    double radius = 1, edge = 0;                          ///< R, b [m]
  };
  enum class Direction { normal, ahead, aside };
  RollingRow(const Data& data, Direction direction) : data_(data), direction_(direction) {}

  const Data& data() const { return data_; }

  /// How a wheel stands on its plane, world components.
  struct Stand {
    Eigen::Vector3d n, a;   ///< normal and axis
    double tilt, lean;      ///< a·n and |n − a (a·n)|
    Eigen::Vector3d e;      ///< across the axis, away from the contact
    Eigen::Vector3d ahead;  ///< (a × n)/|a × n|
  };
  /// @throws NumericalError if the wheel lies flat
  static Stand stand(const Data& data, const spatial::MarkerMotion& F,
                     const spatial::MarkerMotion& M);
  struct StandRates {
    Eigen::Vector3d n, a;
    double tilt, lean;
    Eigen::Vector3d e;
  };
  static StandRates rates(const Stand& at, const spatial::MarkerMotion& F,
                          const spatial::MarkerMotion& M);

  int num_states() const override { return 0; }
  bool holds_rates_only() const override { return direction_ != Direction::normal; }
  /// @throws NumericalError if the wheel lies flat
  RowValue evaluate(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                    const double* states) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M, double t,
              const double* states) const override;
  void follow(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double lambda,
              double t, const double* before, double* after) const override;

 private:
  struct View;
  View look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const;

  Data data_;
  Direction direction_;
};

}  // namespace buckens::joints

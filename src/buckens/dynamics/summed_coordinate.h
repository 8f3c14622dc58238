// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/dynamics/travel.h"

namespace buckens::dynamics {

/// One of the coordinates that a coupler sums, at one instant: that of a joint between two markers,
/// or of a slider on a beam.
class SummedCoordinate {
 public:
  /// All arguments must outlive the object. @param memory as for evaluate_constraints()
  SummedCoordinate(const model::Model& model, const model::CoupledCoordinate& coupled,
                   const std::vector<BodyMotion>& motions, double t,
                   const model::RowMemory* memory);

  const joints::CountedValue& value() const { return value_; }
  /// Rate of its term, slope times rate of the coordinate.
  double rate() const { return slope_ * rate_; }
  /// Second derivative of its term without accelerations of bodies.
  double bias() const;

  /// Whether it is the coordinate of a slider on a beam, whose marker rows change.
  bool travels() const { return travel_.has_value(); }
  /// Sets its shares in a row. @param next the first of them, moved behind the last
  void derive(SystemRow& out, std::size_t& next) const;
  /// Adds the forces of a multiplier. @pre travels()
  void add_forces(double multiplier, Forces& out) const;
  /// What a multiplier does to both markers; on a beam, to the slider only.
  JointWrenches wrenches(double multiplier) const;

 private:
  const model::Model& model_;
  const model::CoupledCoordinate& coupled_;
  const model::Coordinate& coordinate_;
  const model::Joint& owner_;
  const std::vector<BodyMotion>& motions_;
  const joints::CountedValue* before_;
  std::optional<Travel> travel_;
  body::MarkerKinematics first_, second_;  // of a joint between two markers
  spatial::PairRow J_ = spatial::PairRow::Zero();
  joints::CountedValue value_;
  double slope_ = 0;  // of the term by the coordinate
  double rate_ = 0;   // of the coordinate
};

/// Gives the row of a coupler room for the shares of all coordinates.
void size_coupler_row(const model::Model& model, const model::Joint& coupler, SystemRow& out);

}  // namespace buckens::dynamics

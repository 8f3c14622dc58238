// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/fem/recovery.h"

namespace buckens::analysis {

/// How far a body's deformation is from what linear elasticity in one frame bears.
struct DeformationMeasure {
  double rotation = 0;    ///< largest rotation relative to the frame [rad]
  double strain = 0;      ///< largest mean strain of an element [-]
  double axial_load = 0;  ///< largest |N| over π²EI/L² of the straight member it acts in [-]

  void include(const DeformationMeasure& other);
};

/// Measures the deformation of one flexible body, at records.
///
/// Rotations are those of nodes that have them and of elements: the skew part of the displacement
/// gradient that fits an element's nodes best; its symmetric part is the strain, of shells that of
/// the middle surface. A member is a
/// chain of beams that meet at nodes without a kink; EI is its smaller bending stiffness.
class DeformationLimits {
 public:
  explicit DeformationLimits(const body::Body& body);

  /// Cost: one pass over the elements, one sparse product for section forces.
  DeformationMeasure measure(const linalg::Vector& d) const;

 private:
  void find_members();

  const fem::FeModel& fe_;
  fem::Recovery recovery_;
  std::vector<double> buckling_load_;  // per line element [N]; 0: a bar, which cannot bend
};

/// More rotation than this within one frame is not trusted [rad].
inline constexpr double kLargeRotation = 0.1;
std::string describe_rotation(const std::string& body, const DeformationMeasure& found);

/// Warnings where a measure leaves the range in which linear elasticity in one frame holds within
/// about 1 %: strain 5 %, axial load 5 % of the buckling load. Rotation has its own text.
std::vector<std::string> judge_deformation(const std::string& body,
                                           const DeformationMeasure& found);

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "buckens/analysis/simulation/largest_strain.h"
#include "buckens/body/body.h"
#include "buckens/fem/assembly/recovery.h"

namespace buckens::analysis {

/// Measures of a body's deformation that limit linear elasticity in one frame.
struct DeformationMeasure {
  double rotation = 0;     ///< largest rotation relative to the frame [rad]
  double strain = 0;       ///< largest strain anywhere, see LargestStrain [-]
  double tension = 0;      ///< largest N > 0 over π²EI/L² of its straight member [-]
  double compression = 0;  ///< the same for N < 0, as a positive number [-]

  double axial_load() const { return std::max(tension, compression); }
  void include(const DeformationMeasure& other);
};

/// Measures the deformation of one flexible body, at records.
///
/// Rotations are those of nodes that have them and of elements: the skew part of the displacement
/// gradient that best fits an element's nodes. A member is a chain of beams that meet at nodes
/// without a kink; EI is its smaller bending stiffness.
class DeformationLimits {
 public:
  explicit DeformationLimits(const body::Body& body);

  /// Cost: one pass over the elements, one sparse product for section forces.
  /// @param pool null: the calling thread alone. No bit depends on it
  DeformationMeasure measure(const linalg::Vector& d, TaskPool* pool = nullptr) const;

 private:
  void find_members();
  double largest_rotation(const linalg::Vector& d, TaskPool* pool) const;

  const fem::FeModel& fe_;
  fem::Recovery recovery_;
  LargestStrain strain_;
  std::vector<double> buckling_load_;  // per line element [N]; 0: a bar, which cannot bend
};

/// How one body of the model file is modelled, as far as its deformation limits need it.
struct DeformedBody {
  std::string name;
  std::string most_bent_part;  ///< the part (frame) that is bent most
  int frames = 1;
  bool is_stiffened = false;  ///< axial forces act on bending (`geometric-stiffness`)
};

/// Verdict on a deformation: sentences with a remedy.
struct DeformationVerdict {
  std::vector<std::string> warnings;  ///< an error of a few per cent
  std::vector<std::string> trust;     ///< more than about 5 %
};

/// Judges what linear elasticity in one frame neglects.
///
/// * Rotation within a frame above 0.1 rad: the error is its square, and the axial motion that
/// follows from it.
/// * Strain ε: stresses err by about ε/2 of themselves. Warned above 5 %, doubted above 10 %.
/// * Axial loads of x = |N|L²/(π²EI) that do not act on bending: deflections err by about x/(1 + x)
///   in tension and x/(1 − x) in compression, doubted above 5 % where the body bends at all.
DeformationVerdict judge_deformation(const DeformedBody& body, const DeformationMeasure& found);

}  // namespace buckens::analysis

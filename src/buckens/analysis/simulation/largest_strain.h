// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/shell/node_stress.h"
#include "buckens/fem/solid/strains.h"

namespace buckens::analysis {

/// The largest strain anywhere in a mesh, from the strains recovered for its fields.
///
/// For solids the largest principal strain at nodes of the surface and where
/// materials meet, for shells that of both sides at nodes, for beams and bars the
/// axial strain of the most strained fibre at their ends. Theory:
/// docs/theory/18-stresses.md.
class LargestStrain {
 public:
  explicit LargestStrain(const fem::FeModel& fe);

  /// @param d nodal variables
  /// @param section_forces of all line elements, from fem::Recovery
  /// Cost: one pass over the elements at the surface, one sparse product for shells.
  double measure(const linalg::Vector& d, const linalg::Matrix& section_forces,
                 const fem::Recovery& recovery, TaskPool* pool = nullptr) const;

 private:
  std::vector<double> modulus_;  // E per line element [Pa]
  std::unique_ptr<fem::SolidStrains> solids_;
  std::unique_ptr<fem::ShellNodeStresses> shells_;
};

}  // namespace buckens::analysis

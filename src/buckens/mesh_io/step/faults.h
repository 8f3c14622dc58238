// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/mesh_io/gmsh/library.h"

namespace buckens::mesh_io {

/// What may be wrong with the surface of a part, as lines of mesh_in_trial(); empty: nothing.
class PartFaults {
 public:
  /// @param metre in units of the model
  PartFaults(const GmshLibrary& gmsh, double metre) : gmsh_(gmsh), metre_(metre) {}

  /// The middle of an entity, for messages.
  std::string place(const GmshEntity& entity) const;
  /// Why elements may have nothing that bounds them. Seams and edges of more than two faces can
  /// look like gaps: with solids this is a suspicion only.
  std::string gap() const;
  /// Walls without thickness and the like.
  std::string loose_faces() const;
  /// Where solids meet along an edge only.
  std::string hinges() const;

 private:
  const GmshLibrary& gmsh_;
  double metre_;
};

}  // namespace buckens::mesh_io

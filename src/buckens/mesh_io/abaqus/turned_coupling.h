// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/abaqus/names.h"

namespace buckens::mesh_io {

/// Couplings of some degrees of freedom along the axes of an *ORIENTATION.
class AbaqusTurnedCoupling {
 public:
  /// @param turns which nodes have rotations
  AbaqusTurnedCoupling(const AbaqusLines& lines, const AbaqusNames& names,
                       const std::vector<bool>& turns, fem::ImportedMesh& out);

  /// Each node is tied, along the axes of its place, to a node beside it that follows the reference
  /// as a rigid body.
  /// @param link its variables count from the axes @param scope the placed scope where it stands
  /// @throws InputError for an orientation that is missing or of another kind
  void add(const AbaqusLink& link, int scope, int reference, const std::vector<int>& nodes);

 private:
  Eigen::Matrix3d axes_at(int node, const AbaqusOrientation& orientation,
                          const AbaqusPlaced& placed, DeckPlace place) const;
  const AbaqusOrientation& orientation(const AbaqusLink& link, int scope) const;
  int add_follower(int node);

  const AbaqusLines& lines_;
  const AbaqusNames& names_;
  const std::vector<bool>& turns_;
  fem::ImportedMesh& out_;
  std::int64_t next_label_ = 0;
};

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/body/body_spec.h"
#include "buckens/fem/assembly/body_matrices.h"
#include "buckens/fem/structure.h"
#include "buckens/model/interface_region.h"
#include "buckens/spatial/plane.h"

namespace buckens::model {

/// A position on a mesh: a node, or a point inside a line element.
struct MeshPlace {
  int node = -1;
  int element = -1;
  double xi = 0;
};

/// The mesh of a flexible body with the positions that a model file can name.
struct NamedStructure {
  fem::Structure structure;
  std::vector<fem::BeamDivision> beams;  ///< one per beam of the file
  std::vector<std::string> names;        ///< of places: start, mid, end, nodes
  std::vector<MeshPlace> places;
  std::unordered_map<std::int64_t, int> numbers;  ///< nodes by their number in a mesh file
  std::vector<InterfaceRegion> interfaces;
  /// Of a body without elements; its nodes are those of `structure`.
  std::shared_ptr<const fem::BodyMatrices> matrices;
  fem::RayleighFactors rayleigh;   ///< damping of such a body
  std::vector<std::string> notes;  ///< on what of a mesh file was taken otherwise than written

  /// A named position; nodes of mesh files are named `n` and their number.
  std::optional<MeshPlace> find(const std::string& name) const;
  /// Null if there is none with this name.
  const InterfaceRegion* find_interface(const std::string& name) const;
};

/// Creates nodes and elements from a `beam`, `structure`, `mesh` or `matrices` of the model file.
/// @throws InputError or ModelError with the location in the file
NamedStructure structure_from_spec(const body::BodySpec& spec);

/// The constant matrices of a mesh, or those given in place of it.
fem::FeModel assemble(const NamedStructure& mesh, std::optional<spatial::Plane> planar);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/structure.h"

namespace buckens::fem {

/// A location of the whole mesh within one of its parts.
struct PartPlace {
  int part = -1;
  int index = -1;  ///< of the node or element within the part
};

/// A mesh divided into connected parts that share only copies of nodes.
struct StructureParts {
  std::vector<Structure> parts;
  /// For each node of the whole mesh its copies, at least one, by ascending part.
  std::vector<std::vector<PartPlace>> nodes;
  /// For each line element of the whole mesh (beams, then bars) its index in its part.
  std::vector<PartPlace> lines;
  std::vector<PartPlace> solids;  ///< the same for its solids, then its shells
};

/// Number of elements that connect nodes: beams, bars, solids and shells.
int num_holding_elements(const Structure& structure);

/// Chooses the part of each beam, bar, solid and shell, in this order. Consecutive line elements
/// are divided by length; any other mesh by linalg::divide_graph.
/// @param count number of parts, 1 … number of these elements
/// @throws ModelError if count is out of range or the mesh is in pieces
std::vector<int> choose_parts(const Structure& structure, int count);

/// Divides a mesh. Point masses go to the first part that has their node.
/// @param part_of part of each beam, bar, solid and shell, numbers from 0 without gaps
StructureParts divide(const Structure& structure, const std::vector<int>& part_of);

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/constraint/node_links.h"
#include "buckens/fem/element/dof_map.h"
#include "buckens/fem/line/bar_block.h"
#include "buckens/fem/line/beam_block.h"
#include "buckens/fem/point/point_mass_block.h"
#include "buckens/fem/point/spring_block.h"
#include "buckens/fem/shell/block.h"
#include "buckens/fem/solid/block.h"
#include "buckens/fem/solid/face_set.h"

namespace buckens::fem {

/// Named nodes.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;  ///< ascending
};

/// Named elements, numbered within their kind.
struct ElementSet {
  std::string name;
  std::vector<int> beams, bars, solids, shells;
};

/// The mesh of one body before assembly: nodes and elements in model axes.
///
/// Elements are numbered consecutively over all kinds: beams, bars, point masses, solids, shells,
/// springs.
struct Structure {
  std::vector<Node> nodes;
  BeamBlock beams;
  BarBlock bars;
  PointMassBlock masses;
  SolidBlock solids;
  ShellBlock shells;
  SpringBlock springs;
  NodeLinks links;
  /// Nodes that only divide a bar. Bars stay collinear there although they are hinged.
  std::vector<int> straight_nodes;
  /// Faces, nodes and elements named by generators or mesh files. The parts of a divided mesh have
  /// none.
  std::vector<FaceSet> face_sets;
  std::vector<NodeSet> node_sets;
  std::vector<ElementSet> element_sets;
};

/// Elements and nodes created from one beam.
struct BeamDivision {
  int first_element = 0;  ///< among the beams; the elements are consecutive
  int num_elements = 0;
  std::vector<int> nodes;  ///< from the first end to the second, inclusive
};

/// @param name may be empty
/// @return index of the new node
/// @throws ModelError if another node has this name
int add_node(Structure& structure, const std::string& name, const Eigen::Vector3d& position);

/// Divides the line between two nodes into equal beam elements and creates the unnamed nodes
/// between them.
/// @throws ModelError if `divisions` < 1 or a node does not exist
BeamDivision add_beam(Structure& structure, int node_a, int node_b, int divisions,
                      const BeamProperties& properties);

/// Divides a bar between two nodes into equal elements; intermediate nodes become straight nodes.
/// @throws ModelError if `divisions` < 1 or a node does not exist
void add_bar(Structure& structure, int node_a, int node_b, int divisions, const Material& material,
             const Section& section);

/// All nodes of the faces of solids and shells in a set, ascending, each once.
std::vector<int> face_set_nodes(const Structure& structure, const FaceSet& set);

/// The faces with this name, or null.
const FaceSet* find_face_set(const Structure& structure, const std::string& name);

/// Index of the node with this name, or −1.
int find_node(const Structure& structure, const std::string& name);

}  // namespace buckens::fem

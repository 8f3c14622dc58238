// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/fem/shell/node_stress.h"
#include "buckens/fem/solid/strains.h"
#include "buckens/model/model.h"

namespace buckens::results {

/// The share of one body of the model in the fields of a whole body: its places are
/// consecutive.
struct PartFields {
  int body = 0;                                // index into Model::bodies
  Eigen::Index first_place = 0;                // among those of the whole
  std::vector<int> nodes;                      // of the part, one per place
  std::vector<Eigen::Index> element_rows;      // among all elements, one per element of the part
  std::unique_ptr<fem::SolidStrains> strains;  // null without stresses
  std::unique_ptr<fem::ShellNodeStresses> shells;  // null without shells or stresses
  std::vector<Eigen::Index> shell_columns;         // place of each of theirs
  int first_shell = 0;                             // of the part, after its solids
  // Reduced bodies: the effect of one unit of each variable. Empty if the mesh is evaluated.
  linalg::Matrix node_basis, element_basis, motion_basis, shell_basis;

  Eigen::Index num_places() const { return static_cast<Eigen::Index>(nodes.size()); }
  Eigen::Index num_elements() const { return static_cast<Eigen::Index>(element_rows.size()); }

  /// Multiplies the recovery of a reduced body with its basis, so that costs depend on modes and
  /// places only. @param has_motion whether translations() will be called
  void compose(const body::FlexiblePart& flexible, bool has_motion);
  /// Strains in the part's own axes.
  /// @param d variables of the body
  void evaluate(const body::FlexiblePart& flexible, const linalg::Vector& d,
                fem::TensorColumns& at_nodes, fem::TensorColumns& at_elements,
                TaskPool* pool = nullptr) const;
  /// Stresses on the surfaces of shells, at the places that shell_columns lists.
  fem::ShellNodeStresses::Surface evaluate_shells(const body::FlexiblePart& flexible,
                                                  const linalg::Vector& d) const;
  /// Place of a node of the part for one of its solids or shells, −1 if there is none.
  Eigen::Index place_of(int node, int element) const;
  /// 3×places: translations of the nodes by some values of the variables.
  Eigen::Matrix3Xd translations(const body::FlexiblePart& flexible, const linalg::Vector& d) const;
};

/// For each node of a body its node of the whole mesh, −1 if unknown.
std::vector<int> whole_nodes_of(const model::Model& model, const model::WholeBody& whole, int body);

}  // namespace buckens::results

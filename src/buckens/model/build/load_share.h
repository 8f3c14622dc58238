// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "buckens/fem/solid/face_set.h"
#include "buckens/model/build/mesh_division.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// The share of one body of the model in a load on a part of a mesh.
struct LoadShare {
  double extent = 0;  ///< area [m²], length [m], mass [kg] or volume [m³]
  /// ∫ x over the extent, model axes.
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();
  std::vector<linalg::Triplet> rows;  ///< ∫ u over the extent as rows over d: (0…2, DOF, value)

  // Of faces only, n outwards:
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();  ///< ∫ n dA [m²]
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();  ///< ∫ x × n dA, about the model origin [m³]
  std::vector<linalg::Triplet> normal_row;            ///< ∫ n·u dA: (0, DOF, value)

  std::vector<LoadFoot> feet;

  Eigen::Vector3d middle() const { return first_moment / extent; }
};

/// Collects the shares of the bodies into which a mesh is divided.
class LoadShares {
 public:
  /// @param division null for a mesh in one part
  LoadShares(const Model& model, const WholeBody& whole, const NamedStructure& mesh,
             const MeshDivision* division)
      : model_(model), whole_(whole), mesh_(mesh), division_(division) {}

  void add_face(const fem::ElementFace& face);
  void add_side(const fem::ShellSide& side);
  /// @param density extent per volume: 1, or that of the element's mass
  void add_solid(int element, double density);
  /// @param per_mass true if the extent is mass, else volume
  void add_shell(int element, bool per_mass);
  /// @param density extent per length
  void add_line(int line, const fem::Quartic& density);

  /// By index into Model::bodies.
  const std::map<int, LoadShare>& shares() const { return shares_; }

 private:
  void add_integrals(const fem::FaceIntegrals& own, int part);
  const fem::FeModel& mesh_of(int body) const;
  fem::PartPlace place_of(const std::vector<fem::PartPlace> MeshDivision::*list, int element) const;
  int node_in(int part, int node) const;
  void add_node(int body, int own_node, double share, LoadShare& to) const;

  const Model& model_;
  const WholeBody& whole_;
  const NamedStructure& mesh_;
  const MeshDivision* division_;
  std::map<int, LoadShare> shares_;
};

}  // namespace buckens::model

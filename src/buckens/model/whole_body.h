// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/base/source_location.h"
#include "buckens/body/marker.h"
#include "buckens/fem/fe_model.h"
#include "buckens/model/interface_region.h"

namespace buckens::model {

struct Model;
struct State;

/// Location of a node or element of a whole mesh among the bodies of the model.
struct MeshCopy {
  int body = -1;   ///< index into Model::bodies
  int index = -1;  ///< of the node, line or solid element in that body
};

/// A body of the model file: one body of the model, or the connected parts of its mesh with a frame
/// each, which are consecutive in Model::bodies and tied at shared nodes.
struct WholeBody {
  std::string name;
  SourceLocation where;  ///< in the model file
  int first = 0;         ///< index of its first body
  int count = 1;         ///< number of its bodies
  double mass = 0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< undeformed, model axes [m]

  /// The undivided mesh with its own matrices, empty unless the body is divided.
  std::shared_ptr<const fem::FeModel> mesh;
  std::vector<MeshCopy> nodes;   ///< first copy of each node of `mesh`
  std::vector<MeshCopy> lines;   ///< place of each line element of `mesh`
  std::vector<MeshCopy> solids;  ///< place of each solid element of `mesh`

  std::vector<InterfaceRegion> interfaces;  ///< node numbers of the undivided mesh

  bool is_divided() const { return count > 1; }
};

/// Frame of a whole body: that of its only body, or the rigid motion that best fits its parts.
///
/// The origin is the mass centre. The axes are those in which Σ∫|R s₀ − s|²dm over the rigidly
/// moving parts is least; the velocities carry its linear and angular momentum.
body::FrameMotion whole_motion(const Model& model, const WholeBody& whole, const State& state);

}  // namespace buckens::model

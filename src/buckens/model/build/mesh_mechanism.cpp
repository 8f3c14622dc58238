// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/mesh_mechanism.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/free_modes.h"
#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/recovery.h"

namespace buckens::model {

namespace {
// Share of the stiffness scale |K|/|M| below which a vibration has none: rounding stays near 1e-16,
// the slackest sensible truss above 1e-9.
constexpr double kNoStiffness = 1e-12;

/// Whether a mesh can have motions without strain: not beams and shells, which share rotations, nor
/// solids that join by faces; but bars, springs, links, and what turns at nodes of solids.
bool may_be_mechanism(const body::FlexiblePart& part) {
  const fem::FeModel& mesh = part.mesh();
  bool solids = false, turning = false, loose = part.full_mesh != nullptr;
  for (const auto& block : mesh.blocks) {
    if (block->num_elements() == 0 || !block->holds_nodes()) continue;
    if (block->is_solid()) {
      solids = true;
    } else if (block->has_rotations()) {
      turning = true;
    } else {
      loose = true;
    }
  }
  return loose || (solids && turning) || !fem::solids_join_by_faces(mesh);
}
}  // namespace

void refuse_mechanisms(const body::Body& body) {
  const fem::FeModel& fe = body.flexible->fe;
  const bool is_matrices = body.flexible->mesh().blocks.empty();
  if (!is_matrices && !may_be_mechanism(*body.flexible)) return;
  const body::FreeModes modes = body::free_modes(fe.M, fe.K, body.flexible->sieve.Phi(), 1);
  if (modes.omega.size() == 0) return;
  const double scale = fe.K.diagonal().maxCoeff() / fe.M.diagonal().maxCoeff();
  if (modes.omega[0] * modes.omega[0] > kNoStiffness * scale) return;
  Eigen::Index dof = 0;
  modes.shapes.col(0).cwiseAbs().maxCoeff(&dof);
  std::string node = "a node";
  for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
    const auto& dofs = fe.dofs.node_dofs[k];
    if (std::find(dofs.begin(), dofs.end(), static_cast<int>(dof)) == dofs.end()) continue;
    node = fe.nodes[k].name.empty() ? fmt::format("node {}", k)
                                    : fmt::format("node \"{}\"", fe.nodes[k].name);
  }
  if (is_matrices) {
    throw ModelError(
        fmt::format("body \"{}\": its stiffness matrix leaves more than the rigid-body motions "
                    "free: {} can move without strain, or the matrix is not positive semidefinite; "
                    "export the matrices of one connected body",
                    body.name, node));
  }
  const char* remedy =
      fem::solids_join_by_faces(body.flexible->mesh())
          ? "add bars, beams or solids that hold it"
          : "solids that share an edge or a corner only turn about it, so let them share a face or "
            "overlap";
  throw ModelError(
      fmt::format("body \"{}\" is a mechanism in itself: {} can move without straining an element; "
                  "{}, or make separate bodies with joints",
                  body.name, node, remedy));
}

}  // namespace buckens::model

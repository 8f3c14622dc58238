// SPDX-License-Identifier: Apache-2.0
// Which mechanisms StrandMechanism can lay out.
#include <algorithm>
#include <array>

#include "buckens/stepping/strand/loads.h"
#include "buckens/stepping/strand/mechanism.h"

namespace buckens::stepping {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

// With fewer bodies most lanes would be idle.
constexpr std::size_t kLeastBodies = strand::kLanes;

bool is_in_plane(const model::Model& model) {
  return model.planar.has_value() && spatial::normal(*model.planar) == Vector3d::UnitZ();
}

/// Frame coordinates: all of space, or all of the plane xy.
bool has_all_coordinates(const body::Body& body, bool is_planar) {
  if (!body.stand_in.isZero(0.0)) return false;
  if (!is_planar) return body.rotation_basis.cols() == 3 && body.translation_basis.cols() == 3;
  return body.rotation_basis.cols() == 1 && body.translation_basis.cols() == 2 &&
         body.rotation_basis.topRows<2>().isZero(0.0) &&
         body.translation_basis.bottomRows<1>().isZero(0.0);
}

/// Whether the variables of a part are those of two nodes, each with what the tables hold.
bool has_two_nodes(const body::FlexiblePart& part, bool is_planar) {
  const Index expected = is_planar ? 6 : 12;
  if (part.num_dofs() != expected || part.full_mesh != nullptr || !part.recovery.is_identity() ||
      part.fe.dofs.node_dofs.size() != 2) {
    return false;
  }
  for (const auto& dofs : part.fe.dofs.node_dofs) {
    for (std::size_t k = 0; k < 6; ++k) {
      const bool belongs = !is_planar || k < 2 || k == 5;
      if ((dofs[k] >= 0) != belongs) return false;
    }
  }
  return true;
}

/// Whether marker rows are the variables of a node, and the marker is there.
bool follows_node(const body::Body& body, const body::Marker& marker, std::size_t node) {
  const body::FlexiblePart& part = *body.flexible;
  const auto& dofs = part.fe.dofs.node_dofs[node];
  for (int k = 0; k < 6; ++k) {
    const int row = k < 3 ? marker.translation_row + k : marker.rotation_row + k - 3;
    const int dof = dofs[static_cast<std::size_t>(k)];
    int count = 0;
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    for (Rows::InnerIterator it(part.rows, row); it; ++it) {
      if (it.value() == 0.0) continue;
      if (it.col() != dof || it.value() != 1.0) return false;
      ++count;
    }
    if (count != (dof >= 0 ? 1 : 0)) return false;
  }
  return part.fe.nodes[node].position - body.com == marker.X_BF.p;
}

/// Whether what a planar table leaves out is zero.
bool is_flat(const body::FlexiblePart& part) {
  constexpr std::array<std::size_t, 3> across = {2, 4, 5};  // zz, xz, yz
  const linalg::Matrix patterns = part.invariants.centrifugal_patterns();
  return std::all_of(across.begin(), across.end(), [&](std::size_t k) {
    return part.fe.shape.W[k].norm() == 0.0 && patterns.col(static_cast<Index>(k)).isZero(0.0);
  });
}

bool is_part(const body::Body& body, const BodyStepOperator& op, bool is_planar) {
  const body::FlexiblePart& part = *body.flexible;
  return has_two_nodes(part, is_planar) && !part.is_quasi_static && part.geometric == nullptr &&
         part.fe.shape.nodal.empty() && !op.is_diagonal() && op.shared_factor() == nullptr &&
         (!is_planar || is_flat(part)) && part.sieve.rank() == (is_planar ? 3 : 6) &&
         part.coupling.terms.have_load() && part.coupling.terms.use_patterns() &&
         (!op.inertial().is_damped() || op.inertial().is_proportional());
}

/// Points that coincide, then perpendicular directions.
bool are_plain_rows(const std::vector<joints::ConstraintRow>& rows, bool is_planar) {
  using Kind = joints::ConstraintRow::Kind;
  const std::size_t points = is_planar ? 2 : 3;
  const std::size_t most = is_planar ? 3 : 6;
  if (rows.size() < points || rows.size() > most) return false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].depends_on_time() || rows[k].num_states() > 0 || rows[k].law() != nullptr) {
      return false;
    }
    if (k < points) {
      if (rows[k].kind() != Kind::point_world) return false;
      if (rows[k].direction() != Vector3d::Unit(static_cast<Index>(k))) return false;
    } else if (rows[k].kind() != Kind::direction) {
      return false;
    }
  }
  return true;
}

bool feels_only_plain_loads(const model::Model& model) {
  return std::all_of(model.loads.begin(), model.loads.end(), StrandLoads::suits) &&
         model.contact_groups.empty() && model.signals.empty() && model.drives.empty();
}

class JointCheck {
 public:
  JointCheck(const model::Model& model, bool is_planar)
      : model_(model), is_planar_(is_planar), markers_(model.bodies.size(), {-1, -1}) {}

  bool suits(const model::Joint& joint) {
    if (joint.track != nullptr || !joint.coupled.empty() || joint.first.body == joint.second.body ||
        !are_plain_rows(joint.rows, is_planar_)) {
      return false;
    }
    return suits(joint.first) && suits(joint.second) && (!is_planar_ || are_in_plane(joint));
  }

 private:
  bool suits(const model::MarkerId& id) {
    if (id.body == model::kGround) return true;
    const auto b = static_cast<std::size_t>(id.body);
    const body::Body& body = model_.bodies[b];
    const body::Marker& marker = body.markers[static_cast<std::size_t>(id.marker)];
    if (body.is_flexible()) return StrandMechanism::node_of(body, marker) >= 0;
    auto& known = markers_[b];
    if (known[0] == id.marker || known[1] == id.marker) return true;
    if (known[1] >= 0) return false;  // a third one
    known[known[0] < 0 ? 0 : 1] = id.marker;
    return true;
  }
  bool are_in_plane(const model::Joint& joint) const {
    const auto turn = [&](const model::MarkerId& id) -> Eigen::Matrix3d {
      if (id.body == model::kGround) return id.X_WF.R();
      return model_.bodies[static_cast<std::size_t>(id.body)]
          .markers[static_cast<std::size_t>(id.marker)]
          .X_BF.R();
    };
    for (std::size_t k = 2; k < joint.rows.size(); ++k) {
      if ((turn(joint.first) * joint.rows[k].direction()).z() != 0.0) return false;
      if ((turn(joint.second) * joint.rows[k].second_direction()).z() != 0.0) return false;
    }
    return true;
  }

  const model::Model& model_;
  bool is_planar_;
  std::vector<std::array<int, 2>> markers_;
};

/// Whether they are damped by the same coefficients.
bool are_damped_alike(const StrandMechanism::Operators& operators) {
  const BodyStepOperator* first = nullptr;
  for (const BodyStepOperator* const op : operators) {
    if (op == nullptr) continue;
    if (first == nullptr) first = op;
    if (op->inertial().share() != first->inertial().share() ||
        op->inertial().zeta() != first->inertial().zeta()) {
      return false;
    }
  }
  return true;
}

bool have_same_terms(const model::Model& model) {
  const body::CouplingTerms* first = nullptr;
  for (const body::Body& body : model.bodies) {
    if (!body.is_flexible()) continue;
    if (first == nullptr) first = &body.flexible->coupling.terms;
    if (body.flexible->coupling.terms != *first) return false;
  }
  return true;
}

}  // namespace

int StrandMechanism::node_of(const body::Body& body, const body::Marker& marker) {
  if (marker.translation_row < 0 || marker.rotation_row < 0) return -1;
  for (int node = 0; node < strand::kSlots; ++node) {
    if (follows_node(body, marker, static_cast<std::size_t>(node))) return node;
  }
  return -1;
}

bool StrandMechanism::suits(const model::Model& model, const Scheme& scheme,
                            const Operators& operators) {
  if (scheme.method != Method::generalized_alpha && scheme.method != Method::hht) return false;
  if (model.bodies.size() < kLeastBodies || model.joints.empty() ||
      !feels_only_plain_loads(model)) {
    return false;
  }
  const bool is_planar = is_in_plane(model);
  if (model.planar && !is_planar) return false;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    if (!has_all_coordinates(body, is_planar)) return false;
    if (body.is_flexible() && !is_part(body, *operators[b], is_planar)) return false;
  }
  JointCheck check(model, is_planar);
  return std::all_of(model.joints.begin(), model.joints.end(),
                     [&](const model::Joint& joint) { return check.suits(joint); }) &&
         are_damped_alike(operators) && have_same_terms(model);
}

}  // namespace buckens::stepping

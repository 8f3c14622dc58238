// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/nodal_motion.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::body {

using Eigen::Vector3d;

namespace {

// Principal moments below this share of the largest are taken as missing.
constexpr double kNoInertia = 1e-10;

Sieve make_sieve(const std::string& body, const fem::FeModel& fe) {
  std::vector<Vector3d> positions;
  positions.reserve(fe.nodes.size());
  for (const auto& node : fe.nodes) positions.push_back(node.position);
  const linalg::Matrix Phi = rigid_modes(positions, fe.dofs, fe.shape.com);
  check_stiffness_is_free(body, fe.K, Phi, fe);
  return Sieve(Phi, fe.M);
}

linalg::SymmetricMatrix damping_matrix(const fem::FeModel& fe) {
  linalg::MatrixSum sum;
  if (fe.mass_damping > 0.0) sum.add(fe.mass_damping, fe.M);
  if (fe.K_damping.nonZeros() > 0) sum.add(1.0, fe.K_damping);
  if (sum.size() == 0) return linalg::SparseMatrix(fe.M.rows(), fe.M.cols());
  if (sum.is_divided()) return sum.divided();
  return linalg::SymmetricMatrix::in_blocks(sum.whole());
}

}  // namespace

FlexiblePart::FlexiblePart(const std::string& body, fem::FeModel model, CouplingChoice choice)
    : fe(std::move(model)),
      sieve(make_sieve(body, fe)),
      invariants(fe.shape),
      C(damping_matrix(fe)),
      coupling(std::move(choice)) {
  if (num_dofs() < NodalMotion::kFewestVariables) return;
  nodal_motion = NodalMotion::of(*this);
  if (!nodal_motion) return;
  sieve.keep_by_node(nodal_motion);
  invariants.keep_by_node(nodal_motion);
  fe.shape.c = linalg::Matrix();
}

void FlexiblePart::stiffen() {
  geometric = std::make_unique<const fem::GeometricStiffness>(fe);
  coupling.terms.stiffening = true;
}

linalg::Vector FlexiblePart::coordinates(const linalg::Vector& nodal_values) const {
  if (recovery.is_identity()) return nodal_values;
  const linalg::Vector momenta = recovery.transposed(full_mesh->M * nodal_values);
  // The columns of a basis are M-orthonormal.
  return is_reduced() ? momenta : linalg::conjugate_gradients(fe.M, momenta);
}

int Body::find_marker(const std::string& marker) const {
  const auto found = std::find_if(markers.begin(), markers.end(),
                                  [&](const Marker& m) { return m.name == marker; });
  return found == markers.end() ? -1 : static_cast<int>(found - markers.begin());
}

Eigen::VectorXd Body::row_values(const linalg::Vector& d) const {
  if (!flexible) return {};
  return flexible->rows * d;
}

double Body::length_scale() const { return std::sqrt(0.5 * J0.trace() / mass); }

std::string missing_inertia_note(const Body& body, const Vector3d& axis) {
  return fmt::format(
      "body \"{}\" has no rotary inertia about ({:.3g}, {:.3g}, {:.3g}); its frame does not turn "
      "about this axis",
      body.name, axis.x(), axis.y(), axis.z());
}

void select_frame_coordinates(Body& body, const std::optional<Vector3d>& plane_normal) {
  body.rotation_basis.resize(3, 0);
  body.missing_rotations.resize(3, 0);
  const spatial::PrincipalAxes principal = spatial::principal_axes(body.J0);
  const double largest = principal.values[2];
  const auto add_rotation = [&](const Vector3d& axis, double moment) {
    const bool has_inertia = largest > 0.0 && moment > kNoInertia * largest;
    auto& basis = has_inertia ? body.rotation_basis : body.missing_rotations;
    basis.conservativeResize(3, basis.cols() + 1);
    basis.rightCols<1>() = axis;
  };
  if (plane_normal) {
    add_rotation(*plane_normal, plane_normal->dot(body.J0 * *plane_normal));
    body.translation_basis.resize(3, 2);
    const Vector3d first = plane_normal->unitOrthogonal();
    body.translation_basis << first, plane_normal->cross(first);
    return;
  }
  body.translation_basis = Eigen::Matrix3d::Identity();
  // Eigenvectors only where something is missing: otherwise the body axes stay readable.
  if (principal.values[0] > kNoInertia * largest && largest > 0.0) {
    body.rotation_basis = Eigen::Matrix3d::Identity();
    return;
  }
  for (int k = 0; k < 3; ++k) add_rotation(principal.vectors.col(k), principal.values[k]);
}

}  // namespace buckens::body

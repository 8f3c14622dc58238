// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cylinder_over_mesh.h"

#include <cmath>
#include <vector>

#include "buckens/loads/polyhedron_touch.h"
#include "buckens/spatial/place_finders.h"

namespace buckens::loads {

using Eigen::Vector3d;
using spatial::TouchSurface;

namespace {

/// Points that stay in the ends, as corners: the cylinder goes on from there along its side, along
/// the rim and inwards.
std::vector<Polyhedron::Corner> corners_of_ends(const TouchSurface& cylinder) {
  std::vector<Polyhedron::Corner> out;
  for (const auto& points : spatial::points_on_ends(cylinder)) {
    for (const Vector3d& at : points) {
      const double along = cylinder.axis.dot(at);
      const Vector3d radial = (at - along * cylinder.axis).normalized();
      const Vector3d inwards = along > 0.0 ? Vector3d(-cylinder.axis) : cylinder.axis;
      const Vector3d tangent = radial.cross(inwards);
      out.push_back({at, {inwards, -radial, tangent, -tangent}});
    }
  }
  return out;
}

}  // namespace

double greatest_length(const TouchSurface& cylinder) {
  return 2.0 * std::hypot(cylinder.radius, cylinder.half_length);
}

Eigen::AlignedBox3d box_around_disc(const Vector3d& middle, const Vector3d& axis, double radius) {
  const Vector3d reach = radius * (1.0 - axis.array().square()).max(0.0).sqrt();
  return {middle - reach, middle + reach};
}

TouchFinders cylinder_over_mesh(const std::shared_ptr<const Polyhedron>& mesh,
                                const TouchSurface& cylinder) {
  // In the order of boxes: of more places than are needed, which impulses find first may decide.
  TouchFinders out = rims_over_faces(mesh, cylinder);
  const auto add = [&out](const TouchFinders& more) {
    out.insert(out.end(), more.begin(), more.end());
  };
  for (const Polyhedron::Corner& corner : corners_of_ends(cylinder)) {
    add(corners_on_faces(mesh, {corner}, greatest_length(cylinder), true));
  }
  add(corners_at_cylinder(mesh, cylinder));
  add(edges_at_cylinder(mesh, cylinder));
  return out;
}

}  // namespace buckens::loads

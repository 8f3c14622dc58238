// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/turned_coupling.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

AbaqusTurnedCoupling::AbaqusTurnedCoupling(const AbaqusLines& lines, const AbaqusNames& names,
                                           const std::vector<bool>& turns, fem::ImportedMesh& out)
    : lines_(lines), names_(names), turns_(turns), out_(out) {
  for (const std::int64_t label : out.node_ids) next_label_ = std::max(next_label_, label + 1);
}

const AbaqusOrientation& AbaqusTurnedCoupling::orientation(const AbaqusLink& link,
                                                           int scope) const {
  for (const AbaqusScope* own :
       {names_.scopes()[static_cast<std::size_t>(scope)].scope, names_.scopes().front().scope}) {
    const auto found = own->orientations.find(upper(link.orientation));
    if (found == own->orientations.end()) continue;
    if (found->second.system == "RECTANGULAR" || found->second.is_cylindrical) {
      return found->second;
    }
    lines_.fail(link.place,
                fmt::format("orientation \"{}\" is of {}; expected RECTANGULAR or CYLINDRICAL "
                            "where a coupling leaves some degrees of freedom free",
                            link.orientation, found->second.system));
  }
  lines_.fail(link.place, fmt::format("there is no orientation \"{}\"", link.orientation));
}

/// Columns: directions 1, 2 and 3 at a node.
Matrix3d AbaqusTurnedCoupling::axes_at(int node, const AbaqusOrientation& orientation,
                                       const AbaqusPlaced& placed, DeckPlace place) const {
  if (!orientation.is_cylindrical) return placed.rotation * orientation.axes;
  const Vector3d axis = placed.rotation * (orientation.b - orientation.a).normalized();
  const Vector3d from = names_.positions()[static_cast<std::size_t>(node)] -
                        (placed.rotation * orientation.a + placed.origin);
  const Vector3d radial = from - from.dot(axis) * axis;
  if (!(radial.norm() > 1e-9 * from.norm())) {
    lines_.fail(place,
                fmt::format("node {} lies on the axis of orientation \"{}\", where the radial "
                            "direction is undefined",
                            names_.labels()[static_cast<std::size_t>(node)], orientation.name));
  }
  Matrix3d out;
  out.col(0) = radial.normalized();
  out.col(1) = axis.cross(out.col(0));
  out.col(2) = axis;
  return out;
}

int AbaqusTurnedCoupling::add_follower(int node) {
  const Vector3d place = out_.positions[static_cast<std::size_t>(node)];
  out_.positions.push_back(place);
  out_.node_ids.push_back(next_label_++);
  return out_.num_nodes() - 1;
}

void AbaqusTurnedCoupling::add(const AbaqusLink& link, int scope, int reference,
                               const std::vector<int>& nodes) {
  const AbaqusOrientation& own = orientation(link, scope);
  const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
  fem::ImportedRigidLink arms;
  arms.name = link.name;
  arms.reference = reference;
  arms.line = link.place.line;
  for (const int node : nodes) {
    const Matrix3d axes = axes_at(node, own, placed, link.place);
    const int follower = add_follower(node);
    arms.nodes.push_back(follower);
    for (int v = 0; v < 6; ++v) {
      if (!link.variables[static_cast<std::size_t>(v)]) continue;
      if (v > 2 && !turns_[static_cast<std::size_t>(node)]) continue;
      const Vector3d along = axes.col(v % 3);
      fem::ImportedEquation equation;
      equation.line = link.place.line;
      for (int k = 0; k < 3; ++k) {
        if (std::abs(along[k]) < 1e-14) continue;  // rounding of sines and cosines
        equation.terms.push_back({node, v - v % 3 + k, along[k]});
        equation.terms.push_back({follower, v - v % 3 + k, -along[k]});
      }
      // The term to eliminate comes first: the largest of the node that follows.
      const auto largest = std::max_element(
          equation.terms.begin(), equation.terms.end(), [node](const auto& a, const auto& b) {
            const auto size = [node](const auto& t) {
              return t.node == node ? std::abs(t.coefficient) : 0.0;
            };
            return size(a) < size(b);
          });
      std::iter_swap(equation.terms.begin(), largest);
      out_.equations.push_back(std::move(equation));
    }
  }
  out_.rigid_links.push_back(std::move(arms));
}

}  // namespace buckens::mesh_io

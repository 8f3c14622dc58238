// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/node_region.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "buckens/fem/shell/shares.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Squares of distances from a line, relative to the size: nodes within 1e-6 of it are on it.
constexpr double kOnLine = 1e-12;

Matrix3d cross_matrix(const Vector3d& r) {
  Matrix3d out;
  out << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return out;
}

/// Σ w (|r|² 1 − r rᵀ) of the places of the nodes.
Matrix3d spread_of(const std::vector<Node>& nodes, const NodeRegion& region) {
  Matrix3d out = Matrix3d::Zero();
  for (std::size_t k = 0; k < region.nodes.size(); ++k) {
    const Vector3d r = nodes[static_cast<std::size_t>(region.nodes[k])].position - region.centre;
    out += region.weights[static_cast<Eigen::Index>(k)] *
           (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  }
  return out;
}

/// Weights and what follows from them, from the area of each node.
void complete(const std::vector<Node>& nodes, const Eigen::VectorXd& areas, NodeRegion& region) {
  region.area = areas.sum();
  region.weights = region.area > 0.0 ? Eigen::VectorXd(areas / region.area)
                                     : Eigen::VectorXd::Constant(
                                           areas.size(), 1.0 / static_cast<double>(areas.size()));
  const auto place = [&](std::size_t k) -> const Vector3d& {
    return nodes[static_cast<std::size_t>(region.nodes[k])].position;
  };
  region.centre.setZero();
  for (std::size_t k = 0; k < region.nodes.size(); ++k) {
    region.centre += region.weights[static_cast<Eigen::Index>(k)] * place(k);
  }
  region.spread = spread_of(nodes, region);
}

/// Nodes on a line, such as the edge of a shell, define a rotation about it if they have rotations:
/// these count in the fit like displacements at a tenth of the region's radius.
void count_rotations(const Structure& structure, NodeRegion& region) {
  if (region.turns()) return;
  std::vector<bool> turns(structure.nodes.size(), false);
  const auto mark = [&turns](const ElementBlock& block) {
    for (int e = 0; e < block.num_elements(); ++e) {
      for (const int node : block.nodes(e)) turns[static_cast<std::size_t>(node)] = true;
    }
  };
  mark(structure.beams);
  mark(structure.shells);
  const bool all_turn = std::all_of(region.nodes.begin(), region.nodes.end(), [&](int node) {
    return turns[static_cast<std::size_t>(node)];
  });
  if (!all_turn || structure.shells.num_elements() == 0) return;
  const double radius = 0.5 * region.spread.trace();
  region.spread += (radius > 0.0 ? 0.01 * radius : 1.0) * Matrix3d::Identity();
}

/// Adds the shares of faces to the nodes they belong to.
Eigen::VectorXd areas_of(const Structure& structure, const std::vector<ElementFace>& faces,
                         const std::vector<int>& nodes) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes.size()));
  for (const ElementFace& face : faces) {
    const FaceIntegrals part = face_integrals(structure.solids, structure.nodes, face);
    for (std::size_t k = 0; k < part.nodes.size(); ++k) {
      const auto at = std::lower_bound(nodes.begin(), nodes.end(), part.nodes[k]);
      areas[at - nodes.begin()] += part.positive_area[static_cast<Eigen::Index>(k)];
    }
  }
  return areas;
}

/// Shares the area of a shell among its nodes, all of which are among the given ones.
void add_shell_area(const Structure& structure, int element, const std::vector<int>& nodes,
                    Eigen::VectorXd& areas) {
  const auto own = structure.shells.nodes(element);
  const auto add = [&](std::size_t k, double share) {
    areas[std::lower_bound(nodes.begin(), nodes.end(), own[k]) - nodes.begin()] += share;
  };
  const ShellVectors x = structure.shells.positions(structure.nodes, element);
  if (is_shell_quadratic(x.cols())) {
    const FaceIntegrals face =
        shell_side_integrals(structure.shells, structure.nodes, {element, false});
    for (std::size_t k = 0; k < own.size(); ++k) {
      add(k, face.positive_area[static_cast<Eigen::Index>(k)]);
    }
    return;
  }
  const bool is_triangle = x.cols() == 3;
  const Vector3d along = x.col(is_triangle ? 1 : 2) - x.col(0);
  const Vector3d across =
      is_triangle ? Vector3d(x.col(2) - x.col(0)) : Vector3d(x.col(3) - x.col(1));
  const double share = 0.5 * along.cross(across).norm() / static_cast<double>(x.cols());
  for (std::size_t k = 0; k < own.size(); ++k) add(k, share);
}

/// The shells all of whose nodes are among the given ones.
void add_shell_areas(const Structure& structure, const std::vector<int>& nodes,
                     Eigen::VectorXd& areas) {
  for (int e = 0; e < structure.shells.num_elements(); ++e) {
    const auto own = structure.shells.nodes(e);
    const bool is_within = std::all_of(own.begin(), own.end(), [&](int node) {
      return std::binary_search(nodes.begin(), nodes.end(), node);
    });
    if (is_within) add_shell_area(structure, e, nodes, areas);
  }
}

}  // namespace

std::vector<ElementFace> faces_within(const Structure& structure, const std::vector<int>& nodes) {
  std::vector<bool> is_within(structure.nodes.size(), false);
  for (const int node : nodes) is_within[static_cast<std::size_t>(node)] = true;
  std::map<std::vector<int>, std::pair<ElementFace, int>> found;
  for (int e = 0; e < structure.solids.num_elements(); ++e) {
    const auto& faces = solid_topology(structure.solids.form(e).kind).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const ElementFace face{e, static_cast<int>(f)};
      std::vector<int> own = face_nodes(structure.solids, face);
      if (!std::all_of(own.begin(), own.end(),
                       [&](int node) { return is_within[static_cast<std::size_t>(node)]; })) {
        continue;
      }
      std::sort(own.begin(), own.end());
      ++found.try_emplace(std::move(own), face, 0).first->second.second;
    }
  }
  std::vector<ElementFace> out;
  for (const auto& [own, face] : found) {
    if (face.second == 1) out.push_back(face.first);
  }
  return out;
}

bool NodeRegion::turns() const {
  const Vector3d moments = spatial::principal_values(spread);
  return moments[0] > kOnLine * moments[2];
}

NodeRegion face_region(const Structure& structure, const FaceSet& faces) {
  NodeRegion out;
  out.nodes = face_set_nodes(structure, faces);
  Eigen::VectorXd areas = areas_of(structure, faces.faces, out.nodes);
  for (const ShellSide& side : faces.shells)
    add_shell_area(structure, side.element, out.nodes, areas);
  complete(structure.nodes, areas, out);
  count_rotations(structure, out);
  return out;
}

NodeRegion node_region(const Structure& structure, std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  NodeRegion out;
  out.nodes = std::move(nodes);
  Eigen::VectorXd areas = areas_of(structure, faces_within(structure, out.nodes), out.nodes);
  add_shell_areas(structure, out.nodes, areas);
  complete(structure.nodes, areas, out);
  count_rotations(structure, out);
  return out;
}

NodeRegion weighted_region(const std::vector<Node>& all, const std::vector<int>& nodes,
                           const std::vector<double>& weights) {
  std::map<int, double> shares;
  for (std::size_t k = 0; k < nodes.size(); ++k) shares[nodes[k]] += weights.at(k);
  NodeRegion out;
  Eigen::VectorXd areas(static_cast<Eigen::Index>(shares.size()));
  for (const auto& [node, share] : shares) {
    areas[static_cast<Eigen::Index>(out.nodes.size())] = share;
    out.nodes.push_back(node);
  }
  complete(all, areas, out);
  out.area = 0.0;
  return out;
}

NodeRegion renumbered(const NodeRegion& region, const std::vector<int>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return nodes[a] < nodes[b]; });
  NodeRegion out = region;
  for (std::size_t k = 0; k < order.size(); ++k) {
    out.nodes[k] = nodes[order[k]];
    out.weights[static_cast<Eigen::Index>(k)] = region.weights[static_cast<Eigen::Index>(order[k])];
  }
  return out;
}

PointRows region_rows(const FeModel& fe, const NodeRegion& region, const Vector3d& at) {
  return region_rows(fe.nodes, fe.dofs, region, at);
}

PointRows region_rows(const std::vector<Node>& nodes, const DofMap& dofs, const NodeRegion& region,
                      const Vector3d& at) {
  PointRows out;
  out.position = at;
  out.has_rotation = region.turns();
  Matrix3d inverse = Matrix3d::Zero();
  if (out.has_rotation) inverse = region.spread.inverse();
  const Matrix3d offset = cross_matrix(at - region.centre);
  // The part of the spread beyond that of the positions comes from the rotations of the nodes.
  const double own = (region.spread - spread_of(nodes, region)).trace() / 3.0;
  const bool counts_rotations = own > kOnLine * region.spread.trace();
  for (std::size_t k = 0; k < region.nodes.size(); ++k) {
    const double weight = region.weights[static_cast<Eigen::Index>(k)];
    if (weight == 0.0) continue;
    const auto node = static_cast<std::size_t>(region.nodes[k]);
    const Vector3d r = nodes[node].position - region.centre;
    const Matrix3d turn = weight * inverse * cross_matrix(r);
    const Matrix3d move = weight * Matrix3d::Identity() - offset * turn;  // θ × s = −s × θ
    for (int row = 0; row < 3; ++row) {
      for (int axis = 0; axis < 3; ++axis) {
        const int dof = dofs.node_dofs[node][static_cast<std::size_t>(axis)];
        if (dof < 0) continue;
        if (move(row, axis) != 0.0) out.translation.emplace_back(row, dof, move(row, axis));
        if (turn(row, axis) != 0.0) out.rotation.emplace_back(row, dof, turn(row, axis));
      }
    }
    if (!counts_rotations) continue;
    const Matrix3d follow = weight * own * inverse;
    const Matrix3d lever = -offset * follow;
    for (int row = 0; row < 3; ++row) {
      for (int axis = 0; axis < 3; ++axis) {
        const int dof = dofs.node_dofs[node][static_cast<std::size_t>(3 + axis)];
        if (dof < 0) continue;
        if (follow(row, axis) != 0.0) out.rotation.emplace_back(row, dof, follow(row, axis));
        if (lever(row, axis) != 0.0) out.translation.emplace_back(row, dof, lever(row, axis));
      }
    }
  }
  return out;
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/dofs.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"
#include "buckens/fem/shell/element.h"
#include "buckens/fem/shell/moments.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Cosine of the angle up to which the shells at a node have one director: 25°.
constexpr double kSmooth = 0.9063;
// Cosine between normals of one element, below which it is folded.
constexpr double kFolded = 0.2;

/// The element's own normal at a node, its length the sine of the angle between the sides there.
Vector3d own_normal(const ShellVectors& x, Eigen::Index node) {
  const Eigen::Index n = x.cols();
  if (is_shell_quadratic(n)) {
    const auto [r, s] = shell_node_places(n)[static_cast<std::size_t>(node)];
    const Eigen::Matrix<double, 3, 2> tangents = x * shell_shape(n, r, s).slope.transpose();
    return tangents.col(0).normalized().cross(tangents.col(1).normalized());
  }
  const Vector3d next = (x.col((node + 1) % n) - x.col(node)).normalized();
  const Vector3d last = (x.col((node + n - 1) % n) - x.col(node)).normalized();
  return next.cross(last);
}

/// The angle of an element at a node; half a turn at nodes on its sides.
double own_angle(const ShellVectors& x, Eigen::Index node) {
  const Eigen::Index n = num_shell_corners(x.cols());
  if (node >= n) return std::numbers::pi;
  const Vector3d next = x.col((node + 1) % n) - x.col(node);
  const Vector3d last = x.col((node + n - 1) % n) - x.col(node);
  return std::atan2(next.cross(last).norm(), next.dot(last));
}

ShellVectors own_normals(const ShellVectors& x) {
  ShellVectors out(3, x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) out.col(k) = own_normal(x, k).normalized();
  if (!is_shell_quadratic(x.cols())) return out;
  // Nodes near the quarter points of their sides fold a corner over, or leave it without tangents.
  const double centre = is_shell_triangle(x.cols()) ? 1.0 / 3 : 0.0;
  const Eigen::Matrix<double, 3, 2> tangents =
      x * shell_shape(x.cols(), centre, centre).slope.transpose();
  const Vector3d normal = tangents.col(0).cross(tangents.col(1)).normalized();
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    if (!(out.col(k).dot(normal) > kFolded)) out.col(k) = normal;
  }
  return out;
}

/// The normals where an element is integrated, their lengths the sines between the natural
/// coordinates: of an element with nodes on its sides, these say whether it can be used.
Eigen::Matrix3Xd inner_normals(const ShellVectors& x) {
  const bool is_triangle = is_shell_triangle(x.cols());
  const auto rule = is_triangle ? triangle_rule_of_degree_4() : shell_rule(false, 3);
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(rule.size()));
  Eigen::Index column = 0;
  for (const ShellRulePoint& at : rule) {
    const Eigen::Matrix<double, 3, 2> tangents =
        x * shell_shape(x.cols(), at.r, at.s).slope.transpose();
    out.col(column++) = tangents.col(0).normalized().cross(tangents.col(1).normalized());
  }
  return out;
}

}  // namespace

int ShellBlock::add_section(const ShellSection& section) {
  sections_.push_back(section);
  // Impossible sections are named by check().
  const bool is_sound = !section.layers.empty() && section.thickness() > 0.0;
  stiffness_.push_back(is_sound ? shell_stiffness(section) : ShellStiffness{});
  return static_cast<int>(sections_.size()) - 1;
}

int ShellBlock::add(std::span<const int> nodes, int section) {
  if (nodes.size() != 3 && nodes.size() != 4 && nodes.size() != 6 && nodes.size() != 8) {
    throw ModelError(fmt::format(
        "shell element {} has {} nodes; it needs three or four, or six or eight with those on its "
        "sides",
        num_elements() + 1, nodes.size()));
  }
  if (section < 0 || section >= static_cast<int>(sections_.size())) {
    throw ModelError(fmt::format("shell: there is no section number {}", section));
  }
  Element element{{}, static_cast<int>(nodes.size()), section, num_elements() + 1};
  element.nodes.fill(-1);
  std::copy(nodes.begin(), nodes.end(), element.nodes.begin());
  elements_.push_back(element);
  return num_elements() - 1;
}

int ShellBlock::add(std::span<const int> nodes, int section, const ShellVectors& directors) {
  const int element = add(nodes, section);
  directors_.push_back(directors);
  return element;
}

ShellVectors ShellBlock::positions(const std::vector<Node>& all, int element) const {
  const std::span<const int> own = nodes(element);
  ShellVectors out(3, static_cast<Eigen::Index>(own.size()));
  Eigen::Index column = 0;
  for (const int node : own) out.col(column++) = all[static_cast<std::size_t>(node)].position;
  return out;
}

ShellVectors ShellBlock::directors(const std::vector<Node>& all, int element) const {
  const auto e = static_cast<std::size_t>(element);
  return e < directors_.size() ? directors_[e] : own_normals(positions(all, element));
}

void ShellBlock::choose_directors(const std::vector<Node>& nodes) {
  struct Corner {
    Vector3d normal;
    double angle;
  };
  std::vector<std::vector<Corner>> at_node(nodes.size());
  std::vector<ShellVectors> normals;
  for (int e = 0; e < num_elements(); ++e) {
    const ShellVectors x = positions(nodes, e);
    normals.push_back(own_normals(x));
    for (Eigen::Index k = 0; k < x.cols(); ++k) {
      const auto node = static_cast<std::size_t>(at(e).nodes[static_cast<std::size_t>(k)]);
      at_node[node].push_back({normals.back().col(k), own_angle(x, k)});
    }
  }
  for (auto e = static_cast<int>(directors_.size()); e < num_elements(); ++e) {
    ShellVectors own = normals[static_cast<std::size_t>(e)];
    for (Eigen::Index k = 0; k < own.cols(); ++k) {
      const Vector3d n = own.col(k);
      Vector3d sum = Vector3d::Zero();
      for (const Corner& corner :
           at_node[static_cast<std::size_t>(at(e).nodes[static_cast<std::size_t>(k)])]) {
        const double cosine = corner.normal.dot(n);  // negative if a neighbour is reversed
        if (std::abs(cosine) < kSmooth) continue;
        sum += std::copysign(corner.angle, cosine) * corner.normal;
      }
      if (sum.norm() > 0.0) own.col(k) = sum.normalized();
    }
    directors_.push_back(own);
  }
}

ShellBlock ShellBlock::subset(const std::vector<int>& elements,
                              const std::vector<int>& node_numbers) const {
  ShellBlock out;
  std::vector<int> number(sections_.size(), -1);
  for (const int e : elements) {
    const auto section = static_cast<std::size_t>(at(e).section);
    if (number[section] < 0) number[section] = out.add_section(sections_[section]);
    std::vector<int> own;
    for (const int node : nodes(e)) own.push_back(node_numbers.at(static_cast<std::size_t>(node)));
    out.set_number(out.add(own, number[section]), at(e).number);
    const auto index = static_cast<std::size_t>(e);
    if (index < directors_.size()) out.directors_.push_back(directors_[index]);
  }
  return out;
}

void ShellBlock::check(const MeshView& mesh) const {
  for (int e = 0; e < num_elements(); ++e) {
    const auto where = [&] {
      return fmt::format("shell element {} between {} and {}", at(e).number,
                         node_label(mesh.nodes, nodes(e)[0]), node_label(mesh.nodes, nodes(e)[2]));
    };
    check_shell_section(where(), shell_section(e));
    const ShellVectors x = positions(mesh.nodes, e);
    Eigen::Matrix3Xd normals;
    if (is_shell_quadratic(x.cols())) {
      normals = inner_normals(x);
    } else {
      normals.resize(3, x.cols());
      for (Eigen::Index k = 0; k < x.cols(); ++k) normals.col(k) = own_normal(x, k);
    }
    double least = 1.0, cosine = 1.0;
    Vector3d mean = Vector3d::Zero();
    for (const auto& normal : normals.colwise()) {
      const double sine = normal.norm();
      least = std::min(least, std::isfinite(sine) ? sine : 0.0);
      mean += normal.normalized();
    }
    for (const auto& normal : normals.colwise()) {
      cosine = std::min(cosine, normal.normalized().dot(mean.normalized()));
    }
    // Below a thousandth of a right angle the inverse of the Jacobian is rounding.
    const bool is_flat = !(least > 1e-3);
    if (is_flat || !(cosine > kFolded)) {
      throw ModelError(fmt::format(
          "{}: it is {}; list its nodes around it, and move one if two of them are at one place or "
          "three on one line",
          where(), is_flat ? "flat at a corner" : "folded or inverted"));
    }
    if (const auto& direction = shell_section(e).direction) {
      const double across = direction->normalized().cross(mean.normalized()).norm();
      if (across > 2e-3) continue;
      throw ModelError(fmt::format(
          "{}: the direction ({:g}, {:g}, {:g}) of its x axis is normal to it; give another one",
          where(), direction->x(), direction->y(), direction->z()));
    }
  }
}

void ShellBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    const ShellMoments moments(shell_element(*this, nodes, e), Vector3d::Zero());
    sum.mass += moments.mass;
    sum.first += moments.first;
  }
}

void ShellBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    if (stiffness(e).inertia[0] == 0.0) continue;
    const ShellElement element = shell_element(*this, mesh.nodes, e);
    const ShellMoments moments(element, com);
    const Eigen::Index n = element.nodes.cols();
    const std::vector<int> dofs = element_dofs<6>(mesh.dofs, nodes(e));
    scatter_square(moments.products[0], nodes(e), 1.0, sum.nodal);
    for (std::size_t k = 0; k < sum.W.size(); ++k) {
      scatter_square(moments.second_moment(element.directors, k), dofs, 1.0, sum.W[k]);
    }
    scatter_square(shell_drilling_inertia(element), dofs, 1.0, sum.M_flywheel);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (int b = 0; b < 3; ++b) {
        const Vector3d turned = element.directors.col(i).cross(Vector3d::Unit(b));
        for (int a = 0; a < 3; ++a) {
          const int move = dofs[static_cast<std::size_t>(6 * i + b)];
          if (move >= 0) sum.c(move, 3 * a + b) += moments.with_translation(a, i);
          for (int k = 0; k < 3; ++k) {
            const int turn = dofs[static_cast<std::size_t>(6 * i + 3 + k)];
            if (turn >= 0) sum.c(turn, 3 * a + b) += moments.with_rotation(a, i) * turned[k];
          }
        }
      }
    }
    sum.C0 += 0.5 * (moments.second + moments.second.transpose());
  }
}

void ShellBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    const ShellMatrix K = shell_stiffness_matrix(shell_element(*this, mesh.nodes, e));
    const std::vector<int> dofs = element_dofs<6>(mesh.dofs, nodes(e));
    scatter_square(K, dofs, 1.0, sum.K);
    const double beta = material(e)->damping_stiffness;
    if (beta != 0.0) scatter_square(K, dofs, beta, sum.K_damping);
  }
}

PointRows ShellBlock::point_rows(const MeshView& mesh, int element, double /*xi*/) const {
  throw ModelError(fmt::format("shell element {} at {}: only lines have a place along them",
                               element + 1, node_label(mesh.nodes, nodes(element)[0])));
}

void ShellBlock::add_stress_rows(const MeshView& mesh, int first_element,
                                 std::vector<linalg::Triplet>& rows) const {
  constexpr std::array<std::array<int, 2>, 6> places = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (int e = 0; e < num_elements(); ++e) {
    const ShellStrainRows strain = shell_centre_strain(shell_element(*this, mesh.nodes, e));
    const ShellSection& section = shell_section(e);
    const std::vector<int> dofs = element_dofs<6>(mesh.dofs, nodes(e));
    for (int side = 0; side < 2; ++side) {
      const double z = (side == 0 ? 0.5 : -0.5) * section.thickness();
      const ShellLayer& layer = side == 0 ? section.layers.back() : section.layers.front();
      const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6 * kMostShellNodes> stress =
          layer_elasticity(layer).in_plane *
          (strain.rows.topRows<3>() + z * strain.rows.middleRows<3>(3));
      for (Eigen::Index j = 0; j < stress.cols(); ++j) {
        const int column = dofs[static_cast<std::size_t>(j)];
        if (column < 0) continue;
        Matrix3d local = Matrix3d::Zero();
        local(0, 0) = stress(0, j);
        local(1, 1) = stress(1, j);
        local(0, 1) = local(1, 0) = stress(2, j);
        const Matrix3d turned = strain.axes * local * strain.axes.transpose();
        for (std::size_t i = 0; i < 6; ++i) {
          const double value = turned(places[i][0], places[i][1]);
          if (value == 0.0) continue;
          rows.emplace_back(6 * (2 * (first_element + e) + side) + static_cast<int>(i), column,
                            value);
        }
      }
    }
  }
}

std::vector<std::array<int, 4>> ShellBlock::faces(int element) const {
  const std::span<const int> own = nodes(element);
  const auto pieces = shell_pieces(static_cast<Eigen::Index>(own.size()));
  std::vector<std::array<int, 4>> out(pieces.begin(), pieces.end());
  for (auto& piece : out) {
    for (int& node : piece) {
      if (node >= 0) node = own[static_cast<std::size_t>(node)];
    }
  }
  return out;
}

}  // namespace buckens::fem

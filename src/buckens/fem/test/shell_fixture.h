// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "buckens/fem/shell/element.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {

/// The kind of shells of a grid.
enum class ShellKind { quad4, tri3, quad8, tri6 };

inline std::string shell_name(ShellKind kind) {
  constexpr std::array names = {"quad4", "tri3", "quad8", "tri6"};
  return names[static_cast<std::size_t>(kind)];
}
inline bool is_quad(ShellKind kind) { return kind == ShellKind::quad4 || kind == ShellKind::quad8; }
inline bool is_quadratic(ShellKind kind) {
  return kind == ShellKind::quad8 || kind == ShellKind::tri6;
}

/// Where nodes on the sides of elements are: on the surface, or halfway between the corners.
enum class Sides { curved, straight };

/// A surface divided regularly: node (i, j) at place(i/nx, j/ny), followed by nodes on sides.
struct ShellGrid {
  Structure structure;
  int nx = 0, ny = 0;

  template <class Place>
  ShellGrid(ShellKind kind, int nx_, int ny_, const ShellSection& section, Place&& place,
            Sides sides = Sides::curved)
      : nx(nx_), ny(ny_) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        structure.nodes.push_back({"", place(double(i) / nx, double(j) / ny)});
      }
    }
    const int number = structure.shells.add_section(section);
    const auto middle = [&](int a, int b) {
      const auto [known, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(structure.nodes.size()));
      if (!is_new) return known->second;
      const auto at = [&](int k) { return structure.nodes[static_cast<std::size_t>(k)].position; };
      const double x = 0.5 * (a % (nx + 1) + b % (nx + 1)) / nx;
      const double y = 0.5 * (a / (nx + 1) + b / (nx + 1)) / ny;
      structure.nodes.push_back({"", sides == Sides::curved
                                         ? Eigen::Vector3d(place(x, y))
                                         : Eigen::Vector3d(0.5 * (at(a) + at(b)))});
      return known->second;
    };
    const auto add = [&](std::vector<int> nodes) {
      const std::size_t count = is_quadratic(kind) ? nodes.size() : 0;
      for (std::size_t k = 0; k < count; ++k) {
        nodes.push_back(middle(nodes[k], nodes[(k + 1) % count]));
      }
      structure.shells.add(nodes, number);
    };
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const std::vector<int> c = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
        if (is_quad(kind)) {
          add(c);
        } else if ((i + j) % 2 == 0) {
          add({c[0], c[1], c[2]});
          add({c[0], c[2], c[3]});
        } else {
          add({c[0], c[1], c[3]});
          add({c[1], c[2], c[3]});
        }
      }
    }
  }
  int node(int i, int j) const { return j * (nx + 1) + i; }
  /// The corners (i0, j0) … (i1, j1) on a grid line, and the nodes between them.
  std::vector<int> line(int i0, int j0, int i1, int j1) const {
    std::vector<int> out = {node(i0, j0)};
    const int count = std::max(i1 - i0, j1 - j0), di = i1 > i0 ? 1 : 0, dj = j1 > j0 ? 1 : 0;
    for (int k = 1; k <= count; ++k) {
      const int last = node(i0 + (k - 1) * di, j0 + (k - 1) * dj),
                next = node(i0 + k * di, j0 + k * dj);
      out.push_back(next);
      if (const auto at = middles.find({last, next}); at != middles.end())
        out.push_back(at->second);
    }
    return out;
  }

  std::map<std::pair<int, int>, int> middles;  // by their corners, lower number first
};

/// DOF held at zero, marked by node and variable.
struct Held {
  const FeModel& fe;
  std::vector<bool> given;

  explicit Held(const FeModel& model)
      : fe(model), given(static_cast<std::size_t>(model.dofs.num_dofs), false) {}
  void hold(int node, std::initializer_list<int> variables) {
    for (const int k : variables) {
      const int dof =
          fe.dofs.node_dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(k)];
      if (dof >= 0) given[static_cast<std::size_t>(dof)] = true;
    }
  }
};

/// A curved and twisted grid of 36 x 30 quad4: several pieces of an assembly, 6882 variables.
inline Structure twisted_shells(const Material& material) {
  const ShellSection section = ShellSection::homogeneous(material, 0.002, 0.001);
  return ShellGrid(ShellKind::quad4, 36, 30, section,
                   [](double x, double y) {
                     return Eigen::Vector3d(0.6 * x, 0.4 * y, 0.1 * x * y + 0.05 * std::sin(9 * x));
                   })
      .structure;
}

/// Nodal forces of a load per area, model axes.
inline linalg::Vector area_load(const FeModel& fe, const ShellBlock& shells,
                                const Eigen::Vector3d& per_area) {
  linalg::Vector f = linalg::Vector::Zero(fe.dofs.num_dofs);
  for (int e = 0; e < shells.num_elements(); ++e) {
    const ShellElement element = shell_element(shells, fe.nodes, e);
    for (const ShellRulePoint& at : shell_mass_rule(element.nodes.cols())) {
      const ShellShape shape = shell_shape(element.nodes.cols(), at.r, at.s);
      const double area = at.weight * shell_area(element, shape);
      for (Eigen::Index i = 0; i < shape.N.size(); ++i) {
        const auto node = static_cast<std::size_t>(shells.nodes(e)[static_cast<std::size_t>(i)]);
        f.segment<3>(fe.dofs.node_dofs[node][0]) += area * shape.N[i] * per_area;
      }
    }
  }
  return f;
}

}  // namespace buckens::fem::test

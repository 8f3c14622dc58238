// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "buckens/fem/shell/element.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {

/// Which shells a grid consists of.
enum class ShellKind { quad4, tri3 };

inline std::string shell_name(ShellKind kind) {
  return kind == ShellKind::quad4 ? "quad4" : "tri3";
}

/// A surface divided regularly: node (i, j) at place(i/nx, j/ny).
struct ShellGrid {
  Structure structure;
  int nx = 0, ny = 0;

  template <class Place>
  ShellGrid(ShellKind kind, int nx_, int ny_, const ShellSection& section, Place&& place)
      : nx(nx_), ny(ny_) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        structure.nodes.push_back({"", place(double(i) / nx, double(j) / ny)});
      }
    }
    const int number = structure.shells.add_section(section);
    const auto add = [&](const std::vector<int>& nodes) { structure.shells.add(nodes, number); };
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const std::vector<int> c = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
        if (kind == ShellKind::quad4) {
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

/// Nodal forces of a load per area, model axes.
inline linalg::Vector area_load(const FeModel& fe, const ShellBlock& shells,
                                const Eigen::Vector3d& per_area) {
  linalg::Vector f = linalg::Vector::Zero(fe.dofs.num_dofs);
  for (int e = 0; e < shells.num_elements(); ++e) {
    const ShellElement element = shell_element(shells, fe.nodes, e);
    for (const ShellRulePoint& at : shell_rule(element.is_triangle(), 2)) {
      const ShellShape shape = shell_shape(element.is_triangle(), at.r, at.s);
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

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/midside_nodes.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

/// Cosine above which two shells at an edge are one smooth surface: 8 degrees.
constexpr double kSmooth = 0.99;

/// Share of an edge by which rounded coordinates may be off its middle.
constexpr double kInTheMiddle = 1e-5;

}  // namespace

std::span<const NastranEdge> nastran_edges(NastranElementKind kind) {
  static constexpr std::array<NastranEdge, 6> kTetra = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  static constexpr std::array<NastranEdge, 8> kPyramid = {
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
  static constexpr std::array<NastranEdge, 9> kPenta = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}}};
  static constexpr std::array<NastranEdge, 12> kHexa = {{{0, 1},
                                                         {1, 2},
                                                         {2, 3},
                                                         {3, 0},
                                                         {0, 4},
                                                         {1, 5},
                                                         {2, 6},
                                                         {3, 7},
                                                         {4, 5},
                                                         {5, 6},
                                                         {6, 7},
                                                         {7, 4}}};
  switch (kind) {
    case NastranElementKind::tetra:
      return kTetra;
    case NastranElementKind::pyramid:
      return kPyramid;
    case NastranElementKind::penta:
      return kPenta;
    case NastranElementKind::hexa:
      return kHexa;
    case NastranElementKind::tria6:
      return std::span(kTetra).first(3);
    case NastranElementKind::quad8:
      return std::span(kHexa).first(4);
    default:
      return {};
  }
}

int NastranMidsides::node(int a, int b, const Vector3d& normal, int line) {
  std::vector<Middle>& known = middles_[std::minmax(a, b)];
  const auto found = std::find_if(known.begin(), known.end(), [&](const Middle& middle) {
    if (normal.isZero(0.0) || middle.normal.isZero(0.0)) return normal == middle.normal;
    return std::abs(normal.dot(middle.normal)) > kSmooth;
  });
  if (found != known.end()) return found->node;
  const auto& x = coordinates_.positions();
  const Vector3d middle = 0.5 * (x[static_cast<std::size_t>(a)] + x[static_cast<std::size_t>(b)]);
  const int node = coordinates_.add_node(middle);
  known.push_back({normal, node});
  tie(node, a, b, normal, line);
  return node;
}

bool NastranMidsides::straighten(int node, int a, int b, int line) {
  const auto place = [&](int n) { return coordinates_.positions()[static_cast<std::size_t>(n)]; };
  const Vector3d off = place(node) - 0.5 * (place(a) + place(b));
  if (off.norm() > kInTheMiddle * (place(b) - place(a)).norm()) return false;
  if (straightened_.insert(node).second) tie(node, a, b, Vector3d::Zero(), line);
  return true;
}

void NastranMidsides::tie(int node, int a, int b, const Vector3d& normal, int line) {
  const auto& x = coordinates_.positions();
  const Vector3d across =
      (x[static_cast<std::size_t>(b)] - x[static_cast<std::size_t>(a)]).cross(normal);
  const bool is_shell = !normal.isZero(0.0);
  for (int variable = 0; variable < (is_shell ? 6 : 3); ++variable) {
    fem::ImportedEquation equation;
    equation.line = line;
    equation.terms = {{node, variable, 1.0}, {a, variable, -0.5}, {b, variable, -0.5}};
    for (int k = 0; variable < 3 && is_shell && k < 3; ++k) {
      const double factor = 0.125 * normal[variable] * across[k];
      if (factor == 0.0) continue;
      equation.terms.push_back({a, 3 + k, -factor});
      equation.terms.push_back({b, 3 + k, factor});
    }
    mesh_.equations.push_back(std::move(equation));
  }
}

}  // namespace buckens::mesh_io

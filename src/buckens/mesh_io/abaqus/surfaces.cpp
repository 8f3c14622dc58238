// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/mesh_io/abaqus/names.h"

namespace buckens::mesh_io {

namespace {

int num_corners(fem::CellKind kind) {
  return kind == fem::CellKind::tri3 || kind == fem::CellKind::tri6 ? 3 : 4;
}

/// Adds the mid-side nodes of the edges of a face, the first between its corners 1 and 2.
void add_mid_sides(fem::CellKind kind, const std::vector<int>& nodes,
                   const std::vector<int>& corners, std::vector<int>& out) {
  const auto edges = abaqus_edges(kind);
  const std::size_t first = nodes.size() - edges.size();
  // Two corners are an edge of a shell, which has one side only.
  const std::size_t sides = corners.size() == 2 ? 1 : corners.size();
  for (std::size_t k = 0; k < sides; ++k) {
    const int a = corners[k], b = corners[(k + 1) % corners.size()];
    const auto edge = std::find_if(edges.begin(), edges.end(), [&](const auto& e) {
      return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
    });
    if (edge == edges.end()) continue;
    out.push_back(nodes[first + static_cast<std::size_t>(edge - edges.begin())]);
  }
}

/// Shares a face among its nodes: corners take the triangles that they form with their neighbours;
/// of quadratic shapes, cut into pieces at the nodes on their edges, the corners get less.
void add_shares(const AbaqusFace& face, const std::vector<Eigen::Vector3d>& positions,
                std::map<int, double>& out) {
  const auto place = [&](int node) { return positions[static_cast<std::size_t>(node)]; };
  const std::vector<int>& c = face.corners;
  const std::size_t count = c.size();
  const std::size_t num_mid = face.nodes.size() - count;
  if (count == 2) {
    const double length = (place(c[1]) - place(c[0])).norm();
    const double corner = num_mid == 0 ? 0.5 : 0.25;
    for (std::size_t k = 0; k < face.nodes.size(); ++k)
      out[face.nodes[k]] += length * (k < 2 ? corner : 0.5);
    return;
  }
  std::vector<double> shares;
  double area = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d x = place(c[k]);
    const Eigen::Vector3d one = place(c[(k + 1) % count]) - x;
    const Eigen::Vector3d other = place(c[(k + count - 1) % count]) - x;
    shares.push_back(one.cross(other).norm() / (count == 3 ? 6.0 : 4.0));
    area += shares.back();
  }
  // Four triangles of a triangle; a square within and four triangles of a quadrilateral.
  const double of_corner = num_mid == 0 ? 1.0 : count == 3 ? 0.25 : 1.0 / 6.0;
  const double of_mid = num_mid == 0 ? 0.0 : (1.0 - of_corner) / static_cast<double>(num_mid);
  for (std::size_t k = 0; k < face.nodes.size(); ++k) {
    out[face.nodes[k]] += k < count ? of_corner * shares[k] : of_mid * area;
  }
}

}  // namespace

AbaqusFace AbaqusNames::solid_face(const AbaqusElementAt& at, std::size_t face) const {
  const auto [block, k] = scopes_[static_cast<std::size_t>(at.scope)].at(at.element);
  static_cast<void>(k);
  const std::vector<int> all = element_nodes(at);
  const std::vector<int>& corners = abaqus_faces(block->type->kind)[face];
  AbaqusFace out{at.scope, at.element, {}, {}, false};
  for (const int corner : corners) out.corners.push_back(all[static_cast<std::size_t>(corner)]);
  out.nodes = out.corners;
  add_mid_sides(block->type->kind, all, corners, out.nodes);
  return out;
}

AbaqusFace AbaqusNames::shell_face(const AbaqusElementAt& at, bool is_positive) const {
  const auto [block, k] = scopes_[static_cast<std::size_t>(at.scope)].at(at.element);
  static_cast<void>(k);
  AbaqusFace out{at.scope, at.element, {}, element_nodes(at), false};
  out.corners.assign(out.nodes.begin(), out.nodes.begin() + num_corners(block->type->kind));
  if (is_positive) return out;
  std::reverse(out.corners.begin(), out.corners.end());
  // The side between the last two corners is the second to last of the other direction.
  const auto mid = out.nodes.begin() + static_cast<std::ptrdiff_t>(out.corners.size());
  std::copy(out.corners.begin(), out.corners.end(), out.nodes.begin());
  if (mid != out.nodes.end()) std::reverse(mid, out.nodes.end() - 1);
  return out;
}

AbaqusFace AbaqusNames::shell_edge(const AbaqusElementAt& at, std::size_t edge) const {
  const auto [block, k] = scopes_[static_cast<std::size_t>(at.scope)].at(at.element);
  static_cast<void>(k);
  const std::vector<int> all = element_nodes(at);
  const int count = num_corners(block->type->kind);
  const std::vector<int> corners = {static_cast<int>(edge), (static_cast<int>(edge) + 1) % count};
  AbaqusFace out{at.scope, at.element, {}, {}, true};
  for (const int corner : corners) out.corners.push_back(all[static_cast<std::size_t>(corner)]);
  out.nodes = out.corners;
  add_mid_sides(block->type->kind, all, corners, out.nodes);
  return out;
}

bool AbaqusNames::is_free(const AbaqusElementAt& at, const AbaqusFace& face) {
  const auto key_of = [](const std::vector<int>& corners) {
    std::array<int, 4> key = {-1, -1, -1, -1};
    std::copy(corners.begin(), corners.end(), key.begin());
    std::sort(key.begin(), key.end());
    return key;
  };
  auto [entry, is_new] = faces_.try_emplace(at.scope);
  std::vector<std::array<int, 4>>& all = entry->second;
  if (is_new) {
    const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(at.scope)];
    for (int e = 0; e < placed.num_elements; ++e) {
      const AbaqusElementType& type = *placed.at(e).first->type;
      if (type.role != AbaqusRole::solid) continue;
      for (std::size_t f = 0; f < abaqus_faces(type.kind).size(); ++f) {
        all.push_back(key_of(solid_face({at.scope, e}, f).corners));
      }
    }
    std::sort(all.begin(), all.end());
  }
  const auto [first, last] = std::equal_range(all.begin(), all.end(), key_of(face.corners));
  return last - first == 1;
}

void AbaqusNames::add_faces(const AbaqusElementAt& at, const AbaqusSurface::Item& item,
                            std::vector<AbaqusFace>& out) {
  const auto [block, k] = scopes_[static_cast<std::size_t>(at.scope)].at(at.element);
  const AbaqusElementType& type = *block->type;
  const auto refuse = [&, id = block->ids[k]](const std::string& known) {
    lines_.fail(item.place, fmt::format("element {} of type {} has no face \"{}\"; {}", id,
                                        type.name, item.face.substr(0, 20), known));
  };
  const std::string& face = item.face;
  const auto number_behind = [&face](char letter) {
    const bool is_numbered = face.size() == 2 && face[0] == letter && face[1] >= '1';
    return is_numbered ? static_cast<std::size_t>(face[1] - '1') : std::size_t{99};
  };
  if (type.role == AbaqusRole::solid) {
    const std::size_t count = abaqus_faces(type.kind).size();
    if (face.empty()) {
      for (std::size_t f = 0; f < count; ++f) {
        AbaqusFace found = solid_face(at, f);
        if (is_free(at, found)) out.push_back(std::move(found));
      }
      return;
    }
    const std::size_t number = number_behind('S');
    if (number >= count) refuse(fmt::format("its faces are S1 to S{}", count));
    out.push_back(solid_face(at, number));
    return;
  }
  // Surfaces of contact with what has no stiffness, edges of plane elements.
  if (type.role != AbaqusRole::shell) return;
  if (face.empty() || face == "SPOS" || face == "POS" || face == "S2") {
    out.push_back(shell_face(at, true));
  } else if (face == "SNEG" || face == "NEG" || face == "S1") {
    out.push_back(shell_face(at, false));
  } else if (number_behind('E') < static_cast<std::size_t>(num_corners(type.kind))) {
    out.push_back(shell_edge(at, number_behind('E')));
  } else if (number_behind('S') < static_cast<std::size_t>(num_corners(type.kind)) + 2) {
    // CalculiX: faces 3, 4, … of the solid that it makes of a shell.
    out.push_back(shell_edge(at, number_behind('S') - 2));
  } else {
    refuse("the sides of a shell are SPOS and SNEG, its edges E1, E2, …");
  }
}

std::vector<AbaqusFace> AbaqusNames::faces(int scope, const AbaqusSurface& surface) {
  std::vector<AbaqusFace> out;
  for (const AbaqusSurface::Item& item : surface.items) {
    const Scoped scoped = in_instance(scope, item.reference, item.instance, item.place);
    for (const AbaqusElementAt& at : elements(scoped.scope, scoped.name, item.place)) {
      add_faces(at, item, out);
    }
  }
  return out;
}

std::vector<AbaqusFace> AbaqusNames::faces(int scope, const std::string& name, DeckPlace place) {
  const Scoped scoped = in_instance(scope, name, "", place);
  const AbaqusScope& own = *scopes_[static_cast<std::size_t>(scoped.scope)].scope;
  const auto found = own.surfaces.find(upper(scoped.name));
  if (found != own.surfaces.end()) return faces(scoped.scope, found->second);
  surface_nodes(scope, name, place);  // refuses what there is not
  return {};
}

std::map<int, double> AbaqusNames::surface_nodes(int scope, const std::string& name,
                                                 DeckPlace place) {
  const Scoped scoped = in_instance(scope, name, "", place);
  const AbaqusScope& own = *scopes_[static_cast<std::size_t>(scoped.scope)].scope;
  std::vector<std::string> known;
  for (const auto* all : {&own.surfaces, &own.node_surfaces}) {
    const auto found = all->find(upper(scoped.name));
    if (found != all->end()) return surface_nodes(scoped.scope, found->second);
    for (const auto& [key, surface] : *all) known.push_back(surface.name);
  }
  lines_.fail(place, fmt::format("there is no surface \"{}\".{}", scoped.name,
                                 base::suggestion(scoped.name, known)));
}

std::map<int, double> AbaqusNames::surface_nodes(int scope, const AbaqusSurface& surface) {
  std::map<int, double> out;
  if (!surface.is_of_nodes) {
    for (const AbaqusFace& face : faces(scope, surface)) add_shares(face, positions_, out);
    return out;
  }
  for (const AbaqusSurface::Item& item : surface.items) {
    const Scoped at = in_instance(scope, item.reference, item.instance, item.place);
    for (const int node : nodes(at.scope, at.name, item.place)) out[node] = item.area;
  }
  return out;
}

}  // namespace buckens::mesh_io

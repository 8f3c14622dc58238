// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/block.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/dofs.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/fem/element/scatter.h"
#include "buckens/fem/solid/element.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

const char* order_of_nodes(const SolidTopology& topology) {
  if (topology.is_tetrahedron()) {
    return "list three corners counter-clockwise seen from the fourth, then the fourth";
  }
  if (topology.is_hexahedron() || topology.is_wedge()) {
    return "list the nodes of the lower face counter-clockwise seen from above, then those of the "
           "upper face in the same order";
  }
  return "list the nodes of the base counter-clockwise seen from the apex, then the apex";
}

/// Elements of other programs use a node twice to make a wedge of a hexahedron.
template <class Where>
void refuse_collapsed(Where&& where, std::span<const int> nodes, const std::vector<Node>& all) {
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(k), nodes[k]) ==
        nodes.begin() + static_cast<std::ptrdiff_t>(k)) {
      continue;
    }
    throw ModelError(
        fmt::format("{}: {} appears in it twice; write it as an element with fewer corners "
                    "(wedge6, pyramid5, tet4)",
                    where(), node_label(all, nodes[k])));
  }
}

}  // namespace

int SolidBlock::add_material(const Material& material) {
  materials_.push_back(material);
  return static_cast<int>(materials_.size()) - 1;
}

int SolidBlock::add(const SolidForm& form, std::span<const int> nodes, int material) {
  const char* kind = choice_names(form.kind)[static_cast<std::size_t>(form.kind)];
  const auto count = static_cast<std::size_t>(solid_topology(form.kind).num_nodes);
  if (nodes.size() != count) {
    throw ModelError(fmt::format("solid element {} ({}) has {} nodes; it needs {}",
                                 num_elements() + 1, kind, nodes.size(), count));
  }
  if (form.integration != SolidIntegration::full && form.kind != SolidKind::hex8) {
    throw ModelError(
        fmt::format("solid element {} ({}): only hex8 has incompatible modes; integrate others in "
                    "full",
                    num_elements() + 1, kind));
  }
  elements_.push_back({form, nodes_.size(), material, num_elements() + 1});
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  return num_elements() - 1;
}

int SolidBlock::add(const std::array<int, 8>& nodes, int material) {
  return add({SolidKind::hex8, SolidIntegration::full}, nodes, material);
}

std::span<const int> SolidBlock::nodes(int element) const {
  const auto count = static_cast<std::size_t>(solid_topology(form(element).kind).num_nodes);
  return std::span(nodes_).subspan(at(element).first, count);
}

NodeVectors SolidBlock::positions(const std::vector<Node>& all, int element) const {
  const std::span<const int> own = nodes(element);
  NodeVectors out(3, static_cast<Eigen::Index>(own.size()));
  Eigen::Index column = 0;
  for (const int node : own) out.col(column++) = all[static_cast<std::size_t>(node)].position;
  return out;
}

SolidBlock SolidBlock::subset(const std::vector<int>& elements,
                              const std::vector<int>& node_numbers) const {
  SolidBlock out;
  std::vector<int> number(materials_.size(), -1);
  for (const int e : elements) {
    const auto material = static_cast<std::size_t>(at(e).material);
    if (number[material] < 0) number[material] = out.add_material(materials_[material]);
    std::vector<int> own;
    for (const int node : nodes(e)) own.push_back(node_numbers.at(static_cast<std::size_t>(node)));
    out.set_number(out.add(form(e), own, number[material]), at(e).number);
  }
  return out;
}

std::string SolidBlock::place(const std::vector<Node>& all, int element) const {
  const SolidTopology& topology = solid_topology(form(element).kind);
  const auto opposite =
      static_cast<std::size_t>(topology.is_hexahedron() ? 6 : topology.num_corners - 1);
  const SolidKind kind = form(element).kind;
  return fmt::format("solid element {} ({}) between {} and {}", at(element).number,
                     choice_names(kind)[static_cast<std::size_t>(kind)],
                     node_label(all, nodes(element)[0]), node_label(all, nodes(element)[opposite]));
}

std::vector<SolidBlock::Inverted> SolidBlock::checked(const std::vector<Node>& all, int begin,
                                                      int end) const {
  std::vector<Inverted> out;
  std::vector<bool> is_known(materials_.size(), false);
  for (int e = begin; e < end; ++e) {
    const NodeVectors x = positions(all, e);
    const double size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
    refuse_collapsed([&] { return place(all, e); }, nodes(e), all);
    const double least = solid_least_volume(form(e).kind, x);
    // Jacobians are eighths of volumes (hexahedra) up to six volumes; one part in 1e12 of the
    // bounding cube is flat.
    if (!(8.0 * least > 1e-12 * size * size * size)) out.push_back({e, least});
    const auto material = static_cast<std::size_t>(at(e).material);
    if (!is_known[material]) check_solid_material(place(all, e), materials_[material]);
    is_known[material] = true;
  }
  return out;
}

void SolidBlock::check(const MeshView& mesh) const {
  std::mutex turn;
  std::map<int, std::vector<Inverted>> by_range;
  // Of several ranges with a fault, the error of the first one is told.
  run_ranges(mesh.pool, num_elements(), [&](int begin, int end) {
    std::vector<Inverted> found = checked(mesh.nodes, begin, end);
    const std::lock_guard lock(turn);
    by_range[begin] = std::move(found);
  });
  std::vector<Inverted> inverted;
  for (const auto& [begin, found] : by_range) {
    inverted.insert(inverted.end(), found.begin(), found.end());
  }
  if (!inverted.empty()) refuse_inverted(mesh.nodes, inverted);
}

void SolidBlock::refuse_inverted(const std::vector<Node>& all,
                                 const std::vector<Inverted>& inverted) const {
  constexpr std::size_t kMostNamed = 10;
  std::vector<std::string> others;
  for (std::size_t k = 1; k < inverted.size() && k < kMostNamed; ++k) {
    others.push_back(fmt::to_string(at(inverted[k].element).number));
  }
  if (inverted.size() > kMostNamed) {
    others.push_back(fmt::format("{} more", inverted.size() - kMostNamed));
  }
  const auto& [first, volume] = inverted.front();
  throw ModelError(
      fmt::format("{}: its Jacobian falls to {:.3g} m³ where it is integrated, so it is inverted "
                  "or flat{}; {}, "
                  "or move a node",
                  place(all, first), volume,
                  others.empty() ? "" : fmt::format(", and so are {}", fmt::join(others, ", ")),
                  order_of_nodes(solid_topology(form(first).kind))));
}

void SolidBlock::add_mass(const std::vector<Node>& nodes, MassMoment& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    const NodeVectors x = positions(nodes, e);
    const NodeValues share =
        material(e)->rho * solid_volume_products(form(e).kind, x).rowwise().sum();
    sum.mass += share.sum();
    sum.first += x * share;
  }
}

void SolidBlock::add_inertia(const MeshView& mesh, const Vector3d& com, InertiaSum& sum) const {
  for (int e = 0; e < num_elements(); ++e) {
    if (material(e)->rho == 0.0) continue;
    const NodeVectors x = positions(mesh.nodes, e);
    const NodeProducts Ms = material(e)->rho * solid_volume_products(form(e).kind, x);
    scatter_square(Ms, nodes(e), 1.0, sum.nodal);
    const NodeVectors x0 = x.colwise() - com;
    const NodeVectors moment = x0 * Ms;  // Σ_J Ms_IJ x0_J
    const std::vector<int> dofs = element_dofs<3>(mesh.dofs, nodes(e));
    for (std::size_t k = 0; k < dofs.size(); ++k) {
      if (dofs[k] < 0) continue;
      const auto node = static_cast<Eigen::Index>(k / 3);
      const int b = static_cast<int>(k % 3);
      for (int a = 0; a < 3; ++a) sum.c(dofs[k], 3 * a + b) += moment(a, node);
    }
    const Eigen::Matrix3d second = moment * x0.transpose();
    sum.C0 += 0.5 * (second + second.transpose());
  }
}

void SolidBlock::add_stiffness(const MeshView& mesh, StiffnessSum& sum) const {
  std::vector<Elasticity> elasticity;
  for (const Material& m : materials_) elasticity.push_back(solid_elasticity(m));
  std::size_t entries = sum.K.size();
  for (int e = 0; e < num_elements(); ++e) entries += 9 * nodes(e).size() * nodes(e).size();
  sum.K.reserve(entries);
  for (int e = 0; e < num_elements(); ++e) {
    const Elasticity& D = elasticity[static_cast<std::size_t>(at(e).material)];
    const SolidStiffness K = solid_stiffness(form(e), positions(mesh.nodes, e), D);
    const std::vector<int> dofs = element_dofs<3>(mesh.dofs, nodes(e));
    scatter_square(K, dofs, 1.0, sum.K);
    const double beta = material(e)->damping_stiffness;
    if (beta != 0.0) scatter_square(K, dofs, beta, sum.K_damping);
  }
}

void SolidBlock::add_force_rows(const MeshView& /*mesh*/, int /*first_element*/,
                                std::vector<linalg::Triplet>& /*rows*/) const {}

PointRows SolidBlock::point_rows(const MeshView& mesh, int element, double /*xi*/) const {
  throw ModelError(fmt::format("solid element {} at {}: only lines have a place along them",
                               element + 1, node_label(mesh.nodes, nodes(element)[0])));
}

void SolidBlock::add_stress_rows(const MeshView& mesh, int first_element,
                                 std::vector<linalg::Triplet>& rows) const {
  for (int e = 0; e < num_elements(); ++e) {
    const SolidKind kind = form(e).kind;
    // The inner modes of hex8 have no strain at the centre.
    const SolidPoint centre =
        solid_point(kind, positions(mesh.nodes, e), solid_topology(kind).centre);
    const StrainRows stress = solid_elasticity(*material(e)) * solid_strain(centre.gradient);
    const std::vector<int> dofs = element_dofs<3>(mesh.dofs, nodes(e));
    for (Eigen::Index j = 0; j < stress.cols(); ++j) {
      const int column = dofs[static_cast<std::size_t>(j)];
      for (int i = 0; i < 6 && column >= 0; ++i) {
        if (stress(i, j) == 0.0) continue;
        rows.emplace_back(6 * (first_element + e) + i, column, stress(i, j));
      }
    }
  }
}

std::vector<std::array<int, 4>> SolidBlock::faces(int element) const {
  const std::span<const int> own = nodes(element);
  std::vector<std::array<int, 4>> out = solid_topology(form(element).kind).pieces;
  for (auto& piece : out) {
    for (int& node : piece) {
      if (node >= 0) node = own[static_cast<std::size_t>(node)];
    }
  }
  return out;
}

}  // namespace buckens::fem

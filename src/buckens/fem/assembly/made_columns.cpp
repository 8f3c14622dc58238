// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/made_columns.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>

#include "buckens/fem/assembly/inertia_assembly.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/linalg/counted_entries.h"
#include "buckens/linalg/divided_matrix.h"

namespace buckens::fem {

using linalg::SparseMatrix;

namespace {

/// Puts numbers into bytes.
class BytesTo {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes them out again.
class BytesFrom {
 public:
  explicit BytesFrom(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
  }
  template <class T>
  T next() {
    T value{};
    (*this)(value);
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
};

/// What matrices of elements depend on.
template <class Visitor>
void visit_numbers(Material& material, Visitor& visit) {
  for (double Material::*number :
       {&Material::E, &Material::nu, &Material::G, &Material::rho, &Material::damping_stiffness}) {
    visit(material.*number);
  }
  bool is_orthotropic = material.orthotropy.has_value();
  visit(is_orthotropic);
  if (!is_orthotropic) return;
  if (!material.orthotropy) material.orthotropy.emplace();
  Orthotropy& of = *material.orthotropy;
  for (Eigen::Index k = 0; k < 3; ++k) visit(of.E[k]);
  for (double* number : {&of.nu12, &of.nu13, &of.nu23, &of.G12, &of.G13, &of.G23}) visit(*number);
  for (Eigen::Index k = 0; k < 9; ++k) visit(of.axes.data()[k]);
}

/// Elements of a mesh of solids and what belongs to them.
struct PartOfMesh {
  MeshMatrix which = MeshMatrix::mass;
  int size = 0;  ///< variables of the whole mesh
  std::vector<Node> nodes;
  DofMap dofs;
  std::vector<int> variables;  ///< of the whole mesh, ascending, for each of those here
  std::shared_ptr<SolidBlock> solids = std::make_shared<SolidBlock>();
};

bool has_variable_in(const DofMap& dofs, std::span<const int> nodes, int first, int end) {
  return std::any_of(nodes.begin(), nodes.end(), [&](int node) {
    const auto& own = dofs.node_dofs[static_cast<std::size_t>(node)];
    return std::any_of(own.begin(), own.end(), [&](int dof) { return dof >= first && dof < end; });
  });
}

void put_elements(const SolidBlock& solids, const std::vector<int>& elements,
                  const std::vector<int>& number, BytesTo& put) {
  std::map<const Material*, int> materials;
  for (const int e : elements) materials.emplace(solids.material(e), 0);
  put(static_cast<int>(materials.size()));
  int count = 0;
  for (auto& [material, place] : materials) {
    Material copy = *material;
    visit_numbers(copy, put);
    place = count++;
  }
  put(static_cast<int>(elements.size()));
  for (const int e : elements) {
    put(solids.form(e).kind);
    put(solids.form(e).integration);
    put(materials.at(solids.material(e)));
    for (const int node : solids.nodes(e)) put(number[static_cast<std::size_t>(node)]);
  }
}

void take_elements(BytesFrom& take, SolidBlock& solids) {
  for (int left = take.next<int>(); left > 0; --left) {
    Material material;
    visit_numbers(material, take);
    solids.add_material(material);
  }
  std::vector<int> nodes;
  for (int left = take.next<int>(); left > 0; --left) {
    SolidForm form;
    take(form.kind);
    take(form.integration);
    const int material = take.next<int>();
    nodes.resize(static_cast<std::size_t>(solid_topology(form.kind).num_nodes));
    for (int& node : nodes) take(node);
    solids.add(form, nodes, material);
  }
}

PartOfMesh part_from(std::span<const std::byte> description) {
  BytesFrom take(description);
  PartOfMesh out;
  take(out.which);
  take(out.size);
  for (int left = take.next<int>(); left > 0; --left) {
    Node& node = out.nodes.emplace_back();
    for (double& coordinate : node.position) take(coordinate);
    for (int& dof : out.dofs.node_dofs.emplace_back()) {
      take(dof);
      if (dof < 0) continue;
      out.variables.push_back(dof);
      dof = out.dofs.num_dofs++;
    }
  }
  take_elements(take, *out.solids);
  return out;
}

/// Of all variables of a part. Those whose elements are not all here lack something.
SparseMatrix matrix_of(const PartOfMesh& part) {
  const MeshView mesh{part.nodes, part.dofs};
  const std::vector<std::shared_ptr<const ElementBlock>> blocks = {part.solids};
  if (part.which == MeshMatrix::mass) {
    const AssembledInertia inertia = assemble_inertia(blocks, mesh, Eigen::Vector3d::Zero());
    if (inertia.nodal.dofs.empty()) return {part.dofs.num_dofs, part.dofs.num_dofs};
    return mass_of_nodes(inertia.nodal, part.dofs.num_dofs);
  }
  StiffnessMatrices stiffness = assemble_stiffness(blocks, mesh);
  SparseMatrix out;
  out.swap(part.which == MeshMatrix::stiffness ? stiffness.K : stiffness.K_damping);
  return out;
}

}  // namespace

std::vector<std::byte> description_of_columns(MeshMatrix which, const SolidBlock& solids,
                                              const MeshView& mesh, int first, int end) {
  std::vector<int> elements;
  std::vector<int> number(mesh.nodes.size(), -1);
  for (int e = 0; e < solids.num_elements(); ++e) {
    if (!has_variable_in(mesh.dofs, solids.nodes(e), first, end)) continue;
    elements.push_back(e);
    for (const int node : solids.nodes(e)) number[static_cast<std::size_t>(node)] = 0;
  }
  // Nodes stay in their order, and so do elements.
  int count = 0;
  for (int& place : number) place = place < 0 ? -1 : count++;
  BytesTo put;
  put(which);
  put(mesh.dofs.num_dofs);
  put(count);
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    for (const double coordinate : mesh.nodes[node].position) put(coordinate);
    for (const int dof : mesh.dofs.node_dofs[node]) put(dof);
  }
  put_elements(solids, elements, number, put);
  return put.take();
}

linalg::SymmetricMatrix matrix_made_elsewhere(MeshMatrix which, const SolidBlock& solids,
                                              const MeshView& mesh) {
  return linalg::SymmetricMatrix(std::make_shared<const linalg::DividedMatrix>(
      mesh.dofs.num_dofs,
      [&](int first, int end) { return description_of_columns(which, solids, mesh, first, end); }));
}

SparseMatrix made_columns(std::span<const std::byte> description, int first, int end) {
  const PartOfMesh part = part_from(description);
  const SparseMatrix A = matrix_of(part);
  const auto visit = [&](auto&& entry) {
    for (int k = 0; k < A.outerSize(); ++k) {
      const int column = part.variables[static_cast<std::size_t>(k)];
      if (column < first || column >= end) continue;
      for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
        if (it.row() < k) continue;
        entry(part.variables[static_cast<std::size_t>(it.row())], column - first, it.value());
      }
    }
  };
  return linalg::from_counted_entries(part.size, end - first, visit);
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/form.h"
#include "buckens/fem/solid/shape.h"

namespace buckens::fem {

/// Solid elements of all kinds: three translations per node, consistent mass.
///
/// All three displacement components share the scalar shape functions, so the inertia is kept as
/// the scalar mass matrix of the nodes (NodalMass): W_ab = Ms ⊗ E_ab. Theory:
/// docs/theory/11-solids.md.
class SolidBlock final : public ElementBlock {
 public:
  /// @return number to pass to add()
  int add_material(const Material& material);
  /// @param nodes in the order of SolidTopology
  /// @return index of the element in this block
  /// @throws ModelError if the number of nodes does not match the kind, or incompatible modes are
  /// requested for anything but hex8
  int add(const SolidForm& form, std::span<const int> nodes, int material);
  /// A hex8 with full integration.
  int add(const std::array<int, 8>& nodes, int material);

  /// Sets the number of an element in messages: that in its file instead of index + 1.
  void set_number(int element, std::int64_t number) {
    elements_.at(static_cast<std::size_t>(element)).number = number;
  }

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override;
  bool is_line() const override { return false; }
  bool is_solid() const override { return true; }
  bool has_rotations() const override { return false; }
  const Material* material(int element) const override {
    return &materials_[static_cast<std::size_t>(at(element).material)];
  }
  const Section* section(int /*element*/) const override { return nullptr; }

  const SolidForm& form(int element) const { return at(element).form; }
  /// Positions of the nodes of an element in model axes [m].
  NodeVectors positions(const std::vector<Node>& all, int element) const;

  /// A subset of the elements, in the given order.
  /// @param node_numbers new number of each node
  SolidBlock subset(const std::vector<int>& elements, const std::vector<int>& node_numbers) const;

  /// @throws ModelError naming an element that is inverted or flat
  void check(const MeshView& mesh) const override;
  void add_mass(const std::vector<Node>& nodes, MassMoment& sum) const override;
  void add_inertia(const MeshView& mesh, const Eigen::Vector3d& com,
                   InertiaSum& sum) const override;
  void add_stiffness(const MeshView& mesh, StiffnessSum& sum) const override;
  void add_force_rows(const MeshView& mesh, int first_element,
                      std::vector<linalg::Triplet>& rows) const override;
  PointRows point_rows(const MeshView& mesh, int element, double xi) const override;
  void add_stress_rows(const MeshView& mesh, int first_element,
                       std::vector<linalg::Triplet>& rows) const override;
  std::vector<std::array<int, 4>> faces(int element) const override;

 private:
  struct Element {
    SolidForm form;
    std::size_t first;  // of its nodes
    int material;
    std::int64_t number;  // in messages
  };

  struct Inverted {
    int element;
    double volume;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }
  /// For messages. @param all nodes of the mesh
  std::string place(const std::vector<Node>& all, int element) const;
  /// Those of elements `begin` to `end` that are inverted or flat.
  std::vector<Inverted> checked(const std::vector<Node>& all, int begin, int end) const;
  [[noreturn]] void refuse_inverted(const std::vector<Node>& all,
                                    const std::vector<Inverted>& inverted) const;

  std::vector<Material> materials_;
  std::vector<Element> elements_;
  std::vector<int> nodes_;  // of all elements, consecutively
};

}  // namespace buckens::fem

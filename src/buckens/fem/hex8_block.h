// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/element_block.h"
#include "buckens/fem/hex8_shape.h"

namespace buckens::fem {

/// Trilinear eight-node solids: three translations per node, full integration, consistent mass.
///
/// All three displacement components share the scalar shape functions, so the inertia is kept as
/// the scalar mass matrix of the nodes (NodalMass): W_ab = Ms ⊗ E_ab. Bending needs several
/// elements across the thickness (shear locking). Theory: docs/theory/11-solids.md.
class Hex8Block final : public ElementBlock {
 public:
  /// @return number to give to add()
  int add_material(const Material& material);
  /// @param nodes in the order of Hex8Corners
  /// @return index of the element in this block
  int add(const std::array<int, 8>& nodes, int material);

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return at(element).nodes; }
  bool is_line() const override { return false; }
  bool is_solid() const override { return true; }
  bool has_rotations() const override { return false; }
  const Material* material(int element) const override {
    return &materials_[static_cast<std::size_t>(at(element).material)];
  }
  const Section* section(int /*element*/) const override { return nullptr; }

  /// Some of the elements, in the given order.
  /// @param node_numbers new number of each node
  Hex8Block subset(const std::vector<int>& elements, const std::vector<int>& node_numbers) const;

  /// @throws ModelError naming an element that is turned inside out or squashed flat
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
    std::array<int, 8> nodes;
    int material;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }
  static Hex8Corners corners(const std::vector<Node>& nodes, const Element& element);

  std::vector<Material> materials_;
  std::vector<Element> elements_;
};

}  // namespace buckens::fem

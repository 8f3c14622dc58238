// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// Two-node bars: axial stiffness only, three translations per node, consistent mass.
///
/// All three displacement components are linear along the bar. Its mass is on the line, without
/// rotary inertia about the axis.
class BarBlock final : public ElementBlock {
 public:
  /// @return index of the element in this block
  int add(int node_a, int node_b, const Material& material, const Section& section);

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return at(element).ends; }
  bool is_line() const override { return true; }
  bool has_rotations() const override { return false; }
  const Material* material(int element) const override { return &at(element).material; }
  const Section* section(int element) const override { return &at(element).section; }
  /// As for a beam without `up`.
  Eigen::Matrix3d line_axes(const std::vector<Node>& nodes, int element) const override;

  /// A subset of the elements, in the given order.
  /// @param node_numbers new number of each node
  BarBlock subset(const std::vector<int>& elements, const std::vector<int>& node_numbers) const;

  void check(const MeshView& mesh) const override;
  void add_mass(const std::vector<Node>& nodes, MassMoment& sum) const override;
  void add_inertia(const MeshView& mesh, const Eigen::Vector3d& com,
                   InertiaSum& sum) const override;
  void add_stiffness(const MeshView& mesh, StiffnessSum& sum) const override;
  void add_force_rows(const MeshView& mesh, int first_element,
                      std::vector<linalg::Triplet>& rows) const override;
  PointRows point_rows(const MeshView& mesh, int element, double xi) const override;

 private:
  struct Element {
    std::array<int, 2> ends;
    Material material;
    Section section;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }

  std::vector<Element> elements_;
};

}  // namespace buckens::fem

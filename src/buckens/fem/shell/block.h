// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/shell/section.h"
#include "buckens/fem/shell/shape.h"

namespace buckens::fem {

/// Shells with three, four, six or eight nodes, thin or moderately thick, six variables per node.
///
/// A material point moves by u = Σ N_i (u_i + θ_i × z n_i), with z measured from the nodes along
/// the director n_i; inertia follows from that field, stiffness from shell/element.h. Theory:
/// docs/theory/15-shells.md.
class ShellBlock final : public ElementBlock {
 public:
  /// @return number to pass to add()
  int add_section(const ShellSection& section);
  /// @param nodes three or four corners, counter-clockwise seen from the side the normal points to,
  /// then the nodes on all sides or none, starting between the first two corners
  /// @return index of the element in this block
  /// @throws ModelError for any other number of nodes
  int add(std::span<const int> nodes, int section);
  /// The same with given directors, one for each of its nodes.
  /// @pre all elements before it have directors
  int add(std::span<const int> nodes, int section, const ShellVectors& directors);

  /// Sets the number of an element in messages: that in its file instead of index + 1.
  void set_number(int element, std::int64_t number) {
    elements_.at(static_cast<std::size_t>(element)).number = number;
  }

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override {
    return {at(element).nodes.data(), static_cast<std::size_t>(at(element).count)};
  }
  bool is_line() const override { return false; }
  bool is_shell() const override { return true; }
  bool has_rotations() const override { return true; }
  /// Material of the first layer.
  const Material* material(int element) const override {
    return &shell_section(element).layers.front().material;
  }
  const Section* section(int /*element*/) const override { return nullptr; }

  const ShellSection& shell_section(int element) const {
    return sections_[static_cast<std::size_t>(at(element).section)];
  }
  const ShellStiffness& stiffness(int element) const {
    return stiffness_[static_cast<std::size_t>(at(element).section)];
  }

  /// Gives every element a director at each of its nodes: the mean normal of the shells there that
  /// lie within 25° of its own. Elements that already have directors keep them.
  void choose_directors(const std::vector<Node>& nodes);
  /// Positions of the nodes of an element in model axes [m].
  ShellVectors positions(const std::vector<Node>& all, int element) const;
  /// Unit vectors; the element's own normals before choose_directors().
  ShellVectors directors(const std::vector<Node>& all, int element) const;

  /// A subset of the elements with their directors, in the given order.
  /// @param node_numbers new number of each node
  ShellBlock subset(const std::vector<int>& elements, const std::vector<int>& node_numbers) const;

  /// @throws ModelError naming an element that is squashed, folded or has an impossible section
  void check(const MeshView& mesh) const override;
  void add_mass(const std::vector<Node>& nodes, MassMoment& sum) const override;
  void add_inertia(const MeshView& mesh, const Eigen::Vector3d& com,
                   InertiaSum& sum) const override;
  void add_stiffness(const MeshView& mesh, StiffnessSum& sum) const override;
  void add_force_rows(const MeshView& /*mesh*/, int /*first_element*/,
                      std::vector<linalg::Triplet>& /*rows*/) const override {}
  PointRows point_rows(const MeshView& mesh, int element, double xi) const override;
  void add_stress_rows(const MeshView& mesh, int first_element,
                       std::vector<linalg::Triplet>& rows) const override;
  std::vector<std::array<int, 4>> faces(int element) const override;

 private:
  struct Element {
    std::array<int, kMostShellNodes> nodes;  // −1 after the last
    int count;
    int section;
    std::int64_t number;  // in messages
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }

  std::vector<ShellSection> sections_;
  std::vector<ShellStiffness> stiffness_;
  std::vector<Element> elements_;
  std::vector<ShellVectors> directors_;  // of the first elements; empty before choose_directors()
};

}  // namespace buckens::fem

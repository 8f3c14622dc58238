// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// Springs between two nodes of a mesh: the force on b is −k Δ, with Δ the displacement and
/// rotation of b relative to a, both taken midway between the nodes,
///
///     Δ = (u_b + θ_b × (m − x_b) − u_a − θ_a × (m − x_a), θ_b − θ_a).
///
/// Rigid motion therefore does not strain springs. They have no mass. Between nodes without
/// rotations only directions that need none can have stiffness: all translations if nodes coincide.
class SpringBlock final : public ElementBlock {
 public:
  using Stiffness = Eigen::Matrix<double, 6, 6>;

  /// @param stiffness symmetric, translations before rotations, model axes [N/m, N, N m]
  /// @return index of the element in this block
  int add(int node_a, int node_b, const Stiffness& stiffness);

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return at(element).ends; }
  bool is_line() const override { return false; }
  bool holds_nodes() const override { return true; }
  bool has_rotations() const override { return false; }
  const Material* material(int /*element*/) const override { return nullptr; }
  const Section* section(int /*element*/) const override { return nullptr; }

  const Stiffness& stiffness(int element) const { return at(element).stiffness; }

  /// @throws ModelError if the stiffness is not symmetric and positive semi-definite, or needs
  /// rotations that the nodes do not have
  void check(const MeshView& mesh) const override;
  void add_mass(const std::vector<Node>& /*nodes*/, MassMoment& /*sum*/) const override {}
  void add_inertia(const MeshView& /*mesh*/, const Eigen::Vector3d& /*com*/,
                   InertiaSum& /*sum*/) const override {}
  void add_stiffness(const MeshView& mesh, StiffnessSum& sum) const override;
  void add_force_rows(const MeshView& /*mesh*/, int /*first_element*/,
                      std::vector<linalg::Triplet>& /*rows*/) const override {}
  PointRows point_rows(const MeshView& mesh, int element, double xi) const override;

 private:
  struct Element {
    std::array<int, 2> ends;
    Stiffness stiffness;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }

  std::vector<Element> elements_;
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// Point masses on nodes, with rotary inertia where the node has rotations.
///
/// Material points move by u + θ × ρ; everything follows from the second moment E = ∫ρρᵀdm =
/// ½tr(I)1 − I, so a point mass shares the kinematics of a beam section.
class PointMassBlock final : public ElementBlock {
 public:
  /// @param inertia about the node in model axes [kg m²], zero without rotary inertia
  /// @return index of the element in this block
  int add(int node, double mass, const Eigen::Matrix3d& inertia = Eigen::Matrix3d::Zero());

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return {&at(element).node, 1}; }
  bool is_line() const override { return false; }
  bool has_rotations() const override { return false; }
  const Material* material(int /*element*/) const override { return nullptr; }
  const Section* section(int /*element*/) const override { return nullptr; }
  double mass(int element) const { return at(element).mass; }
  const Eigen::Matrix3d& inertia(int element) const { return at(element).inertia; }

  /// @throws ModelError also if a node with inertia has no rotations
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
    int node;
    double mass;
    Eigen::Matrix3d inertia;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }

  std::vector<Element> elements_;
};

}  // namespace buckens::fem

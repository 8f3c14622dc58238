// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/fem/beam_shape.h"
#include "buckens/fem/element_block.h"

namespace buckens::fem {

/// What all elements of one beam share.
struct BeamProperties {
  Material material;
  Section section;
  BeamTheory theory = BeamTheory::euler_bernoulli;
  /// Whether sections have rotary inertia in bending. Off: T = ½∫ρA|ṙ+ω×(x+u)+u̇|² dx +
  /// ½∫ρI_p(ω·t+θ̇_x)² dx, a line with torsional flywheels. On: every material point counts.
  bool rotary_inertia = false;
  std::optional<Eigen::Vector3d> up;  ///< hint for the local z axis, model axes

  /// Rotary inertia as usual for the theory: on for Timoshenko, off for Euler–Bernoulli.
  static BeamProperties of(const Material& material, const Section& section, BeamTheory theory) {
    return {material, section, theory, theory == BeamTheory::timoshenko, std::nullopt};
  }
};

/// Two-node beams in space: axial, torsion, bending in two planes, optionally with shear
/// flexibility.
///
/// Six variables per node. Consistent mass from the interpolation of beam_shape.h. Any orientation;
/// no offsets between node and centroid. Theory: docs/theory/07-beam.md.
class BeamBlock final : public ElementBlock {
 public:
  /// @return number to give to add()
  int add_properties(BeamProperties properties);
  /// @return index of the element in this block
  int add(int node_a, int node_b, int properties);

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return at(element).ends; }
  bool is_line() const override { return true; }
  bool has_rotations() const override { return true; }
  const Material* material(int element) const override { return &of(at(element)).material; }
  const Section* section(int element) const override { return &of(at(element)).section; }
  const BeamProperties& properties(int element) const { return of(at(element)); }

  /// Some of the elements, in the given order.
  /// @param node_numbers new number of each node
  BeamBlock subset(const std::vector<int>& elements, const std::vector<int>& node_numbers) const;

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
    int properties;
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }
  const BeamProperties& of(const Element& element) const {
    return properties_[static_cast<std::size_t>(element.properties)];
  }
  LineFrame frame(const std::vector<Node>& nodes, const Element& element) const;

  std::vector<BeamProperties> properties_;
  std::vector<Element> elements_;
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/line/beam_shape.h"
#include "buckens/fem/line/section_taper.h"

namespace buckens::fem {

/// Properties common to all elements of one beam.
struct BeamProperties {
  Material material;
  Section section;
  BeamTheory theory = BeamTheory::euler_bernoulli;
  /// Whether sections have rotary inertia in bending. Off: T = ½∫ρA|ṙ+ω×(x+u)+u̇|² dx +
  /// ½∫ρI_p(ω·t+θ̇_x)² dx, a line with torsional flywheels. On: every material point contributes.
  bool rotary_inertia = false;
  std::optional<Eigen::Vector3d> up = std::nullopt;  ///< hint for the local z axis, model axes
  /// Sections of a tapered beam; `section` is then ignored.
  SectionLaw taper = nullptr;

  /// Usual choice of rotary inertia: on for Timoshenko, off for Euler–Bernoulli beams.
  static BeamProperties of(const Material& material, const Section& section, BeamTheory theory) {
    return {material, section, theory, theory == BeamTheory::timoshenko};
  }
};

/// Properties of a single element of a beam.
struct BeamPortion {
  double from = 0, to = 1;  ///< positions of its ends along the beam, for the taper
  std::optional<Eigen::Vector3d> up = std::nullopt;  ///< overrides that of the beam
};

/// Two-node beams in space: axial, torsion, bending in two planes, optionally with shear
/// flexibility, uniform or tapered.
///
/// Six variables per node. Stiffness exact for loads at the ends, consistent mass from the
/// interpolation of beam_shape.h. Any orientation; no offsets between node and centroid. Theory:
/// docs/theory/07-beam.md.
class BeamBlock final : public ElementBlock {
 public:
  /// @return number to pass to add()
  int add_properties(BeamProperties properties);
  /// @return index of the element in this block
  int add(int node_a, int node_b, int properties, const BeamPortion& portion = {});
  /// One whose sections are given instead of following from the properties; null: uniform.
  int add(int node_a, int node_b, int properties, const BeamPortion& portion,
          const SectionTaper* taper);

  int num_elements() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> nodes(int element) const override { return at(element).ends; }
  bool is_line() const override { return true; }
  bool has_rotations() const override { return true; }
  const Material* material(int element) const override { return &of(at(element)).material; }
  /// For a tapered element, the section at its middle.
  const Section* section(int element) const override;
  const Section* end_section(int element, int end) const override;
  Eigen::Matrix3d line_axes(const std::vector<Node>& nodes, int element) const override;
  double axial_rigidity(int element) const override;
  const BeamProperties& properties(int element) const { return of(at(element)); }
  const BeamPortion& portion(int element) const { return at(element).portion; }
  /// Null for a uniform element.
  const SectionTaper* taper(int element) const { return taper(at(element)); }
  /// A along an element.
  Quartic area(int element) const;

  /// A subset of the elements, in the given order.
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
    BeamPortion portion;
    int taper;  // −1: uniform
  };

  const Element& at(int element) const { return elements_.at(static_cast<std::size_t>(element)); }
  const BeamProperties& of(const Element& element) const {
    return properties_[static_cast<std::size_t>(element.properties)];
  }
  /// Null for a uniform element.
  const SectionTaper* taper(const Element& element) const {
    return element.taper < 0 ? nullptr : &tapers_[static_cast<std::size_t>(element.taper)];
  }
  const Section& middle(const Element& element) const {
    const SectionTaper* own = taper(element);
    return own != nullptr ? own->middle : of(element).section;
  }
  LineFrame frame(const std::vector<Node>& nodes, const Element& element) const;
  /// Interpolation with the shear parameters at mid-length.
  BeamShape shape_of(const Element& element, const LineFrame& axes) const;
  Eigen::Matrix<double, 12, 12> local_stiffness(const Element& element, double length) const;

  std::vector<BeamProperties> properties_;
  std::vector<Element> elements_;
  std::vector<SectionTaper> tapers_;
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/fem/constraint/link_spec.h"
#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/line/beam_path.h"
#include "buckens/fem/line/beam_shape.h"
#include "buckens/fem/line/section_spec.h"
#include "buckens/fem/shell/spec.h"
#include "buckens/fem/solid/element_spec.h"

namespace buckens::fem {

constexpr std::array<const char*, 2> choice_names(BeamTheory) {
  return {"euler-bernoulli", "timoshenko"};
}

/// Common to all beams, however their ends are given.
struct BeamPropertySpec {
  int elements = 1;
  base::Reference<SectionSpec> section;
  std::optional<base::Reference<SectionSpec>> end_section;  ///< of the same kind
  std::vector<Eigen::Vector3d> through;                     ///< between its ends, model axes [m]
  BeamPath path = BeamPath::polyline;
  base::Reference<MaterialSpec> material;
  std::optional<Eigen::Vector3d> up;  ///< hint for the local z axis, model axes
  BeamTheory theory = BeamTheory::euler_bernoulli;
  std::optional<bool> rotary_inertia;  ///< default: on for Timoshenko, off for Euler–Bernoulli

  bool has_rotary_inertia() const {
    return rotary_inertia.value_or(theory == BeamTheory::timoshenko);
  }

  template <class Visitor>
  void property_fields(Visitor& visit) {
    visit(base::field("elements", elements,
                      "number of elements, equally long between two given points")
              .positive()
              .like("16"));
    visit(
        base::field("section", section, "cross-section: a name from `sections` or written in place")
            .required()
            .like("{circle: {diameter: 6 mm}}"));
    visit(base::field("end-section", end_section,
                      "section at the second end, of the same shape: the dimensions vary linearly "
                      "from `section` to it")
              .like("{circle: {diameter: 3 mm}}")
              .otherwise("the beam is uniform"));
    visit(base::field("through", through,
                      "points between the ends through which the beam passes, in model axes; nodes "
                      "are on its `path`, elements are straight")
              .in(base::kLength)
              .like("[[0.1 m, 0.05 m, 0]]")
              .otherwise("the beam is straight"));
    visit(base::field("path", path,
                      "path from point to point: straight lines, a circular arc (one point in "
                      "`through`) or a natural cubic spline"));
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
    visit(base::field("up", up, "approximate direction of the local z axis, in model axes")
              .like("[0, 0, 1]")
              .otherwise("model z; model y for members along z; along a `path` the axes of the "
                         "first element are continued without twist"));
    visit(base::field("theory", theory, "with (`timoshenko`) or without shear deformation"));
    visit(base::field("rotary-inertia", rotary_inertia,
                      "rotary inertia of bending (that of torsion is always included)")
              .on_off()
              .otherwise("on for timoshenko, off for euler-bernoulli"));
  }
};

/// Point mass at a node.
struct PointMassSpec {
  SourceLocation where;
  std::string at;   ///< node; of a beam: start, mid, end
  double mass = 0;  ///< [kg]
  /// Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the mass centre in model axes [kg m²].
  std::vector<double> inertia;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of the mass centre from the node [m]

  Eigen::Matrix3d inertia_matrix() const;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field(
              "at", at,
              "node that carries the mass; of a `beam`: start, mid or end; of a `mesh`: a named "
              "node such as `centre`")
              .required()
              .like("end"));
    visit(base::field("mass", mass, "mass").in(base::kMass).required().non_negative().like("33 g"));
    visit(base::field("inertia", inertia,
                      "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] about the "
                      "node, or about the mass centre where that is elsewhere; in model axes")
              .in(base::kInertia)
              .like("[0, 0, 1e-5 kg m^2]")
              .otherwise("none"));
    visit(base::field("offset", offset,
                      "from the node to the mass centre, rigidly attached; in model axes")
              .in(base::kLength)
              .like("[0, 0, 20 mm]"));
  }
};

/// The matrix of [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz]; zero for an empty list. The
/// last three are entries of the matrix: Ixy = −∫ x y dm.
inline Eigen::Matrix3d symmetric_matrix(const std::vector<double>& entries) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  if (entries.size() >= 3) out.diagonal() << entries[0], entries[1], entries[2];
  if (entries.size() == 6) {
    out(0, 1) = out(1, 0) = entries[3];
    out(0, 2) = out(2, 0) = entries[4];
    out(1, 2) = out(2, 1) = entries[5];
  }
  return out;
}

inline Eigen::Matrix3d PointMassSpec::inertia_matrix() const { return symmetric_matrix(inertia); }

/// A body consisting of one beam.
struct BeamSpec : BeamPropertySpec {
  static constexpr const char* kKey = "beam";
  static constexpr const char* kDoc = "flexible body: one beam";
  SourceLocation where;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< model axes [m]
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< model axes [m]
  std::vector<PointMassSpec> masses;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "first end (`start`), in model axes")
              .in(base::kLength)
              .like("[0, 0, 0]"));
    visit(base::field("to", to, "second end (`end`), in model axes")
              .in(base::kLength)
              .required()
              .like("[300 mm, 0, 0]"));
    property_fields(visit);
    visit(base::field("masses", masses, "point masses on the beam"));
  }
};

/// A named point of a structure.
struct NodeSpec {
  std::string name;
  SourceLocation where;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< model axes [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(position, "position in model axes")
              .in(base::kLength)
              .required()
              .like("[0, 100 mm, 0]"));
  }
};

/// A beam between two named nodes.
struct BeamMemberSpec : BeamPropertySpec {
  SourceLocation where;
  std::array<std::string, 2> between;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two nodes").required().like("[a, b]"));
    property_fields(visit);
  }
};

/// A bar (axial stiffness only) between two named nodes. More than one element needs a frame each
/// (`frames: per-element`), which keep them collinear; in one frame they would be a mechanism.
/// Exactly one of section and area is given.
struct BarMemberSpec {
  SourceLocation where;
  std::array<std::string, 2> between;
  std::optional<base::Reference<SectionSpec>> section;
  std::optional<double> area;  ///< [m²]
  base::Reference<MaterialSpec> material;
  int elements = 1;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two nodes").required().like("[a, b]"));
    visit(base::field("elements", elements,
                      "number of elements; more than one needs `frames: per-element`")
              .positive());
    visit(
        base::field("section", section, "cross-section: a name from `sections` or written in place")
            .like("{circle: {diameter: 6 mm}}")
            .otherwise("give this or `area`"));
    visit(base::field("area", area, "cross-section area")
              .in(base::kArea)
              .positive()
              .like("100 mm^2")
              .otherwise("give this or `section`"));
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
  }
};

/// Beams, bars, solids, shells and point masses between named nodes. Beams and shells are joined
/// rigidly; bars and solids constrain only the position of a node.
struct StructureSpec {
  // In structure_spec.cpp, because they reach through all members: two to five seconds of compiling
  // each.
  StructureSpec();
  StructureSpec(const StructureSpec&);
  StructureSpec(StructureSpec&&) noexcept;
  StructureSpec& operator=(const StructureSpec&);
  StructureSpec& operator=(StructureSpec&&) noexcept;
  ~StructureSpec();

  static constexpr const char* kKey = "structure";
  static constexpr const char* kDoc =
      "flexible body: beams, bars, solids, shells and masses between named nodes";
  SourceLocation where;
  std::vector<NodeSpec> nodes;
  std::vector<BeamMemberSpec> beams;
  std::vector<BarMemberSpec> bars;
  std::vector<SolidMemberSpec> solids;
  std::vector<ShellMemberSpec> shells;
  std::vector<PointMassSpec> masses;
  std::optional<StructureLinksSpec> links;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("nodes", nodes, "points by name")
              .required()
              .like("{a: [0, 0, 0], b: [1 m, 0, 0]}"));
    visit(base::field("beams", beams, "beams between nodes"));
    visit(base::field("bars", bars, "bars between nodes: axial stiffness only"));
    visit(base::field("solids", solids, "single solid elements between nodes"));
    visit(base::field("shells", shells, "single shell elements between nodes"));
    visit(base::field("masses", masses, "point masses at nodes"));
    visit(
        base::field("links", links, "rigid links, averages, equations and springs between nodes"));
  }
};

}  // namespace buckens::fem

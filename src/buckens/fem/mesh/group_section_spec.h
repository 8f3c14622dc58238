// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/fem/structure_spec.h"

namespace buckens::fem {

/// Section of the shells, beams or bars of one part of a mesh file. Exactly one of thickness,
/// layers, beam and bar is given.
struct GroupSectionSpec : ShellPropertySpec {
  static constexpr bool kHasForeignName = true;  ///< any characters
  std::string name;                              ///< of the property, element set or physical group
  SourceLocation where;
  bool along_first_side = false;
  std::optional<base::Reference<SectionSpec>> beam;
  std::optional<base::Reference<SectionSpec>> bar;
  std::optional<Eigen::Vector3d> up;  ///< hint for the local z axis of beams, model axes
  std::optional<BeamTheory> theory;
  std::optional<bool> rotary_inertia;
  std::optional<base::Reference<MaterialSpec>> material;

  bool is_shell() const { return thickness || !layers.empty(); }

  template <class Visitor>
  void fields(Visitor& visit) {
    shell_fields(visit);
    visit(
        base::field("along-first-side", along_first_side,
                    "of a shell without `direction`: its x axis lies along the first side of each "
                    "element")
            .on_off());
    visit(base::field("beam", beam,
                      "cross-section of beams: a name from `sections` of the model or written in "
                      "place")
              .like("{rectangle: {width: 5 mm, height: 20 mm}}")
              .otherwise("give this, `bar`, `thickness` or `layers`"));
    visit(
        base::field("bar", bar,
                    "cross-section of bars, which carry axial forces only: a name from `sections` "
                    "of the model or written in place")
            .like("{circle: {diameter: 6 mm}}")
            .otherwise("give this, `beam`, `thickness` or `layers`"));
    visit(base::field("up", up, "of beams: approximate direction of the local z axis, model axes")
              .like("[0, 0, 1]")
              .otherwise("that of the file; else model z, or model y for elements along z"));
    visit(
        base::field("theory", theory, "of beams: with (`timoshenko`) or without shear deformation")
            .otherwise("euler-bernoulli"));
    visit(base::field("rotary-inertia", rotary_inertia, "of beams: rotary inertia of bending")
              .on_off()
              .otherwise("on for timoshenko, off for euler-bernoulli"));
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .like("steel")
              .otherwise("as for elements without an entry in `sections`"));
  }
};

}  // namespace buckens::fem

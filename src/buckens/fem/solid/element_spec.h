// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/solid/form.h"

namespace buckens::fem {

/// The kind of solid elements of a mesh.
struct SolidElementSpec {
  SolidKind element = SolidKind::hex8;
  std::optional<SolidIntegration> integration;  ///< default: SolidForm::usual

  SolidForm form() const {
    return {element, integration.value_or(SolidForm::usual(element).integration)};
  }

  template <class Visitor>
  void element_fields(Visitor& visit) {
    visit(base::field(
        "element", element,
        "solid element: linear (`hex8`, `tet4`, `wedge6`, `pyramid5`) or quadratic with "
        "mid-side nodes (`hex20`, `tet10`, `wedge15`)"));
    visit(base::field("integration", integration,
                      "`incompatible-modes` (hex8 only) bends without locking; `full` uses the "
                      "shape functions only, at 2 × 2 × 2 points for hex8: bending then needs "
                      "several elements through the thickness")
              .like("full")
              .otherwise("incompatible-modes for hex8, full for all others"));
  }
};

/// One solid element between named nodes.
struct SolidMemberSpec : SolidElementSpec {
  SourceLocation where;
  std::vector<std::string> nodes;
  base::Reference<MaterialSpec> material;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field(
              "nodes", nodes,
              "hexahedra and wedges: the corners of one face counter-clockwise seen from the "
              "opposite face, then those of the opposite face in the same order; tetrahedra and "
              "pyramids: the corners of a face (the base) counter-clockwise seen from the last "
              "corner, then the last corner; mid-side nodes follow in the order of Abaqus")
              .required()
              .like("[a, b, c, d, e, f, g, h]"));
    element_fields(visit);
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
  }
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/fem/material_spec.h"

namespace buckens::fem {

/// Elements that fill a volume.
enum class SolidElement { hex8 };

constexpr std::array<const char*, 1> choice_names(SolidElement) { return {"hex8"}; }

/// How the strains of a solid element are taken and integrated.
enum class SolidIntegration { full };

constexpr std::array<const char*, 1> choice_names(SolidIntegration) { return {"full"}; }

/// Which solid element a mesh consists of.
struct SolidElementSpec {
  SolidElement element = SolidElement::hex8;
  SolidIntegration integration = SolidIntegration::full;

  template <class Visitor>
  void element_fields(Visitor& visit) {
    visit(base::field("element", element,
                      "solid element; `hex8` has eight corner nodes and trilinear displacements"));
    visit(base::field("integration", integration,
                      "`full`: at 2 × 2 × 2 points of hex8; bending then needs several elements "
                      "across the thickness"));
  }
};

/// One solid element between named nodes.
struct SolidMemberSpec : SolidElementSpec {
  SourceLocation where;
  std::vector<std::string> nodes;
  base::Reference<MaterialSpec> material;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("nodes", nodes,
                      "hex8: the four nodes of one face counter-clockwise seen from the opposite "
                      "face, then those of that face in the same order")
              .required()
              .like("[a, b, c, d, e, f, g, h]"));
    element_fields(visit);
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
  }
};

}  // namespace buckens::fem

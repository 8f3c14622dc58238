// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/mesh/spec.h"
#include "buckens/fem/solid/shape.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

Found form_problem(const fem::SolidElementSpec& spec) {
  const fem::SolidForm form = spec.form();
  if (form.integration == fem::SolidIntegration::full || form.kind == fem::SolidKind::hex8) {
    return std::nullopt;
  }
  return Finding{"integration", "only hex8 has incompatible modes; remove the key or write `full`"};
}

/// Findings about measures that are positive and finite each by itself.
Found round_problem(const fem::RoundMeshSpec& spec, double inner_radius) {
  const int around = spec.divisions[1];
  if (around < 4) {
    return Finding{
        "divisions.1",
        fmt::format(
            "{} elements around the circumference are too few for a round part; give at least 4",
            around)};
  }
  if (inner_radius == 0.0 && around % 4 != 0) {
    return Finding{"divisions.1",
                   fmt::format("{} elements around; without a bore their number must be divisible "
                               "by 4, for example {}",
                               around, 4 * (around / 4 + 1))};
  }
  return form_problem(spec);
}

Found length_problem(const fem::Cylinder& shape) {
  if ((shape.to - shape.from).norm() > 0.0) return std::nullopt;
  return Finding{"to", "the length is zero: \"from\" and \"to\" are the same point"};
}

}  // namespace

Found problem(const fem::SolidMemberSpec& spec, const ModelDescription&) {
  const auto count = static_cast<std::size_t>(fem::solid_topology(spec.element).num_nodes);
  if (spec.nodes.size() == count) return form_problem(spec);
  return Finding{
      "nodes",
      fmt::format("a {1} has {2} nodes, found {0}", spec.nodes.size(),
                  fem::choice_names(spec.element)[static_cast<std::size_t>(spec.element)], count)};
}

Found problem(const fem::BoxMeshSpec& spec, const ModelDescription&) { return form_problem(spec); }

Found problem(const fem::CylinderMeshSpec& spec, const ModelDescription&) {
  if (Found found = length_problem(spec.shape())) return found;
  return round_problem(spec, 0.0);
}

Found problem(const fem::TubeMeshSpec& spec, const ModelDescription&) {
  if (Found found = length_problem(spec.shape())) return found;
  if (spec.inner_diameter >= spec.outer_diameter) {
    return Finding{"inner-diameter",
                   fmt::format("{:g} m must be less than the outer diameter, {:g} m",
                               spec.inner_diameter, spec.outer_diameter)};
  }
  return round_problem(spec, spec.inner_diameter);
}

Found problem(const fem::DiscMeshSpec& spec, const ModelDescription&) {
  if (spec.axis.norm() == 0.0) return Finding{"axis", "a direction cannot be zero"};
  if (spec.bore >= spec.diameter) {
    return Finding{"bore", fmt::format("{:g} m must be less than the diameter, {:g} m", spec.bore,
                                       spec.diameter)};
  }
  return round_problem(spec, spec.bore);
}

Found problem(const fem::OrthotropicSpec& spec, const ModelDescription&) {
  if (spec.axis_1.norm() == 0.0) return Finding{"axis-1", "a direction cannot be zero"};
  // Below that angle rounding of the file decides where direction 2 is.
  if (spec.axis_1.normalized().cross(spec.axis_2).norm() <= 1e-6 * spec.axis_2.norm()) {
    return Finding{"axis-2", "it is parallel to \"axis-1\" or zero; choose a direction across it"};
  }
  fem::Material material;
  material.orthotropy = spec.constants();
  try {
    fem::check_solid_material("these constants", material);
  } catch (const ModelError& error) {
    return Finding{"", error.what()};
  }
  return std::nullopt;
}

Found problem(const fem::MaterialSpec& spec, const ModelDescription&) {
  if (!spec.orthotropic) {
    if (spec.E > 0.0) return std::nullopt;
    return Finding{"", "the key \"E\" is missing; example: E: 200 GPa (or give `orthotropic`)"};
  }
  if (spec.E == 0.0 && spec.nu == 0.0 && !spec.G) return std::nullopt;
  return Finding{
      "orthotropic",
      "the nine constants replace \"E\", \"nu\" and \"G\"; remove these or \"orthotropic\""};
}

}  // namespace buckens::model

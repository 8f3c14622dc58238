// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec_properties.h"

#include <variant>

#include "buckens/base/errors.h"

namespace buckens::model {

fem::Material make_material(const fem::MaterialSpec& spec,
                            const std::optional<fem::DampingSpec>& of_body) {
  fem::Material material{spec.E, spec.nu, spec.shear_modulus(), spec.rho, 0.0, 0.0, {}};
  if (spec.orthotropic) material.orthotropy = spec.orthotropic->constants();
  const auto& damping = of_body ? of_body : spec.damping;
  if (damping) {
    material.damping_mass = damping->alpha();
    material.damping_stiffness = damping->beta();
  }
  return material;
}

fem::Section make_section(const fem::SectionSpec& spec) {
  struct Maker {
    fem::Section operator()(const fem::CircleSpec& s) const {
      return fem::Section::circle(s.diameter);
    }
    fem::Section operator()(const fem::TubeSpec& s) const {
      return fem::Section::tube(s.outer_diameter, s.inner());
    }
    fem::Section operator()(const fem::RectangleSpec& s) const {
      return fem::Section::rectangle(s.width, s.height);
    }
    fem::Section operator()(const fem::BoxSpec& s) const {
      return fem::Section::box(s.width, s.height, s.thickness);
    }
    fem::Section operator()(const fem::GeneralSectionSpec& s) const {
      fem::Section section =
          fem::Section::general(s.A, s.Iy, s.Iz, s.J, s.shear_factor_y, s.shear_factor_z);
      if (s.stress_points.empty()) return section;
      section.stress_points.clear();
      for (const auto& point : s.stress_points) {
        section.stress_points.emplace_back(point[0], point[1]);
      }
      return section;
    }
  };
  try {
    return std::visit(Maker{}, spec.shape);
  } catch (const ModelError& error) {
    throw InputError(spec.where, error.what());
  }
}

}  // namespace buckens::model

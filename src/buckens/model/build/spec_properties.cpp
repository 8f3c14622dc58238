// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/spec_properties.h"

#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

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
    material.damps_held_motion = damping->is_of_held_motion();
  }
  return material;
}

namespace {

/// Shapes between two of a kind, s from 0 to 1.
class ShapeBetween {
 public:
  explicit ShapeBetween(double s) : s_(s) {}

  fem::CircleSpec operator()(const fem::CircleSpec& a, const fem::CircleSpec& b) const {
    return {mix(a.diameter, b.diameter)};
  }
  fem::TubeSpec operator()(const fem::TubeSpec& a, const fem::TubeSpec& b) const {
    return {mix(a.outer_diameter, b.outer_diameter), std::nullopt, mix(a.inner(), b.inner())};
  }
  fem::RectangleSpec operator()(const fem::RectangleSpec& a, const fem::RectangleSpec& b) const {
    return {mix(a.width, b.width), mix(a.height, b.height)};
  }
  fem::BoxSpec operator()(const fem::BoxSpec& a, const fem::BoxSpec& b) const {
    return {mix(a.width, b.width), mix(a.height, b.height), mix(a.thickness, b.thickness)};
  }
  fem::GeneralSectionSpec operator()(const fem::GeneralSectionSpec& a,
                                     const fem::GeneralSectionSpec& b) const {
    fem::GeneralSectionSpec out{mix(a.A, b.A),
                                mix(a.Iy, b.Iy),
                                mix(a.Iz, b.Iz),
                                mix(a.J, b.J),
                                mix(a.shear_factor_y, b.shear_factor_y),
                                mix(a.shear_factor_z, b.shear_factor_z),
                                a.stress_points};
    for (std::size_t k = 0; k < out.stress_points.size(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        out.stress_points[k][i] = mix(a.stress_points[k][i], b.stress_points[k][i]);
      }
    }
    return out;
  }

 private:
  double mix(double a, double b) const { return (1.0 - s_) * a + s_ * b; }

  double s_;
};

const char* shape_name(const fem::SectionSpec& spec) {
  return std::visit([](const auto& shape) { return std::decay_t<decltype(shape)>::kKey; },
                    spec.shape);
}

std::size_t num_stress_points(const fem::SectionSpec& spec) {
  const auto* general = std::get_if<fem::GeneralSectionSpec>(&spec.shape);
  return general == nullptr ? 0 : general->stress_points.size();
}

}  // namespace

fem::SectionLaw make_taper(const fem::SectionSpec& first, const fem::SectionSpec& last) {
  static_cast<void>(make_section(first));
  static_cast<void>(make_section(last));
  if (first.shape.index() != last.shape.index()) {
    throw InputError(
        last.where, fmt::format("end-section: a beam cannot change from a {} to a {}; give both "
                                "ends the same shape, or give section constants for both (general)",
                                shape_name(first), shape_name(last)));
  }
  if (num_stress_points(first) != num_stress_points(last)) {
    throw InputError(last.where,
                     fmt::format("end-section: it has {} stress points, the section at the first "
                                 "end has {}; give both as many, in the same order",
                                 num_stress_points(last), num_stress_points(first)));
  }
  return [first, last](double s) {
    fem::SectionSpec between{"", first.where, first.shape};
    std::visit(
        [&](const auto& a) {
          using Shape = std::decay_t<decltype(a)>;
          between.shape = ShapeBetween(s)(a, std::get<Shape>(last.shape));
        },
        first.shape);
    return make_section(between);
  };
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
      // Stress points are at the outline of the section: their hull approximates its shape.
      const fem::SectionLoop around = fem::convex_hull(section.stress_points);
      if (around.size() >= 3) section.outline = {around};
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

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/mesh_io/symmetry_axes.h"

namespace buckens::mesh_io {

namespace {

/// Share of the largest constant that is rounding of turned ones.
constexpr double kNoCoupling = 1e-6;

/// The same for constants of five digits, whose axes had to be found.
constexpr double kFiveDigits = 1e-4;

fem::MaterialSpec& current(AbaqusReading& in, const DeckKeyword& keyword) {
  if (in.material != nullptr) return *in.material;
  in.lines.fail(keyword.place, fmt::format("{} belongs below a *MATERIAL", keyword.written));
}

/// The constants of the first temperature, over as many lines as they need.
std::vector<double> first_constants(AbaqusReading& in, const DeckKeyword& keyword,
                                    std::size_t count) {
  std::vector<double> out;
  DeckRow row;
  while (out.size() < count) {
    if (!in.lines.next_row(row)) {
      in.lines.fail(keyword.place, fmt::format("{}: expected {} constants, found {}",
                                               keyword.written, count, out.size()));
    }
    for (std::size_t i = 0; i < row.cells.size() && out.size() < count; ++i) {
      out.push_back(in.lines.number(row, i, "constant of the material"));
    }
    // Eight values fill a line; anything else after them is the temperature.
    if (row.cells.size() < 8 && out.size() < count) {
      in.lines.fail(row.place, fmt::format("{}: expected {} constants, found {}", keyword.written,
                                           count, out.size()));
    }
  }
  if (in.lines.next_row(row)) {
    in.note(keyword.place,
            fmt::format("{}: values for several temperatures or fields; the first one is used",
                        keyword.written));
  }
  return out;
}

fem::OrthotropicSpec engineering(const std::vector<double>& v) {
  fem::OrthotropicSpec out;
  out.E1 = v[0];
  out.E2 = v[1];
  out.E3 = v[2];
  out.nu12 = v[3];
  out.nu13 = v[4];
  out.nu23 = v[5];
  out.G12 = v[6];
  out.G13 = v[7];
  out.G23 = v[8];
  return out;
}

/// D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323.
StiffnessMatrix nine_stiffnesses(const std::vector<double>& v) {
  StiffnessMatrix C = StiffnessMatrix::Zero();
  C.topLeftCorner<3, 3>() << v[0], v[1], v[3], v[1], v[2], v[4], v[3], v[4], v[5];
  C.diagonal().tail<3>() << v[6], v[8], v[7];
  return C;
}

fem::OrthotropicSpec constants_of(AbaqusReading& in, const DeckKeyword& keyword,
                                  const StiffnessMatrix& C) {
  if (const auto out = orthotropic_constants(C)) return *out;
  in.lines.fail(keyword.place,
                fmt::format("the stiffnesses of {} are not positive definite; check their order",
                            keyword.written));
}

/// The 21 constants: the upper triangle column by column, in the order 11, 22, 33, 12, 13, 23.
StiffnessMatrix all_stiffnesses(const std::vector<double>& v) {
  constexpr std::array<int, 6> kPlace = {0, 1, 2, 3, 5, 4};
  StiffnessMatrix C;
  std::size_t next = 0;
  for (std::size_t column = 0; column < 6; ++column) {
    for (std::size_t row = 0; row <= column; ++row, ++next) {
      C(kPlace[row], kPlace[column]) = C(kPlace[column], kPlace[row]) = v[next];
    }
  }
  return C;
}

/// The nine constants of an anisotropic material with three planes of symmetry; where these are
/// turned from the axes of the 21 constants, its directions are theirs.
fem::OrthotropicSpec from_all_stiffnesses(AbaqusReading& in, const DeckKeyword& keyword,
                                          const std::vector<double>& v, const std::string& name) {
  StiffnessMatrix C = all_stiffnesses(v);
  std::optional<Eigen::Matrix3d> axes;
  if (!(coupling_of(C) <= kNoCoupling)) {
    axes = symmetry_axes(C, kFiveDigits);
    if (!axes) {
      in.lines.fail(
          keyword.place,
          fmt::format(
              "*ELASTIC of TYPE=ANISOTROPIC: material \"{}\" couples stretch and shear in all axes "
              "(in those given, by {:.2g} of its largest constant); only materials with three "
              "planes of symmetry, in any orientation, are supported. Remove the coupling terms, "
              "or give another material in the model file: materials: {{\"{}\": …}}",
              name, coupling_of(C), name));
    }
    C = in_axes(C, *axes);
    in.note(keyword.place,
            "*ELASTIC of TYPE=ANISOTROPIC: the coupling of stretch and shear vanishes in other "
            "axes; the material is taken as orthotropic in those axes");
  }
  fem::OrthotropicSpec out = constants_of(in, keyword, C);
  if (axes) {
    out.axis_1 = axes->col(0);
    out.axis_2 = axes->col(1);
  }
  return out;
}

/// E1, E2, ν12, G12, G13, G23 of a plane state of stress. Shells do not ask for what is across: it
/// has the modulus of direction 2 and does not contract.
fem::OrthotropicSpec lamina(const std::vector<double>& v) {
  return engineering({v[0], v[1], v[1], v[2], 0.0, 0.0, v[3], v[4], v[5]});
}

}  // namespace

void read_material(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string& name = in.parameter(keyword, "NAME");
  fem::MaterialSpec& material = in.deck.materials[upper(name)];
  if (!material.name.empty()) {
    in.lines.fail(keyword.place, fmt::format("material \"{}\" is defined twice, first at {}", name,
                                             material.where.text()));
  }
  material.name = name;
  material.where = in.lines.where(keyword.place);
  in.material = &material;
}

void read_elastic(AbaqusReading& in, const DeckKeyword& keyword) {
  fem::MaterialSpec& material = current(in, keyword);
  std::string type = upper(in.optional_parameter(keyword, "TYPE"));
  std::erase(type, ' ');
  if (type.empty() || type == "ISOTROPIC" || type == "ISO") {
    const auto v = first_constants(in, keyword, 2);
    material.E = v[0];
    material.nu = v[1];
    if (material.E > 0.0 && material.nu > -1.0 && material.nu <= 0.5) return;
    in.lines.fail(keyword.place, fmt::format("material \"{}\" has E = {:g} and nu = {:g}; E must "
                                             "be positive, and nu must lie between -1 and 0.5",
                                             material.name, material.E, material.nu));
  }
  if (type == "ENGINEERINGCONSTANTS") {
    material.orthotropic = engineering(first_constants(in, keyword, 9));
  } else if (type == "ORTHOTROPIC" || type == "ORTHO") {
    material.orthotropic =
        constants_of(in, keyword, nine_stiffnesses(first_constants(in, keyword, 9)));
  } else if (type == "ANISOTROPIC" || type == "ANISO") {
    material.orthotropic =
        from_all_stiffnesses(in, keyword, first_constants(in, keyword, 21), material.name);
    const bool is_turned = material.orthotropic->axis_1 != Eigen::Vector3d::UnitX() ||
                           material.orthotropic->axis_2 != Eigen::Vector3d::UnitY();
    if (is_turned) in.deck.turned_materials.insert(upper(material.name));
  } else if (type == "LAMINA") {
    material.orthotropic = lamina(first_constants(in, keyword, 6));
    in.deck.laminae.insert(upper(material.name));
  } else {
    in.lines.fail(keyword.place,
                  fmt::format("*ELASTIC of TYPE={} is not supported; ISOTROPIC, ENGINEERING "
                              "CONSTANTS, ORTHOTROPIC, ANISOTROPIC and LAMINA are",
                              type));
  }
  material.orthotropic->where = in.lines.where(keyword.place);
}

void read_density(AbaqusReading& in, const DeckKeyword& keyword) {
  fem::MaterialSpec& material = current(in, keyword);
  material.rho = first_constants(in, keyword, 1)[0];
  if (material.rho >= 0.0) return;
  in.lines.fail(keyword.place, fmt::format("the density {:g} of material \"{}\" is negative",
                                           material.rho, material.name));
}

void read_damping(AbaqusReading& in, const DeckKeyword& keyword) {
  fem::MaterialSpec& material = current(in, keyword);
  fem::DampingSpec damping;
  damping.where = in.lines.where(keyword.place);
  for (const auto& parameter : keyword.parameters) {
    if (parameter.key != "ALPHA" && parameter.key != "BETA") {
      in.note(keyword.place,
              fmt::format("*DAMPING, {}: only ALPHA and BETA are taken over", parameter.key));
      continue;
    }
    const auto value = files::deck_number(parameter.value);
    if (!value || *value < 0.0) {
      in.lines.fail(keyword.place, fmt::format("{}={}: expected a number that is not negative",
                                               parameter.key, parameter.value));
    }
    (parameter.key == "ALPHA" ? damping.mass : damping.stiffness) = *value;
  }
  if (damping.mass != 0.0 || damping.stiffness != 0.0) material.damping = damping;
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
// Shells of NastranProperties: PSHELL, PCOMP, PCOMPG and what elements add to them.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/properties.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

bool differs(double a, double b) { return std::abs(a - b) > 1e-6 * (std::abs(a) + std::abs(b)); }

/// Equal directions must have equal keys in spite of rounding.
std::array<double, 3> rounded(const Vector3d& direction) {
  std::array<double, 3> out;
  for (int i = 0; i < 3; ++i) {
    out[static_cast<std::size_t>(i)] = std::round(direction[i] * 1e6) * 1e-6 + 0.0;
  }
  return out;
}

/// Shells take no direction closer to their normal: sine of the angle.
constexpr double kAlongNormal = 2e-3;

/// Bending stiffness of a linear thickness with this difference, as a share of its mean, is that of
/// the mean but for 2.5e-5: nothing to tell.
constexpr double kAlike = 0.01;

/// Of a quantity that is linear between three corners or bilinear between four.
double mean_over_area(const std::vector<double>& values, const std::vector<Vector3d>& x) {
  if (x.size() == 3) return (values[0] + values[1] + values[2]) / 3.0;
  const double g = 1.0 / std::sqrt(3.0);
  double sum = 0, area = 0;
  for (const double r : {-g, g}) {
    for (const double s : {-g, g}) {
      const std::array<double, 4> N = {0.25 * (1 - r) * (1 - s), 0.25 * (1 + r) * (1 - s),
                                       0.25 * (1 + r) * (1 + s), 0.25 * (1 - r) * (1 + s)};
      const Vector3d along = 0.25 * ((1 - s) * (x[1] - x[0]) + (1 + s) * (x[2] - x[3]));
      const Vector3d across = 0.25 * ((1 - r) * (x[3] - x[0]) + (1 + r) * (x[2] - x[1]));
      const double dA = along.cross(across).norm();
      area += dA;
      for (std::size_t i = 0; i < 4; ++i) sum += N[i] * values[i] * dA;
    }
  }
  return area > 0 ? sum / area : std::accumulate(values.begin(), values.end(), 0.0) / 4.0;
}

/// Turns the layers of a shell about its normal; a shell of one material becomes a layer of it.
void turn_layers(fem::ImportedProperty& property, double angle) {
  if (angle == 0.0) return;
  if (property.layers.empty()) {
    property.layers.push_back({"", property.thickness.value_or(0.0), 0.0});
    property.thickness.reset();
  }
  for (fem::ImportedLayer& layer : property.layers) layer.angle += angle;
}

}  // namespace

NastranProperties::Shell NastranProperties::convert_pshell(const NastranCard& card) {
  const NastranPlace place{card.file, card.line};
  Shell out;
  if (card.blank(1) && card.blank(3)) card.fail("MID1 and MID2 are blank; there is no material");
  const int material_field = card.blank(1) ? 3 : 1;
  const std::int64_t material = card.id(material_field);
  if (card.blank(1)) {
    notes_->add("PSHELL: MID1 is blank (no membrane stiffness); taken as a full shell of MID2",
                place);
  }
  if (card.blank(3)) {
    notes_->add("PSHELL: MID2 is blank (no bending stiffness); taken as a full shell of MID1",
                place);
  } else if (card.integer(3) == -1) {
    card.fail(3, fmt::format("MID2 = -1: in plane strain the element is a slice of a long body and "
                             "cannot be part of a three-dimensional one; write MID2 = {} for a "
                             "shell of this thickness, or model the part with solids",
                             material));
  } else if (card.id(3) != material) {
    notes_->add("PSHELL: MID2 differs from MID1; MID1 is used for bending, too", place);
  }
  if (!card.blank(10)) {
    card.fail(10, fmt::format("MID4 = {}: coupling of membrane and bending by a matrix is not "
                              "supported; give the layers that couple them as PCOMP, or leave MID4 "
                              "blank if the shell is symmetric",
                              card.text(10)));
  }
  if (differs(card.real(4, 1.0), 1.0)) {
    notes_->add(
        "PSHELL: 12I/T**3 other than 1 is left out; the bending stiffness is that of a solid "
        "section",
        place);
  }
  if (std::abs(card.real(6, 0.833333) - 0.833333) > 1e-4) {
    notes_->add("PSHELL: TS/T other than 5/6 is left out", place);
  }
  set_material(material, NastranMaterials::Use::shell, card, out.property);
  out.has_directions = materials_->has_directions(material);
  if (!card.blank(2)) out.property.thickness = card.positive(2);
  out.mass = card.real(7, 0.0);
  return out;
}

/// Shells of NASTRAN-95. PQUAD1 and PTRIA1 have MID1, T1, MID2, I2, MID3, T3, NSM, the others MID,
/// T and NSM.
NastranProperties::Shell NastranProperties::convert_old_shell(const NastranCard& card) {
  Shell out;
  const bool is_general = card.name == "PQUAD1" || card.name == "PTRIA1";
  const bool has_membrane = !card.blank(1) && card.real(2, 0.0) > 0;
  const double bending = is_general ? card.real(4, 0.0) : 0.0;
  if (is_general && !has_membrane && !(bending > 0)) card.fail("there is neither T1 nor I2");
  const bool is_plate = is_general && !has_membrane;
  const double thickness = is_plate ? std::cbrt(12.0 * bending) : card.positive(2);
  set_material(card.id(is_plate ? 3 : 1), NastranMaterials::Use::shell, card, out.property);
  out.property.thickness = thickness;
  out.mass = card.real(is_general ? 7 : 3, 0.0);
  if (is_general && (is_plate || differs(bending, std::pow(thickness, 3) / 12.0))) {
    notes_->add(card.name +
                    ": T1 and I2 are not those of one full section; it is taken as one of " +
                    (is_plate ? "the bending stiffness I2" : "the thickness T1"),
                {card.file, card.line});
  }
  return out;
}

std::vector<fem::ImportedLayer> NastranProperties::read_layers(const NastranCard& card,
                                                               bool& is_isotropic) {
  const NastranPlace place{card.file, card.line};
  const bool is_global = card.name == "PCOMPG";
  const int stride = is_global ? 8 : 4;
  std::vector<fem::ImportedLayer> layers;
  for (int field = 8; field < card.size(); field += stride) {
    const int first = is_global ? field + 1 : field;
    // A layer is there if any of its fields is: material, thickness, angle, SOUT.
    bool is_there = false;
    for (int i = 0; i < 4; ++i) is_there = is_there || !card.blank(first + i);
    if (!is_there) continue;
    if (layers.empty() && (card.blank(first) || card.blank(first + 1))) {
      card.fail(first, "the first layer needs a material and a thickness");
    }
    fem::ImportedLayer layer = layers.empty() ? fem::ImportedLayer{} : layers.back();
    if (!card.blank(first)) {
      const std::int64_t material = card.id(first);
      const std::string lack =
          materials_->lack(material, NastranMaterials::Use::shell, card.label());
      if (!lack.empty()) throw InputError(place.where(), lack);
      is_isotropic = is_isotropic && !materials_->has_directions(material);
      layer.material =
          materials_->name(material, NastranMaterials::Use::shell, card.label(), place);
    }
    if (!card.blank(first + 1)) layer.thickness = card.positive(first + 1);
    layer.angle = card.real(first + 2, 0.0) * kDegree;
    layers.push_back(layer);
  }
  if (layers.empty()) card.fail("there are no layers");
  return layers;
}

NastranProperties::Shell NastranProperties::convert_pcomp(const NastranCard& card) {
  Shell out;
  out.is_isotropic = true;
  std::vector<fem::ImportedLayer> layers = read_layers(card, out.is_isotropic);
  const std::string lay_up = card.word(7);
  if (lay_up == "SYM") {
    // Half of it is written, from the bottom to the middle.
    layers.reserve(2 * layers.size());
    for (std::size_t i = layers.size(); i-- > 0;) layers.push_back(layers[i]);
  } else if (!lay_up.empty()) {
    card.fail(7, fmt::format("LAM = {} is not supported; blank and SYM are", lay_up));
  }
  const double thickness = std::accumulate(
      layers.begin(), layers.end(), 0.0,
      [](double sum, const fem::ImportedLayer& layer) { return sum + layer.thickness; });
  out.property.offset = card.real(1, -0.5 * thickness) + 0.5 * thickness;
  out.property.layers = std::move(layers);
  out.mass = card.real(2, 0.0);
  out.has_directions = true;
  if (card.real(6, 0.0) != 0.0) {
    notes_->add(card.name +
                    ": structural damping GE is left out; give `damping` of a material in "
                    "the model file",
                {card.file, card.line});
  }
  return out;
}

/// The mean over the area where corners have thicknesses of their own: with it the mass is right.
double NastranProperties::thickness_of(const NastranElement& element, const Shell& shell,
                                       const std::vector<Vector3d>& nodes) {
  const std::optional<double>& general = shell.property.thickness;
  const auto fail = [&](const std::string& text) {
    throw InputError(element.place.where(),
                     fmt::format("{} {}: {}", name_of(element.kind), element.id, text));
  };
  if (!shell.property.layers.empty()) return 0.0;
  static const NastranShellDetails none;
  const NastranShellDetails& details =
      element.details < 0 ? none : bulk_->shells[static_cast<std::size_t>(element.details)];
  std::vector<double> corners;
  for (const std::optional<double>& own : details.thickness) {
    if (!general && (!own || details.relative)) {
      fail(details.relative ? "TFLAG = 1 needs a thickness T of the PSHELL"
                            : "one of T1, T2, … is blank and its PSHELL gives no thickness");
    }
    corners.push_back(!own ? *general : (details.relative ? *own * *general : *own));
  }
  if (corners.empty()) {
    if (!general) fail("neither the element nor its PSHELL gives a thickness");
    return *general;
  }
  const double mean = mean_over_area(corners, nodes);
  if (!(mean > 0.0)) fail("the thickness must be greater than zero");
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  if (*most - *least > kAlike * mean) {
    notes_->add(
        fmt::format("{}: thicknesses T1, T2, ... that differ by more than 1 % are taken as their "
                    "mean over the area: the mass is exact, the bending stiffness slightly too low",
                    name_of(element.kind)),
        element.place);
  }
  return mean;
}

/// Without MCID the direction is that of the first side, turned by THETA: curved shells have one
/// property then, not one per element. An axis along the normal is no direction, but isotropic
/// layers need none.
NastranProperties::Direction NastranProperties::shell_direction(
    const NastranElement& element, const Shell& shell, const std::vector<Vector3d>& nodes) const {
  if (element.details < 0) return {};
  const NastranShellDetails& details = bulk_->shells[static_cast<std::size_t>(element.details)];
  if (!details.has_system) return {std::nullopt, details.theta * kDegree};
  Vector3d centre = Vector3d::Zero();
  for (const Vector3d& node : nodes) centre += node / static_cast<double>(nodes.size());
  const Matrix3d system = coordinates_->axes_at(details.system, centre, element.place);
  // Diagonals of four corners, sides of three.
  const std::size_t last = nodes.size() - 1;
  const Vector3d n = (nodes[2] - nodes[0]).cross(nodes[last] - nodes[1]).normalized();
  const Vector3d flat = system.col(0) - system.col(0).dot(n) * n;
  if (n.norm() > 0 && !(flat.norm() > kAlongNormal)) {
    if (!shell.is_isotropic) {
      throw InputError(
          element.place.where(),
          fmt::format("{} {}: the x axis of MCID {}, from which the material directions are "
                      "measured, is parallel to its normal; give another system, or THETA",
                      name_of(element.kind), element.id, details.system));
    }
    notes_->add(
        fmt::format("{}: MCID along the normal is left out, which changes nothing since all "
                    "layers are isotropic",
                    name_of(element.kind)),
        element.place);
    return {};
  }
  if (coordinates_->is_rectangular(details.system, element.place)) return {system, 0.0};
  if (!(n.norm() > 0)) {
    throw InputError(element.place.where(),
                     fmt::format("{} {}: it has no area", name_of(element.kind), element.id));
  }
  Matrix3d axes;
  axes.col(0) = flat.normalized();
  axes.col(1) = n.cross(axes.col(0));
  axes.col(2) = n;
  return {axes, 0.0};
}

int NastranProperties::shell(const NastranElement& element, const std::vector<Vector3d>& nodes) {
  const NastranCard* const found_card = card_of(element, Family::shell);
  if (found_card == nullptr) return missing(element, Family::shell);
  const NastranCard& card = *found_card;
  auto found = shells_.find(&card);
  if (found == shells_.end()) {
    Shell shell = card.name == "PSHELL"              ? convert_pshell(card)
                  : element.property_card != nullptr ? convert_old_shell(card)
                                                     : convert_pcomp(card);
    if (shell.mass < 0) card.fail("the non-structural mass NSM is negative");
    shell.property.name = name_of_card(card);
    shell.property.kind = fem::PropertyKind::shell;
    shell.property.along_first_side = true;
    shell.property.line = card.line;
    found = shells_.emplace(&card, std::move(shell)).first;
  }
  const Shell& general = found->second;
  const double thickness = thickness_of(element, general, nodes);
  const double offset =
      element.details < 0 ? 0.0 : bulk_->shells[static_cast<std::size_t>(element.details)].offset;
  Direction direction;
  if (general.has_directions) direction = shell_direction(element, general, nodes);
  std::array<double, 3> axis = {0, 0, 0};
  if (direction.axes) axis = rounded(direction.axes->col(0));
  const auto [entry, is_new] =
      shell_variants_.try_emplace(ShellKey{&card, thickness, offset, axis, direction.angle}, 0);
  if (is_new) {
    fem::ImportedProperty property = general.property;
    if (property.layers.empty()) property.thickness = thickness;
    property.offset += offset;
    property.axes = direction.axes;
    turn_layers(property, direction.angle);
    entry->second = add(std::move(property), {general.mass, 0.0});
  }
  return entry->second;
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/sections.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/mesh_io/box_section.h"
#include "buckens/mesh_io/nastran/number.h"
#include "buckens/mesh_io/nastran/section_shapes.h"

namespace buckens::mesh_io {

namespace {

/// A shear factor that makes shear deformation vanish where a card has it in the other plane only.
constexpr double kShearRigid = 1e6;

constexpr const char* kNeutralAxisNote =
    "beams whose neutral axis is not at the shear centre are placed on the neutral axis, about "
    "which they also twist";

/// A, I1, I2, I12, J and NSM in the axes of Nastran.
struct Constants {
  double A = 0, I1 = 0, I2 = 0, I12 = 0, J = 0, mass = 0;

  Constants& add(double factor, const Constants& other) {
    A += factor * other.A;
    I1 += factor * other.I1;
    I2 += factor * other.I2;
    I12 += factor * other.I12;
    J += factor * other.J;
    mass += factor * other.mass;
    return *this;
  }
};

std::vector<std::array<double, 2>> read_stress_points(const NastranCard& card, int first) {
  std::vector<std::array<double, 2>> out;
  bool any = false;
  for (int i = 0; i < 4; ++i) {
    out.push_back({card.real(first + 2 * i, 0.0), card.real(first + 2 * i + 1, 0.0)});
    any = any || out.back() != std::array<double, 2>{0.0, 0.0};
  }
  if (!any) out.clear();
  return out;
}

/// Whether the constants are those of a beam. Those of a bar with an area alone are taken, others
/// left to the model file.
bool is_beam_section(const NastranCard& card, const Constants& c, NastranSection& out) {
  if (!(c.A > 0.0)) {
    out.lacking = fmt::format("{}: the area {:g} is not positive", card.label(), c.A);
  } else if (c.I1 == 0.0 && c.I2 == 0.0 && c.J == 0.0) {
    out.is_bar = true;
    out.section.shape = fem::CircleSpec{2.0 * std::sqrt(c.A / std::numbers::pi)};
  } else if (!(c.I1 > 0.0 && c.I2 > 0.0 && c.J > 0.0)) {
    out.lacking = fmt::format(
        "{}: I1 = {:g}, I2 = {:g}, J = {:g}, so that the beam would not "
        "resist bending or torsion",
        card.label(), c.I1, c.I2, c.J);
  } else if (!(c.I1 * c.I2 > c.I12 * c.I12)) {
    out.lacking = fmt::format("{}: I12 = {:g} is too large for I1 = {:g} and I2 = {:g}",
                              card.label(), c.I12, c.I1, c.I2);
  }
  return out.lacking.empty() && !out.is_bar;
}

/// A general section in its principal axes.
void set_general(const NastranCard& card, const Constants& c, double K1, double K2,
                 std::vector<std::array<double, 2>> points, NastranSection& out) {
  if (!is_beam_section(card, c, out)) return;
  fem::GeneralSectionSpec section;
  section.A = c.A;
  section.J = c.J;
  const double mean = 0.5 * (c.I1 + c.I2), half = 0.5 * (c.I1 - c.I2);
  if (c.I12 == 0.0) {
    section.Iz = c.I1;
    section.Iy = c.I2;
  } else {
    out.angle = 0.5 * std::atan2(c.I12, half);
    const double radius = std::hypot(half, c.I12);
    section.Iz = mean + radius;
    section.Iy = mean - radius;
  }
  for (const double value : {c.A, c.J, section.Iy, section.Iz}) {
    if (value > 0.0 && std::isfinite(value)) continue;
    card.fail(
        fmt::format("the section is not possible: A = {:g}, I1 = {:g}, I2 = {:g}, I12 = {:g}, "
                    "J = {:g}",
                    c.A, c.I1, c.I2, c.I12, c.J));
  }
  out.shear_flexible = K1 > 0.0 || K2 > 0.0;
  if (out.shear_flexible) {
    section.shear_factor_y = K1 > 0.0 ? K1 : kShearRigid;
    section.shear_factor_z = K2 > 0.0 ? K2 : kShearRigid;
  }
  const double cosine = std::cos(out.angle), sine = std::sin(out.angle);
  for (auto& [y, z] : points) {
    const std::array<double, 2> turned = {cosine * y + sine * z, cosine * z - sine * y};
    y = turned[0];
    z = turned[1];
  }
  section.stress_points = std::move(points);
  out.section.shape = section;
}

void read_pbar(const NastranCard& card, NastranSection& out) {
  Constants c{card.real(2, 0.0), card.real(3, 0.0), card.real(4, 0.0), 0.0,
              card.real(5, 0.0), card.real(6, 0.0)};
  const double K1 = card.real(16, 0.0), K2 = card.real(17, 0.0);
  c.I12 = card.real(18, 0.0);
  out.mass_per_length = c.mass;
  set_general(card, c, K1, K2, read_stress_points(card, 8), out);
}

/// A cross-section at a place along a beam.
struct Station {
  double x = 0;  ///< 0 at end A, 1 at end B
  Constants constants;
};

bool is_station(const NastranCard& card, int field) {
  const std::string word = card.word(field);
  return word == "YES" || word == "YESA" || word == "NO";
}

/// Mean over the length, linear between stations.
Constants mean_of(std::vector<Station> stations) {
  std::stable_sort(stations.begin(), stations.end(),
                   [](const Station& a, const Station& b) { return a.x < b.x; });
  if (stations.back().x < 1.0) stations.push_back({1.0, stations.back().constants});
  Constants mean;
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const double half = 0.5 * (stations[i].x - stations[i - 1].x);
    mean.add(half, stations[i].constants).add(half, stations[i - 1].constants);
  }
  return mean;
}

/// Stations beyond end A; sets `field` behind them.
void read_stations(const NastranCard& card, int& field, std::vector<Station>& stations) {
  const Constants first = stations[0].constants;
  while (is_station(card, field)) {
    Station station;
    station.x = card.real(field + 1, 1.0);
    if (!(station.x > 0.0 && station.x <= 1.0)) {
      card.fail(field + 1, fmt::format("X/XB = {:g} must lie between 0 and 1", station.x));
    }
    Constants& c = station.constants;
    c = {card.real(field + 2, first.A),  card.real(field + 3, first.I1),
         card.real(field + 4, first.I2), card.real(field + 5, first.I12),
         card.real(field + 6, first.J),  card.real(field + 7, first.mass)};
    // Zero at end B stands for the value at end A.
    if (c.A == 0.0) c.A = first.A;
    stations.push_back(station);
    field += card.word(field) == "YES" ? 16 : 8;
  }
}

/// The two lines at the end of a PBEAM: shear factors, warping, offsets of masses and neutral axes.
void read_pbeam_end(const NastranCard& card, int field, NastranNotes& notes, NastranSection& out) {
  const auto any = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      if (card.real(field + i, 0.0) != 0.0) return true;
    }
    return false;
  };
  const NastranPlace place{card.file, card.line};
  if (any(12, 16)) {
    // N1 and N2 at end A and at end B, where blank stands for end A.
    for (int i = 0; i < 2; ++i) {
      const double a = card.real(field + 12 + i, 0.0);
      out.offset[static_cast<std::size_t>(i)] = 0.5 * (a + card.real(field + 14 + i, a));
    }
    notes.add(kNeutralAxisNote, place);
  }
  if (any(2, 4)) notes.add("PBEAM: shear relief S1, S2 is left out", place);
  if (any(4, 8)) notes.add("PBEAM: NSI and warping CW are left out", place);
  if (any(8, 12)) notes.add("PBEAM: offsets M1, M2 of the non-structural mass are left out", place);
}

void read_pbeam(const NastranCard& card, NastranNotes& notes, NastranSection& out) {
  std::vector<Station> stations(1);
  stations[0].constants = {card.real(2, 0.0), card.real(3, 0.0), card.real(4, 0.0),
                           card.real(5, 0.0), card.real(6, 0.0), card.real(7, 0.0)};
  int field = 8;
  std::vector<std::array<double, 2>> points;
  if (!is_station(card, field)) {
    points = read_stress_points(card, field);
    field += 8;
  }
  read_stations(card, field, stations);
  read_pbeam_end(card, field, notes, out);
  const Constants mean = mean_of(stations);
  const Constants& first = stations[0].constants;
  for (const double difference : {mean.A - first.A, mean.I1 - first.I1, mean.I2 - first.I2}) {
    if (std::abs(difference) <= 1e-9 * std::max(first.A, std::max(first.I1, first.I2))) continue;
    notes.add("PBEAM: tapered beams get the mean of the section along the beam",
              {card.file, card.line});
    break;
  }
  out.mass_per_length = mean.mass;
  set_general(card, mean, card.real(field, 1.0), card.real(field + 1, 1.0), std::move(points), out);
}

/// DIM1 lies along z, DIM2 along y of Nastran's element axes; DIM3 are the walls along z, DIM4
/// those along y.
void set_box(const NastranCard& card, const std::vector<double>& dim, NastranSection& out) {
  const BoxWalls box{dim[1], dim[0], dim[2], dim[3]};
  if (!(2 * box.side < box.width && 2 * box.flat < box.height)) {
    card.fail("the walls of the BOX fill it");
  }
  out.section.shape = box_section(box).shape;
}

void set_tube(const NastranCard& card, double outer, double inner, NastranSection& out) {
  if (!(inner >= 0.0 && inner < outer)) {
    card.fail(
        fmt::format("the inner radius {:g} of the tube must be smaller than the outer one, "
                    "{:g}",
                    inner, outer));
  }
  if (inner == 0.0) {
    out.section.shape = fem::CircleSpec{2.0 * outer};
  } else {
    out.section.shape = fem::TubeSpec{2.0 * outer, std::nullopt, 2.0 * inner};
  }
}

void set_shape(const NastranCard& card, const std::string& type, const std::vector<double>& dim,
               NastranNotes& notes, NastranSection& out) {
  out.shear_flexible = true;
  if (type == "ROD") {
    out.section.shape = fem::CircleSpec{2.0 * dim[0]};
  } else if (type == "BAR") {
    out.section.shape = fem::RectangleSpec{dim[1], dim[0]};
  } else if (type == "BOX") {
    set_box(card, dim, out);
  } else if (type == "TUBE") {
    set_tube(card, dim[0], dim[1], out);
  } else if (type == "TUBE2") {
    set_tube(card, dim[0], dim[0] - dim[1], out);
  } else {
    const NastranShapeConstants c = nastran_shape(type, dim);
    if (!(c.A > 0))
      card.fail(fmt::format("the plates of the section {} do not fit together", type));
    set_general(card, {c.A, c.I1, c.I2, c.I12, c.J, 0.0}, c.K1, c.K2, c.corners, out);
    if (card.name != "PBEAML" || (c.y == 0.0 && c.z == 0.0)) return;
    out.offset = {c.y, c.z};
    notes.add(kNeutralAxisNote, {card.file, card.line});
  }
}

int num_dimensions(const std::string& type) {
  if (type == "ROD") return 1;
  if (type == "TUBE" || type == "TUBE2" || type == "BAR") return 2;
  return type == "BOX" ? 4 : num_nastran_shape_dimensions(type);
}

/// PBARL and PBEAML: a shape by name and its dimensions, the latter perhaps at several stations.
void read_shape(const NastranCard& card, NastranNotes& notes, NastranSection& out) {
  const std::string type = card.word(3);
  const int count = num_dimensions(type);
  if (count == 0) {
    out.lacking = fmt::format("{}: sections of type {} are not supported", card.label(),
                              quoted_excerpt(type));
    return;
  }
  std::vector<double> dim(static_cast<std::size_t>(count));
  const auto read = [&](int first, std::vector<double>& to) {
    for (int i = 0; i < count; ++i) {
      const bool may_be_zero = type == "TUBE" && i == 1;
      double& value = to[static_cast<std::size_t>(i)];
      if (!card.blank(first + i) || first == 8) {
        value = may_be_zero ? card.real(first + i) : card.positive(first + i);
      }
    }
  };
  read(8, dim);
  out.mass_per_length = card.real(8 + count, 0.0);
  std::vector<double> last = dim;
  int field = 9 + count;
  // SO and X/XB of further stations may be blank, "YES" and 1 by default.
  for (; card.name == "PBEAML" && field < card.size(); field += count + 3) {
    if (!card.blank(field) && !is_station(card, field)) {
      card.fail(
          field,
          fmt::format(
              "expected SO, YES or NO, found \"{}\"; the section of type {} has {} dimensions",
              card.text(field), type, count));
    }
    last = dim;
    read(field + 2, last);
  }
  if (last != dim) {
    notes.add("PBEAML: tapered beams get the mean of the dimensions at both ends",
              {card.file, card.line});
    for (std::size_t i = 0; i < dim.size(); ++i) dim[i] = 0.5 * (dim[i] + last[i]);
  }
  set_shape(card, type, dim, notes, out);
}

}  // namespace

NastranSection read_nastran_beam_section(const NastranCard& card, NastranNotes& notes) {
  NastranSection out;
  out.material = card.id(1);
  out.section.where = card.where();
  if (card.name == "PBAR") {
    read_pbar(card, out);
  } else if (card.name == "PBEAM") {
    read_pbeam(card, notes, out);
  } else {
    read_shape(card, notes, out);
  }
  if (out.mass_per_length < 0) card.fail("the non-structural mass NSM is negative");
  return out;
}

NastranSection read_nastran_rod_section(const NastranCard& card, NastranNotes& notes) {
  const int first = card.name == "CONROD" ? 3 : 1;  // MID, A, J, C, NSM
  NastranSection out;
  out.material = card.id(first);
  out.section.where = card.where();
  if (card.name == "PTUBE") {  // MID, OD, T, NSM
    const double outer = 0.5 * card.positive(2), wall = card.real(3, 0.0);
    set_tube(card, outer, wall == 0.0 ? 0.0 : outer - wall, out);
    out.mass_per_length = card.real(4, 0.0);
  } else {
    const double A = card.real(first + 1, 0.0);
    if (A > 0.0) {
      // Bars feel the area alone.
      out.section.shape = fem::CircleSpec{2.0 * std::sqrt(A / std::numbers::pi)};
    } else {
      out.lacking = fmt::format("{}: the area {:g} is not positive", card.label(), A);
    }
    out.mass_per_length = card.real(first + 4, 0.0);
  }
  if (card.name != "PTUBE" && card.real(first + 2, 0.0) != 0.0) {
    notes.add(fmt::format("{}: the torsional stiffness J is left out; bars carry axial force only",
                          card.name),
              {card.file, card.line});
  }
  if (out.mass_per_length < 0) card.fail("the non-structural mass NSM is negative");
  return out;
}

}  // namespace buckens::mesh_io

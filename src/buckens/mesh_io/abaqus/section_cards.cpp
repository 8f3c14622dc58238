// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/mesh_io/abaqus/full_section.h"
#include "buckens/mesh_io/box_section.h"
#include "buckens/mesh_io/nastran/section_shapes.h"

namespace buckens::mesh_io {

namespace {

AbaqusSection& add_section(AbaqusReading& in, const DeckKeyword& keyword, fem::PropertyKind kind) {
  AbaqusSection& section = in.scope->sections.emplace_back();
  section.kind = kind;
  section.element_set = in.parameter(keyword, "ELSET");
  section.material = in.optional_parameter(keyword, "MATERIAL");
  section.orientation = in.optional_parameter(keyword, "ORIENTATION");
  section.place = keyword.place;
  return section;
}

/// OFFSET=SPOS, SNEG or a share of the thickness.
double read_offset(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string text = upper(in.optional_parameter(keyword, "OFFSET"));
  if (text.empty()) return 0.0;
  if (text == "SPOS") return 0.5;
  if (text == "SNEG") return -0.5;
  if (const auto value = files::deck_number(text)) return *value;
  in.lines.fail(keyword.place, fmt::format("OFFSET={}: expected SPOS, SNEG or a number (offsets "
                                           "from node to node are not supported)",
                                           text));
}

double positive(AbaqusReading& in, const DeckRow& row, std::size_t i, const char* what) {
  const double value = in.lines.number(row, i, what);
  if (value > 0.0) return value;
  in.lines.fail(row.place, fmt::format("{} is {:g}; it must be positive", what, value));
}

void read_layers(AbaqusReading& in, const DeckKeyword& keyword, AbaqusSection& section) {
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusSection::Layer& layer = section.layers.emplace_back();
    layer.thickness = positive(in, row, 0, "thickness of the layer");
    layer.material = row.cell(2);
    layer.place = row.place;
    if (layer.material.empty()) in.lines.fail(row.place, "the layer has no material (third value)");
    if (const auto angle = files::deck_number(row.cell(3))) {
      layer.angle = *angle * std::numbers::pi / 180.0;
    } else {
      layer.orientation = row.cell(3);
    }
  }
  if (section.layers.empty()) in.lines.fail(section.place, "the laminate has no layers");
  if (!keyword.has("SYMMETRIC")) return;
  // The lower half is written, from the bottom to the middle.
  const std::size_t half = section.layers.size();
  section.layers.reserve(2 * half);
  for (std::size_t k = half; k-- > 0;) section.layers.push_back(section.layers[k]);
}

/// Stiffnesses in place of a thickness.
void refuse_stiffnesses(AbaqusReading& in, const DeckKeyword& keyword) {
  const bool is_general = keyword.name == "SHELLGENERALSECTION";
  if (is_general && !keyword.has("COMPOSITE") && !keyword.has("MATERIAL")) {
    in.lines.fail(keyword.place,
                  "a shell defined by its stiffnesses is not supported; give MATERIAL and a "
                  "thickness, or layers with COMPOSITE");
  }
}

void read_n1(AbaqusReading& in, const DeckRow& row, AbaqusSection& section) {
  section.n1 = read_vector(in.lines, row, 0, "direction n1");
  if (section.n1.norm() == 0.0) in.lines.fail(row.place, "direction n1 cannot be zero");
}

/// OFFSET1 and OFFSET2 of CalculiX: where the nodes lie, seen from the centre of the section, in
/// its measures along directions 1 and 2.
void read_beam_offset(AbaqusReading& in, const DeckKeyword& keyword, AbaqusSection& section) {
  constexpr const char* kKeys[] = {"OFFSET1", "OFFSET2"};
  for (int k = 0; k < 2; ++k) {
    const std::string text = in.optional_parameter(keyword, kKeys[k]);
    if (text.empty()) continue;
    const auto value = files::deck_number(text);
    if (!value) {
      in.lines.fail(keyword.place, fmt::format("{}={}: expected a number of section measures",
                                               kKeys[k], text.substr(0, 40)));
    }
    const double measure = section.measures[k];
    if (*value != 0.0 && measure == 0.0) {
      in.lines.fail(keyword.place,
                    fmt::format("{}={}: offsets need a section of type RECT, CIRC, PIPE or BOX; "
                                "give the beams separate nodes and join them by *MPC, BEAM",
                                kKeys[k], text.substr(0, 40)));
    }
    section.shift[k] -= *value * measure;
  }
}

/// The line of measures, which the nodes' ones overrule and which may be empty, and direction n1.
void read_nodal_measures(AbaqusReading& in, const DeckKeyword& keyword, const std::string& shape,
                         AbaqusSection& section) {
  section.has_nodal_thickness = true;
  section.is_round = shape.starts_with("CIRC");
  if (!section.is_round && !shape.starts_with("RECT")) {
    in.lines.fail(keyword.place, fmt::format("NODAL THICKNESS with SECTION={}: it is for RECT and "
                                             "CIRC; give every other shape a separate section",
                                             shape));
  }
  for (const char* offset : {"OFFSET1", "OFFSET2"}) {
    if (!keyword.has(offset)) continue;
    in.lines.fail(keyword.place, fmt::format("{} with NODAL THICKNESS is not supported; give the "
                                             "beams separate nodes and join them by *MPC, BEAM",
                                             offset));
  }
  DeckRow row;
  if (!in.lines.next_row_or_blank(row)) return;
  if (!row.cell(0).empty()) {
    section.measures[0] = positive(in, row, 0, "first measure of the section");
    section.measures[1] =
        row.cell(1).empty() ? section.measures[0] : positive(in, row, 1, "second measure");
  }
  if (!in.lines.next_row_or_blank(row) || row.cells.empty()) return;
  read_n1(in, row, section);
}

/// Walls on the sides of directions 1, 2, −1 and −2. The nodes are in the centre of the outline.
fem::SectionSpec read_box(AbaqusReading& in, const DeckRow& row, AbaqusSection& section) {
  const double a = positive(in, row, 0, "width of the box");
  const double b = positive(in, row, 1, "height of the box");
  std::array<double, 4> t;
  for (std::size_t k = 0; k < 4; ++k) {
    t[k] = row.cell(2 + k).empty() && k > 0 ? t[0] : positive(in, row, 2 + k, "wall of the box");
  }
  if (t[0] + t[2] >= a || t[1] + t[3] >= b) {
    in.lines.fail(row.place, "the walls are thicker than half the box; use SECTION=RECT");
  }
  if (t[0] == t[2] && t[1] == t[3]) return box_section({a, b, t[0], t[1]});
  UnequalBox box = unequal_box_section(a, b, t);
  section.shift = {box.centroid[0], box.centroid[1]};
  section.turn = box.angle;
  in.note(row.place,
          "SECTION=BOX with unequal walls: beams run through the centroid, offset from their "
          "nodes, and also twist about it, not about the shear centre");
  return std::move(box.section);
}

/// Origin above the bottom, height, widths and thicknesses of the lower and upper flange, web. The
/// height is along direction 2.
fem::SectionSpec read_i_section(AbaqusReading& in, const DeckRow& row) {
  std::array<double, 7> v;
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] = positive(in, row, k, "measure of the I section");
  const auto& [origin, h, b1, b2, t1, t2, web] = v;
  // Numbers of a deck have six digits.
  const auto differ = [height = h](double a, double b) { return std::abs(a - b) > 1e-5 * height; };
  if (differ(b1, b2) || differ(t1, t2) || differ(origin, 0.5 * h)) {
    in.lines.fail(row.place,
                  "an I section needs equal flanges and its origin at half the height, since beams "
                  "run through centroid and shear centre; give others as SECTION=GENERAL");
  }
  const NastranShapeConstants own = nastran_shape("I", {h, b1, b2, web, t1, t2});
  if (!(own.A > 0.0))
    in.lines.fail(row.place, "the flanges of the I section leave no room for a web");
  fem::GeneralSectionSpec shape;
  shape.A = own.A;
  shape.Iy = own.I1;
  shape.Iz = own.I2;
  shape.J = own.J;
  shape.shear_factor_z = own.K1;
  shape.shear_factor_y = own.K2;
  for (const auto& corner : own.corners) shape.stress_points.push_back({corner[1], corner[0]});
  fem::SectionSpec out;
  out.shape = std::move(shape);
  return out;
}

/// A, I11, I12, I22, J.
fem::SectionSpec read_general(AbaqusReading& in, const DeckRow& row) {
  fem::GeneralSectionSpec shape;
  shape.A = positive(in, row, 0, "area of the section");
  shape.Iy = positive(in, row, 1, "I11 of the section");
  shape.Iz = positive(in, row, 3, "I22 of the section");
  shape.J = positive(in, row, 4, "torsion constant of the section");
  if (in.lines.number_or(row, 2, 0.0, "I12 of the section") != 0.0) {
    in.lines.fail(row.place,
                  "I12 must be zero; give the moments about the principal axes and turn "
                  "n1 into the first of them");
  }
  fem::SectionSpec out;
  out.shape = shape;
  return out;
}

/// One value is the radius, as Abaqus has it; two are the diameters of CalculiX.
fem::SectionSpec read_circle(AbaqusReading& in, const DeckRow& row) {
  fem::SectionSpec out;
  const double first = positive(in, row, 0, "measure of the circle");
  if (row.cell(1).empty()) {
    in.note(row.place,
            "SECTION=CIRC: the one value is the radius, as in Abaqus; CalculiX takes it for the "
            "diameter, so write it twice in a deck of CalculiX");
    out.shape = fem::CircleSpec{2.0 * first};
    return out;
  }
  const double second = positive(in, row, 1, "second diameter of the circle");
  in.note(row.place, "SECTION=CIRC: two values are the diameters, as in CalculiX");
  return full_section(true, first, second);
}

/// One value is the side of a square, as CalculiX has it.
fem::RectangleSpec read_rectangle(AbaqusReading& in, const DeckRow& row) {
  const double a = positive(in, row, 0, "width of the rectangle");
  if (!row.cell(1).empty()) return {a, positive(in, row, 1, "height of the rectangle")};
  in.note(row.place, "SECTION=RECT: the one value is the side of a square, as in CalculiX");
  return {a, a};
}

/// The shape on a data line. Direction 1 of the section becomes local y, direction 2 local z.
fem::SectionSpec read_shape(AbaqusReading& in, const std::string& name, const DeckRow& row,
                            AbaqusSection& section) {
  fem::SectionSpec out;
  // CalculiX looks at the first letters only.
  if (name.starts_with("RECT")) {
    out.shape = read_rectangle(in, row);
  } else if (name.starts_with("CIRC")) {
    out = read_circle(in, row);
  } else if (name == "PIPE") {
    const double radius = positive(in, row, 0, "radius of the pipe");
    const double wall = positive(in, row, 1, "wall of the pipe");
    if (wall > radius) in.lines.fail(row.place, "the wall is thicker than the radius");
    if (wall == radius) {
      out.shape = fem::CircleSpec{2.0 * radius};
    } else {
      out.shape = fem::TubeSpec{2.0 * radius, wall, std::nullopt};
    }
  } else if (name == "BOX") {
    out = read_box(in, row, section);
  } else if (name == "I") {
    out = read_i_section(in, row);
  } else if (name == "GENERAL") {
    out = read_general(in, row);
  } else {
    in.lines.fail(row.place, fmt::format("SECTION={} is not supported; RECT, CIRC, PIPE, BOX, I "
                                         "and GENERAL are. Give its constants as SECTION=GENERAL",
                                         name));
  }
  return out;
}

/// Extent of a shape along directions 1 and 2; zero where its data do not tell.
Eigen::Vector2d outer_measures(AbaqusReading& in, const std::string& name, const DeckRow& row) {
  const bool is_round = name.starts_with("CIRC");
  if (name == "PIPE" || (is_round && row.cell(1).empty())) {
    return Eigen::Vector2d::Constant(2.0 * in.lines.number(row, 0, "radius"));
  }
  if (!is_round && !name.starts_with("RECT") && name != "BOX") return Eigen::Vector2d::Zero();
  const double first = in.lines.number(row, 0, "first measure");
  return {first, in.lines.number_or(row, 1, first, "second measure")};
}

/// Shape and, on the next line, direction n1.
void read_shape_rows(AbaqusReading& in, const std::string& name, AbaqusSection& section) {
  DeckRow row;
  if (!in.lines.next_row(row))
    in.lines.fail(section.place, "the dimensions of the section are missing");
  section.shape = read_shape(in, name, row, section);
  section.shape->where = in.lines.where(row.place);
  section.measures = outer_measures(in, name, row);
  if (!in.lines.next_row_or_blank(row) || row.cells.empty()) return;
  read_n1(in, row, section);
}

}  // namespace

void read_solid_section(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSection& section = add_section(in, keyword, fem::PropertyKind::solid);
  if (keyword.has("COMPOSITE")) {
    in.lines.fail(keyword.place,
                  "layered solids are not supported; use one element through each "
                  "layer, or shells with *SHELL SECTION, COMPOSITE");
  }
  DeckRow row;
  if (!in.lines.next_row(row) || row.cell(0).empty()) return;
  section.area = positive(in, row, 0, "area or thickness");
}

void read_shell_section(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSection& section = add_section(in, keyword, fem::PropertyKind::shell);
  section.offset = read_offset(in, keyword);
  refuse_stiffnesses(in, keyword);
  section.thicknesses = in.optional_parameter(keyword, "SHELLTHICKNESS");
  if (keyword.has("COMPOSITE")) {
    if (section.thicknesses.empty()) return read_layers(in, keyword, section);
    in.lines.fail(keyword.place,
                  "layers with SHELL THICKNESS are not supported; give each thickness a section");
  }
  section.has_nodal_thickness = keyword.has("NODALTHICKNESS");
  DeckRow row;
  if (!in.lines.next_row(row)) {
    if (section.has_nodal_thickness || !section.thicknesses.empty()) return;
    in.lines.fail(keyword.place, "the thickness of the shell is missing on the next line");
  }
  section.thickness = positive(in, row, 0, "thickness of the shell");
}

void read_nodal_thickness(AbaqusReading& in, const DeckKeyword& /*keyword*/) {
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusThickness& entry = in.scope->thicknesses.emplace_back();
    entry.reference = row.cell(0);
    entry.thickness = positive(in, row, 1, "thickness at the node");
    entry.second = row.cell(2).empty() ? entry.thickness
                                       : in.lines.number(row, 2, "second thickness at the node");
    entry.place = row.place;
  }
}

void read_beam_section(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSection& section = add_section(in, keyword, fem::PropertyKind::beam);
  const std::string shape = upper(in.parameter(keyword, "SECTION"));
  if (keyword.has("NODALTHICKNESS")) return read_nodal_measures(in, keyword, shape, section);
  read_shape_rows(in, shape, section);
  read_beam_offset(in, keyword, section);
}

void read_beam_general_section(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSection& section = add_section(in, keyword, fem::PropertyKind::beam);
  std::string shape = upper(in.optional_parameter(keyword, "SECTION"));
  if (shape.empty()) shape = "GENERAL";
  read_shape_rows(in, shape, section);
  DeckRow row;
  if (!in.lines.next_row(row)) {
    in.lines.fail(keyword.place, "Young's modulus and shear modulus are missing on the third line");
  }
  fem::MaterialSpec material;
  material.name = "*BEAM GENERAL SECTION " + section.element_set;
  // Sets of two parts may have one name.
  for (int k = 2; in.deck.materials.contains(upper(material.name)); ++k) {
    material.name = fmt::format("*BEAM GENERAL SECTION {} ({})", section.element_set, k);
  }
  material.where = in.lines.where(row.place);
  material.E = positive(in, row, 0, "Young's modulus");
  material.G = positive(in, row, 1, "shear modulus");
  material.nu = material.E / (2.0 * *material.G) - 1.0;
  if (material.nu > 0.5 || material.nu < -1.0) material.nu = 0.0;  // the beam uses E and G only
  if (const std::string density = in.optional_parameter(keyword, "DENSITY"); !density.empty()) {
    const auto value = files::deck_number(density);
    if (!value || *value < 0.0) {
      in.lines.fail(keyword.place, fmt::format("DENSITY={} is not a density", density));
    }
    material.rho = *value;
  }
  section.material = material.name;
  in.deck.materials[upper(material.name)] = material;
}
}  // namespace buckens::mesh_io

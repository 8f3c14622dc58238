// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kMostTerms = 100000;

/// 1 … 6, as an index from 0.
int variable_of(AbaqusReading& in, std::string_view text, DeckPlace place) {
  const auto value = files::deck_integer(text);
  if (value && *value >= 1 && *value <= 6) return static_cast<int>(*value) - 1;
  in.lines.fail(place, fmt::format("\"{}\" is not a degree of freedom of a body; they are 1 to 3 "
                                   "for displacements, 4 to 6 for rotations",
                                   std::string(text.substr(0, 40))));
}

/// Temperatures, pressures and potentials, which no body here has.
bool is_elsewhere(std::string_view text) {
  const auto value = files::deck_integer(text);
  return value && (*value == 0 || (*value > 6 && *value <= 1000));
}

/// Adds first … last degree of freedom; an empty row means all.
void add_variables(AbaqusReading& in, const DeckRow& row, std::size_t first,
                   std::array<bool, 6>& variables) {
  if (row.cell(first).empty()) {
    variables.fill(true);
    return;
  }
  if (is_elsewhere(row.cell(first))) return;
  const int from = variable_of(in, row.cell(first), row.place);
  const int to =
      row.cell(first + 1).empty() ? from : variable_of(in, row.cell(first + 1), row.place);
  if (to < from) {
    in.lines.fail(row.place, fmt::format("the last degree of freedom, {}, precedes the first, {}",
                                         to + 1, from + 1));
  }
  for (int k = from; k <= to; ++k) variables[static_cast<std::size_t>(k)] = true;
}

AbaqusLink& add_link(AbaqusReading& in, AbaqusLinkKind kind, DeckPlace place) {
  AbaqusLink& link = in.scope->links.emplace_back();
  link.kind = kind;
  link.place = place;
  return link;
}

}  // namespace

void read_coupling(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusLink& link = add_link(in, AbaqusLinkKind::kinematic, keyword.place);
  link.name = in.parameter(keyword, "CONSTRAINTNAME");
  link.reference = in.parameter(keyword, "REFNODE");
  link.surfaces.push_back(in.parameter(keyword, "SURFACE"));
  if (const std::string text = in.optional_parameter(keyword, "INFLUENCERADIUS"); !text.empty()) {
    link.radius = files::deck_number(text);
    if (!link.radius || *link.radius <= 0.0) {
      in.lines.fail(keyword.place, fmt::format("INFLUENCE RADIUS={} is not a radius", text));
    }
  }
  link.orientation = in.optional_parameter(keyword, "ORIENTATION");
  in.coupling = &link;
}

namespace {

/// The link of the *COUPLING above, which *KINEMATIC or *DISTRIBUTING completes.
AbaqusLink& take_coupling(AbaqusReading& in, const DeckKeyword& keyword) {
  if (in.coupling == nullptr) {
    in.lines.fail(keyword.place, fmt::format("{} belongs below a *COUPLING", keyword.written));
  }
  return *std::exchange(in.coupling, nullptr);
}

/// The degrees of freedom on the data lines; all if there are none.
void read_coupled_variables(AbaqusReading& in, AbaqusLink& link) {
  DeckRow row;
  bool is_first = true;
  while (in.lines.next_row(row)) {
    if (is_first) link.variables.fill(false);
    is_first = false;
    add_variables(in, row, 0, link.variables);
  }
}

}  // namespace

void read_kinematic(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusLink& link = take_coupling(in, keyword);
  link.kind = AbaqusLinkKind::kinematic;
  read_coupled_variables(in, link);
}

void read_distributing(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusLink& link = take_coupling(in, keyword);
  link.kind = AbaqusLinkKind::distributing;
  read_coupled_variables(in, link);
  // Only rotations can be released.
  std::fill_n(link.variables.begin(), 3, true);
  const std::string weighting = upper(in.optional_parameter(keyword, "WEIGHTINGMETHOD"));
  if (!weighting.empty() && weighting != "UNIFORM") {
    in.note(keyword.place, fmt::format("*DISTRIBUTING, WEIGHTING METHOD={}: nodes are weighted by "
                                       "their area only, not by their distance",
                                       weighting));
  }
  if (upper(in.optional_parameter(keyword, "COUPLING")) == "STRUCTURAL") {
    in.note(
        keyword.place,
        "*DISTRIBUTING, COUPLING=STRUCTURAL: rotations of the nodes do not take part in the mean");
  }
}

void read_kinematic_coupling(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string reference = in.parameter(keyword, "REFNODE");
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusLink& link = add_link(in, AbaqusLinkKind::kinematic, row.place);
    link.reference = reference;
    link.nodes.emplace_back(row.cell(0));
    link.variables.fill(false);
    add_variables(in, row, 1, link.variables);
  }
}

void read_rigid_body(AbaqusReading& in, const DeckKeyword& keyword) {
  if (keyword.has("ANALYTICALSURFACE")) {
    in.note(keyword.place,
            "*RIGID BODY, ANALYTICAL SURFACE is ignored: it serves contact only and has no mass",
            true);
  }
  const std::string reference = in.parameter(keyword, "REFNODE");
  AbaqusLink& link = add_link(in, AbaqusLinkKind::rigid_body, keyword.place);
  link.reference = reference;
  for (const char* key : {"NSET", "TIENSET"}) {
    const std::string name = in.optional_parameter(keyword, key);
    if (!name.empty()) link.node_sets.push_back(name);
  }
  const std::string elements = in.optional_parameter(keyword, "ELSET");
  if (!elements.empty()) link.element_sets.push_back(elements);
  const bool has_none = link.node_sets.empty() && link.element_sets.empty();
  const std::string pinned = in.optional_parameter(keyword, "PINNSET");
  if (has_none && pinned.empty() && keyword.has("ANALYTICALSURFACE")) {
    in.scope->links.pop_back();
    return;
  }
  if (has_none && pinned.empty()) {
    in.lines.fail(keyword.place, "*RIGID BODY needs ELSET, NSET, TIE NSET or PIN NSET");
  }
  if (keyword.has("POSITION")) {
    in.note(keyword.place, "*RIGID BODY, POSITION: the reference node stays where it is");
  }
  if (has_none) in.scope->links.pop_back();
  if (pinned.empty()) return;
  AbaqusLink& pins = add_link(in, AbaqusLinkKind::rigid_body, keyword.place);
  pins.reference = reference;
  pins.node_sets.push_back(pinned);
  pins.variables = {true, true, true, false, false, false};
}

namespace {

/// Nodes that stay in the plane of the first three, or on the line of the first two.
void read_aligned_nodes(AbaqusReading& in, DeckRow row, const std::string& type) {
  AbaqusLink& link = add_link(
      in, type == "PLANE" ? AbaqusLinkKind::mpc_plane : AbaqusLinkKind::mpc_straight, row.place);
  link.name = type;
  for (std::size_t first = 1;; first = 0) {
    for (std::size_t k = first; k < row.cells.size(); ++k) {
      if (!row.cell(k).empty()) link.nodes.emplace_back(row.cell(k));
    }
    if (!row.continues || !in.lines.next_row(row)) return;
  }
}

/// What does not constrain a free body: the mean rotation of nodes, which only a support or a load
/// would use, and distances that are only bounded.
bool pass_over_mpc(AbaqusReading& in, DeckRow& row, const std::string& type) {
  if (type != "MEANROT" && type != "DIST") return false;
  in.note(row.place,
          type == "DIST"
              ? "*MPC, DIST is ignored: a maximum distance is a contact condition, which a body "
                "does not have"
              : "*MPC, MEANROT is ignored: it gives a mean rotation a name for supports and loads, "
                "which come from the model file",
          type == "MEANROT");
  while (row.continues && in.lines.next_row(row)) {
  }
  return true;
}

}  // namespace

void read_tie(AbaqusReading& in, const DeckKeyword& keyword) {
  for (const char* kind : {"CYCLICSYMMETRY", "MULTISTAGE", "FLUIDPERIODIC", "FLUIDCYCLIC"}) {
    if (!keyword.has(kind)) continue;
    return in.note(keyword.place,
                   fmt::format("*TIE, {} is ignored: the body is the sector or stage in the deck, "
                               "with free faces where the next ones adjoin",
                               kind));
  }
  AbaqusTie tie;
  tie.name = in.optional_parameter(keyword, "NAME");
  tie.ties_rotations = !keyword.has("NOROTATION");
  if (const std::string text = in.optional_parameter(keyword, "POSITIONTOLERANCE"); !text.empty()) {
    tie.tolerance = files::deck_number(text);
    if (!tie.tolerance || *tie.tolerance < 0.0) {
      in.lines.fail(keyword.place, fmt::format("POSITION TOLERANCE={} is not a distance", text));
    }
  }
  DeckRow row;
  while (in.lines.next_row(row)) {
    tie.slave = row.cell(0);
    tie.master = row.cell(1);
    tie.place = row.place;
    if (tie.slave.empty() || tie.master.empty()) {
      in.lines.fail(row.place, "a line of *TIE names the slave surface and the master surface");
    }
    in.scope->ties.push_back(tie);
  }
}

/// Of CalculiX: the element set holds one DCOUP3D on the reference node; nodes or sets with weights
/// follow.
void read_distributing_coupling(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusLink& link = add_link(in, AbaqusLinkKind::distributing, keyword.place);
  link.element_sets.push_back(in.parameter(keyword, "ELSET"));
  link.name = link.element_sets.front();
  DeckRow row;
  while (in.lines.next_row(row)) {
    link.nodes.emplace_back(row.cell(0));
    link.weights.push_back(in.lines.number_or(row, 1, 1.0, "weight of the nodes"));
    if (!(link.weights.back() > 0.0)) in.lines.fail(row.place, "a weight must be positive");
  }
  if (link.nodes.empty()) in.lines.fail(keyword.place, "the coupled nodes are missing");
}

void read_mpc(AbaqusReading& in, const DeckKeyword& keyword) {
  if (keyword.has("USER")) {
    in.note(keyword.place, "*MPC, USER: constraints programmed by the user are left out");
    return;
  }
  DeckRow row;
  while (in.lines.next_row(row)) {
    const std::string type = upper(row.cell(0));
    if (type == "PLANE" || type == "STRAIGHT") {
      read_aligned_nodes(in, row, type);
      continue;
    }
    if (pass_over_mpc(in, row, type)) continue;
    AbaqusLinkKind kind = AbaqusLinkKind::mpc_beam;
    if (type == "TIE") {
      kind = AbaqusLinkKind::mpc_tie;
    } else if (type == "PIN") {
      kind = AbaqusLinkKind::mpc_pin;
    } else if (type == "LINK") {
      kind = AbaqusLinkKind::mpc_link;
    } else if (type != "BEAM") {
      in.lines.fail(row.place, fmt::format("*MPC of type \"{}\" is not supported; BEAM, TIE, PIN, "
                                           "LINK, PLANE and STRAIGHT are. Write it as "
                                           "*EQUATION{}",
                                           type.substr(0, 40), SkipList::remedy("MPC")));
    }
    if (kind == AbaqusLinkKind::mpc_beam) {
      in.note(row.place,
              "*MPC, BEAM: a rigid beam, as in Abaqus; CalculiX keeps only the distance, so write "
              "LINK in a deck of CalculiX");
    }
    if (row.cells.size() != 3) {
      in.lines.fail(row.place,
                    fmt::format("expected two nodes or node sets for an *MPC {}, found {}", type,
                                row.cells.size() - 1));
    }
    AbaqusLink& link = add_link(in, kind, row.place);
    link.nodes.emplace_back(row.cell(1));
    link.reference = row.cell(2);
  }
}

void read_spring(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSpring& spring = in.scope->springs.emplace_back();
  spring.element_set = in.parameter(keyword, "ELSET");
  spring.place = keyword.place;
  spring.is_turned = keyword.has("ORIENTATION");
  DeckRow row;
  if (!in.lines.next_row_or_blank(row)) {
    in.lines.fail(keyword.place,
                  "the degrees of freedom and the stiffness of the spring are missing");
  }
  if (row.cells.size() == 1 && !files::deck_integer(row.cell(0))) {
    // Without the empty line that SPRINGA has in place of degrees of freedom.
    spring.stiffness = in.lines.number(row, 0, "stiffness of the spring");
    return;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    // Some decks have zeros where the line may stay empty.
    const std::string_view text = row.cell(k);
    if (!text.empty() && text != "0") spring.variables[k] = variable_of(in, text, row.place);
  }
  if (spring.variables[1] < 0) spring.variables[1] = spring.variables[0];
  if (!in.lines.next_row(row)) {
    in.lines.fail(keyword.place, "the stiffness of the spring is missing on the second line");
  }
  spring.stiffness = in.lines.number(row, 0, "stiffness of the spring");
  if (keyword.has("NONLINEAR")) {
    // Pairs of force and elongation: the slope where it passes zero.
    double force = spring.stiffness, at = in.lines.number(row, 1, "elongation of the spring");
    spring.stiffness = 0;
    for (bool is_there = false; in.lines.next_row(row);) {
      const double next = in.lines.number(row, 0, "force of the spring");
      const double where = in.lines.number(row, 1, "elongation of the spring");
      if (!is_there && where > at) spring.stiffness = (next - force) / (where - at);
      is_there = is_there || where > 0.0;
      force = next;
      at = where;
    }
    in.note(keyword.place, "*SPRING, NONLINEAR: the stiffness at zero elongation is taken");
  }
  if (spring.stiffness >= 0.0) return;
  in.lines.fail(keyword.place,
                fmt::format("the stiffness {:g} of the spring is negative", spring.stiffness));
}

void read_equation(AbaqusReading& in, const DeckKeyword& /*keyword*/) {
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusEquation& equation = in.scope->equations.emplace_back();
    equation.place = row.place;
    bool is_other = false;  // of temperatures or pressures
    const auto count = files::deck_integer(row.cell(0));
    if (!count || *count < 1 || *count > kMostTerms || row.cells.size() != 1) {
      in.lines.fail(row.place, "the number of terms of the equation must be alone on this line");
    }
    while (static_cast<std::int64_t>(equation.terms.size()) < *count) {
      if (!in.lines.next_row(row)) {
        in.lines.fail(equation.place, fmt::format("expected {} terms of the equation, found {}",
                                                  *count, equation.terms.size()));
      }
      for (std::size_t i = 0; i < row.cells.size(); i += 3) {
        AbaqusEquation::Term& term = equation.terms.emplace_back();
        term.reference = row.cell(i);
        if (is_elsewhere(row.cell(i + 1))) {
          is_other = true;
          continue;
        }
        term.variable = variable_of(in, row.cell(i + 1), row.place);
        term.coefficient = in.lines.number(row, i + 2, "coefficient");
      }
    }
    if (static_cast<std::int64_t>(equation.terms.size()) > *count) {
      in.lines.fail(row.place, fmt::format("expected {} terms of the equation, found {}", *count,
                                           equation.terms.size()));
    }
    if (is_other) {
      in.note(equation.place, "*EQUATION between temperatures, pressures or potentials is ignored",
              true);
      in.scope->equations.pop_back();
      continue;
    }
    if (equation.terms.front().coefficient == 0.0) {
      in.lines.fail(equation.place,
                    "the first coefficient is zero; the first term is the one that "
                    "follows from the others");
    }
  }
}

}  // namespace buckens::mesh_io

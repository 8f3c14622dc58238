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

/// Adds first … last degree of freedom; an empty row means all.
void add_variables(AbaqusReading& in, const DeckRow& row, std::size_t first,
                   std::array<bool, 6>& variables) {
  if (row.cell(first).empty()) {
    variables.fill(true);
    return;
  }
  const int from = variable_of(in, row.cell(first), row.place);
  const int to =
      row.cell(first + 1).empty() ? from : variable_of(in, row.cell(first + 1), row.place);
  if (to < from) {
    in.lines.fail(
        row.place,
        fmt::format("the last degree of freedom, {}, lies before the first, {}", to + 1, from + 1));
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
  link.is_turned = keyword.has("ORIENTATION");
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
    in.note(keyword.place, fmt::format("*DISTRIBUTING, WEIGHTING METHOD={}: nodes count by their "
                                       "area alone, not by their distance",
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
  const std::string reference = in.parameter(keyword, "REFNODE");
  AbaqusLink& link = add_link(in, AbaqusLinkKind::rigid_body, keyword.place);
  link.reference = reference;
  for (const char* key : {"NSET", "TIENSET"}) {
    const std::string name = in.optional_parameter(keyword, key);
    if (!name.empty()) link.nodes.push_back(name);
  }
  const std::string elements = in.optional_parameter(keyword, "ELSET");
  if (!elements.empty()) link.element_sets.push_back(elements);
  const bool has_none = link.nodes.empty() && link.element_sets.empty();
  const std::string pinned = in.optional_parameter(keyword, "PINNSET");
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
  pins.nodes.push_back(pinned);
  pins.variables = {true, true, true, false, false, false};
}

void read_mpc(AbaqusReading& in, const DeckKeyword& keyword) {
  if (keyword.has("USER")) {
    in.note(keyword.place, "*MPC, USER: constraints programmed by the user are left out");
    return;
  }
  DeckRow row;
  while (in.lines.next_row(row)) {
    const std::string type = upper(row.cell(0));
    AbaqusLinkKind kind = AbaqusLinkKind::mpc_beam;
    if (type == "TIE") {
      kind = AbaqusLinkKind::mpc_tie;
    } else if (type == "PIN") {
      kind = AbaqusLinkKind::mpc_pin;
    } else if (type == "LINK") {
      kind = AbaqusLinkKind::mpc_link;
    } else if (type != "BEAM") {
      in.lines.fail(row.place, fmt::format("*MPC of type \"{}\" is not supported; BEAM, TIE, PIN "
                                           "and LINK are. Write it as *EQUATION",
                                           type.substr(0, 40)));
    }
    if (kind == AbaqusLinkKind::mpc_beam) {
      in.note(row.place,
              "*MPC, BEAM: a rigid beam, as in Abaqus; CalculiX keeps the distance alone, so write "
              "LINK in a deck of CalculiX");
    }
    if (row.cells.size() != 3) {
      in.lines.fail(row.place, fmt::format("an *MPC {} has two nodes or node sets, here are {}",
                                           type, row.cells.size() - 1));
    }
    AbaqusLink& link = add_link(in, kind, row.place);
    link.nodes.emplace_back(row.cell(1));
    link.reference = row.cell(2);
  }
}

void read_equation(AbaqusReading& in, const DeckKeyword& /*keyword*/) {
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusEquation& equation = in.scope->equations.emplace_back();
    equation.place = row.place;
    const auto count = files::deck_integer(row.cell(0));
    if (!count || *count < 1 || *count > kMostTerms || row.cells.size() != 1) {
      in.lines.fail(row.place, "the number of terms of the equation must be alone on this line");
    }
    while (static_cast<std::int64_t>(equation.terms.size()) < *count) {
      if (!in.lines.next_row(row)) {
        in.lines.fail(equation.place, fmt::format("the equation has {} terms, {} are there", *count,
                                                  equation.terms.size()));
      }
      for (std::size_t i = 0; i < row.cells.size(); i += 3) {
        AbaqusEquation::Term& term = equation.terms.emplace_back();
        term.reference = row.cell(i);
        term.variable = variable_of(in, row.cell(i + 1), row.place);
        term.coefficient = in.lines.number(row, i + 2, "coefficient");
      }
    }
    if (static_cast<std::int64_t>(equation.terms.size()) > *count) {
      in.lines.fail(row.place, fmt::format("the equation has {} terms, here are {}", *count,
                                           equation.terms.size()));
    }
    if (equation.terms.front().coefficient == 0.0) {
      in.lines.fail(equation.place,
                    "the first coefficient is zero; the first term is the one that "
                    "follows from the others");
    }
  }
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
// Contact that cannot open or slide holds parts together like *TIE; other contact is
// ignored.
#include <fmt/format.h>

#include "buckens/mesh_io/abaqus/cards.h"

namespace buckens::mesh_io {

void read_surface_interaction(AbaqusReading& in, const DeckKeyword& keyword) {
  in.interaction = upper(in.parameter(keyword, "NAME"));
}

void read_surface_behavior(AbaqusReading& in, const DeckKeyword& keyword) {
  // CalculiX: PRESSURE-OVERCLOSURE=TIED.
  const std::string law = upper(in.optional_parameter(keyword, "PRESSURE-OVERCLOSURE"));
  if (law == "TIED") in.deck.tied_interactions.insert(in.interaction);
}

void read_contact_pair(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string interaction = upper(in.optional_parameter(keyword, "INTERACTION"));
  DeckRow row;
  while (in.lines.next_row(row)) {
    AbaqusContact& pair = in.scope->contacts.emplace_back();
    pair.interaction = interaction;
    pair.is_tied = keyword.has("TIED");
    pair.tie.name = "contact pair " + in.optional_parameter(keyword, "INTERACTION");
    pair.tie.slave = row.cell(0);
    pair.tie.master = row.cell(1);
    pair.tie.place = row.place;
  }
  in.note(keyword.place,
          "*CONTACT PAIR is ignored unless it is TIED: there is no contact inside a body", true);
}

void add_tied_contacts(AbaqusReading& in) {
  const auto add = [&in](AbaqusScope& scope) {
    for (const AbaqusContact& pair : scope.contacts) {
      const bool is_tied = pair.is_tied || in.deck.tied_interactions.contains(pair.interaction);
      if (is_tied && !pair.tie.slave.empty() && !pair.tie.master.empty()) {
        scope.ties.push_back(pair.tie);
      }
    }
  };
  add(in.deck.root);
  for (AbaqusInstance& instance : in.deck.instances) add(instance.scope);
}

}  // namespace buckens::mesh_io

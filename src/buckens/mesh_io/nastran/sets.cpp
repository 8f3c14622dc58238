// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/sets.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "buckens/mesh_io/nastran/ids.h"

namespace buckens::mesh_io {

namespace {

using Ranges = std::vector<NastranRange>;

/// Sorted, without overlap: so that many wide ranges cost no more than one.
Ranges merged(Ranges ranges) {
  std::erase_if(ranges, [](const NastranRange& r) { return r.last < r.first; });
  std::sort(ranges.begin(), ranges.end(),
            [](const NastranRange& a, const NastranRange& b) { return a.first < b.first; });
  Ranges out;
  for (const NastranRange& range : ranges) {
    if (!out.empty() && range.first <= out.back().last) {
      out.back().last = std::max(out.back().last, range.last);
    } else {
      out.push_back(range);
    }
  }
  return out;
}

/// @param ranges merged
bool contains(const Ranges& ranges, std::int64_t id) {
  const auto after =
      std::upper_bound(ranges.begin(), ranges.end(), id,
                       [](std::int64_t value, const NastranRange& r) { return value < r.first; });
  return after != ranges.begin() && std::prev(after)->last >= id;
}

std::vector<int> select(const NastranIds& ids, const Ranges& members, const Ranges& except) {
  std::vector<int> out;
  for (const NastranRange& range : members) {
    ids.visit_range(range.first, range.last, [&](std::int64_t id, int index) {
      if (!contains(except, id)) out.push_back(index);
    });
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Members of SET1 (from field 1) and SET3 (from field 2). @return false if it holds other words
bool read_members(const NastranCard& card, int first, Ranges& out) {
  for (int field = first; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (card.word(field) == "THRU") {
      if (out.empty()) card.fail(field, "THRU needs a number before it");
      const std::int64_t last = card.id(++field);
      if (last < out.back().first) card.fail(field, "the range ends before it begins");
      out.back().last = last;
    } else if (card.is_word(field)) {
      return false;
    } else {
      const std::int64_t id = card.id(field);
      out.push_back({id, id});
    }
  }
  return true;
}

class SetBuilder {
 public:
  SetBuilder(const NastranCoordinates& coordinates, const std::vector<std::int64_t>& element_ids,
             NastranNotes& notes, fem::ImportedMesh& mesh)
      : nodes_(coordinates.node_ids()), elements_(element_ids), notes_(notes), mesh_(mesh) {}

  void add_nodes(const std::string& name, std::vector<int> nodes) {
    if (!nodes.empty()) mesh_.node_sets.push_back({name, std::move(nodes)});
  }
  void add_elements(const std::string& name, std::vector<int> elements) {
    if (!elements.empty()) mesh_.element_sets.push_back({name, std::move(elements)});
  }

  /// Of nodes, of elements or of both, as the numbers fit.
  void add_untyped(const std::string& name, const Ranges& members, const Ranges& except,
                   const NastranPlace& place) {
    std::vector<int> nodes = select(nodes_, members, except);
    std::vector<int> elements = select(elements_, members, except);
    if (nodes.empty() && elements.empty()) {
      notes_.add("sets that hold no node and no element are left out", place);
    } else if (!nodes.empty() && !elements.empty()) {
      notes_.add("sets that do not say of what they are stand for nodes and for elements", place);
    }
    add_nodes(name, std::move(nodes));
    add_elements(name, std::move(elements));
  }

  void add_set3(const NastranCard& card, const NastranBulk& bulk, const std::string& name);

 private:
  const NastranIds nodes_;
  const NastranIds elements_;
  NastranNotes& notes_;
  fem::ImportedMesh& mesh_;
};

void SetBuilder::add_set3(const NastranCard& card, const NastranBulk& bulk,
                          const std::string& name) {
  const NastranPlace place{card.file, card.line};
  const std::string kind = card.word(1);
  const bool of_nodes = kind == "GRID" || kind == "POINT";
  if (!of_nodes && kind != "ELEM" && kind != "ELEMENT" && kind != "PROP") {
    notes_.add(fmt::format("SET3 of {}: left out", kind.empty() ? "nothing" : kind), place);
    return;
  }
  Ranges members;
  if (!read_members(card, 2, members)) {
    notes_.add("SET3 with words other than THRU: left out", place);
    return;
  }
  if (kind == "PROP") {
    members = merged(members);
    std::vector<int> chosen;
    for (const NastranElement& element : bulk.elements) {
      if (contains(members, element.property) && element.kind != NastranElementKind::conrod) {
        chosen.push_back(elements_.find(element.id));
      }
    }
    std::sort(chosen.begin(), chosen.end());
    return add_elements(name, std::move(chosen));
  }
  const NastranIds& ids = of_nodes ? nodes_ : elements_;
  for (const NastranRange& range : members) {
    if (range.first == range.last && ids.find(range.first) < 0) {
      card.fail(fmt::format("there is no {} {}", of_nodes ? "GRID" : "element", range.first));
    }
  }
  std::vector<int> chosen = select(ids, merged(members), {});
  if (of_nodes) return add_nodes(name, std::move(chosen));
  add_elements(name, std::move(chosen));
}

void add_property_sets(SetBuilder& builder, const fem::ImportedMesh& mesh) {
  std::map<std::string, std::vector<int>> sets;
  int element = 0;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    std::vector<int>& set = sets[mesh.properties[static_cast<std::size_t>(block.property)].name];
    for (int i = 0; i < block.num_elements(); ++i) set.push_back(element++);
  }
  for (auto& [name, elements] : sets) builder.add_elements(name, std::move(elements));
}

}  // namespace

void add_nastran_sets(const NastranBulk& bulk, const NastranControl& control,
                      const NastranNames& names, const NastranCoordinates& coordinates,
                      const std::vector<std::int64_t>& element_ids, NastranNotes& notes,
                      fem::ImportedMesh& mesh) {
  SetBuilder builder(coordinates, element_ids, notes, mesh);
  add_property_sets(builder, mesh);
  for (const NastranControlSet& set : control.sets) {
    const NastranPlace place{set.file, set.line};
    if (set.all) {
      notes.add("SET n = ALL: left out; it holds everything", place);
      continue;
    }
    builder.add_untyped(fmt::format("SET {}", set.id), merged(set.members), merged(set.except),
                        place);
  }
  const auto name_of_card = [&](const NastranCard& card) {
    const std::string given = names.set(card.id(0));
    return given.empty() ? card.label() : given;
  };
  for (const NastranCard& card : bulk.cards_named("SET1")) {
    Ranges members;
    if (read_members(card, 1, members)) {
      builder.add_untyped(name_of_card(card), merged(members), {}, {card.file, card.line});
    } else {
      notes.add("SET1 with words other than THRU: left out", {card.file, card.line});
    }
  }
  for (const NastranCard& card : bulk.cards_named("SET3")) {
    builder.add_set3(card, bulk, name_of_card(card));
  }
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
// What sets hold: numbers, ranges and other sets.
#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "buckens/mesh_io/abaqus/names.h"

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kDeepestSets = 100;          // sets in sets
constexpr std::size_t kMostEntries = 500'000'000;  // of all sets together

template <class Entry>
void sort_unique(std::vector<Entry>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Calls `use` for the numbers of all nodes (int) or elements of a scope.
template <class Entry, class Use>
void visit_labels(const AbaqusScope& scope, Use&& use) {
  if constexpr (std::is_same_v<Entry, int>) {
    std::for_each(scope.nodes.ids.begin(), scope.nodes.ids.end(), use);
  } else {
    for (const AbaqusElements& block : scope.elements) {
      std::for_each(block.ids.begin(), block.ids.end(), use);
    }
  }
}

template <class Entry>
constexpr const char* kEntryName = std::is_same_v<Entry, int> ? "node" : "element";

}  // namespace

void AbaqusNames::open(const AbaqusSet& set) {
  const bool is_open = std::find(open_sets_.begin(), open_sets_.end(), &set) != open_sets_.end();
  if (is_open || open_sets_.size() > kDeepestSets) {
    lines_.fail(
        set.parts.front().place,
        fmt::format("set \"{}\" contains itself, directly or by way of other sets", set.name));
  }
  open_sets_.push_back(&set);
}

template <class Entry>
bool AbaqusNames::add_entry(int scope, std::int64_t label, std::vector<Entry>& out) const {
  const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(scope)];
  if constexpr (std::is_same_v<Entry, int>) {
    const int node = placed.nodes.find(label);
    if (node >= 0) out.push_back(node);
    return node >= 0;
  } else {
    const int element = placed.elements.find(label);
    if (element >= 0) out.push_back({scope, element});
    return element >= 0;
  }
}

template <class Entry>
std::size_t AbaqusNames::add_range(int scope, const AbaqusSetPart::Range& range,
                                   std::vector<Entry>& out) const {
  const AbaqusPlaced& placed = scopes_[static_cast<std::size_t>(scope)];
  const std::size_t before = out.size();
  const auto known = static_cast<std::int64_t>(std::is_same_v<Entry, int>
                                                   ? placed.scope->nodes.ids.size()
                                                   : static_cast<std::size_t>(placed.num_elements));
  // The shorter way: through the numbers of the range, or through all there are.
  if ((range.last - range.first) / range.step < known) {
    for (std::int64_t label = range.first; label <= range.last; label += range.step) {
      add_entry(scope, label, out);
    }
  } else {
    visit_labels<Entry>(*placed.scope, [&](std::int64_t label) {
      if (label < range.first || label > range.last) return;
      if ((label - range.first) % range.step == 0) add_entry(scope, label, out);
    });
  }
  return out.size() - before;
}

template <class Entry>
void AbaqusNames::add_part(int scope, const AbaqusSet& set, const AbaqusSetPart& part,
                           std::vector<Entry>& out) {
  constexpr const char* what = kEntryName<Entry>;
  const int own = in_instance(scope, "", part.instance, part.place).scope;
  for (const std::int64_t label : part.ids) {
    if (add_entry(own, label, out)) continue;
    lines_.fail(part.place,
                fmt::format("{0} set \"{1}\" refers to {0} {2}, which is not defined{3}", what,
                            set.name, label, described(own)));
  }
  std::size_t unique = out.size();
  for (const AbaqusSetPart::Range& range : part.ranges) {
    if (add_range(own, range, out) == 0) {
      lines_.fail(part.place, fmt::format("{0} set \"{1}\" generates {2} to {3}, but there is no "
                                          "such {0}{4}",
                                          what, set.name, range.first, range.last, described(own)));
    }
    // Ranges may overlap; they must not add up to more than there is.
    if (out.size() <= 2 * unique + 1000) continue;
    sort_unique(out);
    unique = out.size();
  }
  for (const std::string& name : part.names) {
    if constexpr (std::is_same_v<Entry, int>) {
      const auto more = nodes(own, name, part.place);
      out.insert(out.end(), more.begin(), more.end());
    } else {
      const auto more = elements(own, name, part.place);
      out.insert(out.end(), more.begin(), more.end());
    }
    if (out.size() <= 2 * unique + 1000) continue;
    sort_unique(out);
    unique = out.size();
  }
  if constexpr (std::is_same_v<Entry, int>) {
    if (part.of_elements.empty()) return;
    for (const AbaqusElementAt& at : elements_of_set(own, part.of_elements, part.place)) {
      const auto more = element_nodes(at);
      out.insert(out.end(), more.begin(), more.end());
    }
  }
}

template <class Entry>
const std::vector<Entry>& AbaqusNames::members(int scope, const AbaqusSet& set,
                                               KnownSets<Entry>& known) {
  const auto found = known.find({scope, &set});
  if (found != known.end()) return found->second;
  open(set);
  std::vector<Entry> out;
  for (const AbaqusSetPart& part : set.parts) add_part(scope, set, part, out);
  open_sets_.pop_back();
  sort_unique(out);
  num_entries_ += out.size();
  if (num_entries_ > kMostEntries) {
    lines_.fail(set.parts.front().place,
                fmt::format("the sets hold more than {} entries in total", kMostEntries));
  }
  return known[{scope, &set}] = std::move(out);
}

std::vector<int> AbaqusNames::nodes_in_order(int scope, const std::string& reference,
                                             DeckPlace place) {
  std::vector<int> out = nodes(scope, reference, place);
  if (out.size() < 2) return out;
  const Scoped scoped = in_instance(scope, reference, "", place);
  const AbaqusSet& set =
      scopes_[static_cast<std::size_t>(scoped.scope)].scope->node_sets.at(upper(scoped.name));
  if (!set.is_unsorted) {
    std::stable_sort(out.begin(), out.end(), [&](int a, int b) {
      return labels_[static_cast<std::size_t>(a)] < labels_[static_cast<std::size_t>(b)];
    });
    return out;
  }
  out.clear();
  for (const AbaqusSetPart& part : set.parts) {
    if (!part.ranges.empty() || !part.names.empty() || !part.of_elements.empty()) {
      lines_.fail(part.place,
                  fmt::format("*NSET, UNSORTED: the order of set \"{}\" counts where it "
                              "is used in pairs; list its nodes one by one",
                              set.name));
    }
    const int own = in_instance(scoped.scope, "", part.instance, part.place).scope;
    for (const std::int64_t label : part.ids) add_entry(own, label, out);
  }
  return out;
}

template const std::vector<int>& AbaqusNames::members(int, const AbaqusSet&, KnownSets<int>&);
template const std::vector<AbaqusElementAt>& AbaqusNames::members(int, const AbaqusSet&,
                                                                  KnownSets<AbaqusElementAt>&);

}  // namespace buckens::mesh_io

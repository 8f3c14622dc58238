// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/names.h"

#include <array>

#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

/// Cuts off and returns what stands before the mark, or all of it.
std::string_view take_until(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view piece = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return trimmed(piece);
}

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> heads) {
  for (const std::string_view head : heads) {
    if (text.starts_with(head)) return true;
  }
  return false;
}

/// Names become keys of model files and are shown in messages.
std::string printable(std::string_view name) {
  constexpr std::size_t kMost = 80;
  std::string out;
  for (const char c : name.substr(0, kMost)) out += c >= 0 && c < ' ' ? '?' : c;
  return out;
}

}  // namespace

void NastranNames::add_comment(std::string_view line) {
  if (line.starts_with("$HMNAME")) return add_hypermesh(line.substr(7));
  if (line.starts_with("$ANSA_NAME_COMMENT;")) return add_ansa(line.substr(19));
  if (line.starts_with("$ANSA_NAME;")) return add_ansa(line.substr(11));
  if (line.starts_with("$ Femap ")) return add_femap(line.substr(8));
}

void NastranNames::add_hypermesh(std::string_view rest) {
  rest = trimmed(rest);
  const std::size_t blank = rest.find_first_of(" \t");
  if (blank == std::string_view::npos) return;
  const std::string_view word = rest.substr(0, blank);
  rest.remove_prefix(blank);
  const std::string_view id = take_until(rest, '"');
  const std::string_view name = take_until(rest, '"');
  if (word == "PROP" || word == "PROPERTY") add(Kind::property, id, name);
  if (word == "COMP") add(Kind::component, id, name);
  if (word == "MAT") add(Kind::material, id, name);
}

void NastranNames::add_ansa(std::string_view rest) {
  const std::string_view id = take_until(rest, ';');
  const std::string_view word = take_until(rest, ';');
  const std::string_view name = take_until(rest, ';');
  // "~": the name follows on a line of its own; such decks are rare.
  if (name.empty() || name == "~") return;
  if (starts_with_any(word, {"PSHELL", "PSOLID", "PCOMP", "PBAR", "PBEAM", "PROD", "PBUSH"})) {
    add(Kind::property, id, name);
  }
  if (word.starts_with("MAT")) add(Kind::material, id, name);
  if (word == "SET") add(Kind::set, id, name);
}

void NastranNames::add_femap(std::string_view rest) {
  for (const auto& [word, kind] :
       {std::pair<std::string_view, Kind>{"Property ", Kind::property},
        std::pair<std::string_view, Kind>{"Material ", Kind::material}}) {
    const std::size_t place = rest.find(word);
    if (place == std::string_view::npos) continue;
    std::string_view after = rest.substr(place + word.size());
    const std::string_view id = take_until(after, ':');
    add(kind, id, trimmed(after));
    return;
  }
}

void NastranNames::add(Kind kind, std::string_view id, std::string_view name) {
  const auto number = nastran_integer(id);
  if (number && !trimmed(name).empty()) names_[kind][*number] = printable(trimmed(name));
}

std::string NastranNames::property(std::int64_t id) const {
  const bool has_properties = names_.contains(Kind::property);
  const auto list = names_.find(has_properties ? Kind::property : Kind::component);
  if (list == names_.end()) return "";
  const auto entry = list->second.find(id);
  return entry == list->second.end() ? "" : entry->second;
}

std::string NastranNames::material(std::int64_t id) const {
  const auto list = names_.find(Kind::material);
  if (list == names_.end()) return "";
  const auto entry = list->second.find(id);
  return entry == list->second.end() ? "" : entry->second;
}

std::string NastranNames::set(std::int64_t id) const {
  const auto list = names_.find(Kind::set);
  if (list == names_.end()) return "";
  const auto entry = list->second.find(id);
  return entry == list->second.end() ? "" : entry->second;
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/skip_list.h"

#include <cctype>

#include <fmt/format.h>

namespace buckens::mesh_io {

SkipList::SkipList(const std::vector<std::string>& names) {
  for (const std::string& name : names) entries_.try_emplace(plain(name), Entry{name, 0, 0});
}

std::string SkipList::plain(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isspace(letter) != 0 || (c == '*' && out.empty())) continue;
    out.push_back(static_cast<char>(std::toupper(letter)));
  }
  return out;
}

bool SkipList::takes(std::string_view name, int line, int count) {
  const auto found = entries_.find(plain(name));
  if (found == entries_.end()) return false;
  Entry& entry = found->second;
  if (entry.count == 0) entry.line = line;
  entry.count += count;
  return true;
}

std::string SkipList::remedy(std::string_view name) {
  return fmt::format(
      "; to leave it out, name it in the model file: mesh: {{skip: [{}]}} (or --skip {})", name,
      name);
}

std::vector<fem::ImportNote> SkipList::notes() const {
  std::vector<fem::ImportNote> out;
  for (const auto& [key, entry] : entries_) {
    if (entry.count == 0) {
      out.push_back({fmt::format("skip: the file has no \"{}\" to leave out", entry.name), 0, 1});
      continue;
    }
    fem::ImportNote note;
    note.text = fmt::format(
        "{} of {} left out as requested by `skip`; the body lacks their mass and stiffness",
        entry.count, entry.name);
    note.line = entry.line;
    note.is_doubtful = true;
    out.push_back(std::move(note));
  }
  return out;
}

}  // namespace buckens::mesh_io

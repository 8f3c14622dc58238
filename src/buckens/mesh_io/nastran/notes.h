// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// File and line of an item in a deck.
struct NastranPlace {
  const NastranFile* file = nullptr;
  int line = 0;

  SourceLocation where() const { return {file->name, line, 1}; }
};

/// What a reader did not import; repetitions are counted and reported once.
class NastranNotes {
 public:
  /// @param main_file notes of other files name theirs
  explicit NastranNotes(const NastranFile& main_file) : main_file_(&main_file) {}

  /// @param is_expected, is_doubtful see fem::ImportNote
  void add(const std::string& text, const NastranPlace& place, bool is_expected = false,
           bool is_doubtful = false) {
    const auto [entry, is_new] = place_of_.try_emplace(text, notes_.size());
    if (!is_new) {
      ++notes_[entry->second].count;
      return;
    }
    const bool elsewhere = place.file != nullptr && place.file != main_file_;
    notes_.push_back({elsewhere ? place.file->name + ": " + text : text, elsewhere ? 0 : place.line,
                      1, is_expected, is_doubtful});
  }

  std::vector<fem::ImportNote> take() { return std::move(notes_); }

 private:
  const NastranFile* main_file_;
  std::vector<fem::ImportNote> notes_;
  std::unordered_map<std::string, std::size_t> place_of_;
};

}  // namespace buckens::mesh_io

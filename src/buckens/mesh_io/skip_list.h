// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::mesh_io {

/// What a model file asks a reader to leave out although it has mass or stiffness: `mesh: {skip:
/// [CELAS2]}`. A reader checks before it refuses something, and passes the notes on at the end.
///
/// Names are compared in upper case, without blanks and without the star of keywords: "Solid
/// Section", "*SOLID SECTION" and "SOLIDSECTION" are the same.
class SkipList {
 public:
  SkipList() = default;
  explicit SkipList(const std::vector<std::string>& names);

  /// Whether to leave this out.
  bool has(std::string_view name) const { return entries_.contains(plain(name)); }
  /// The same; counts it if so.
  /// @param line its line, 0: unknown or in another file
  /// @param count number of elements or cards
  bool takes(std::string_view name, int line, int count = 1);

  /// The ending of a refusal: `; to leave it out, name it in the model file: mesh: {skip: […]}`.
  static std::string remedy(std::string_view name);

  /// One note per name: how many were left out, or that there were none.
  std::vector<fem::ImportNote> notes() const;

 private:
  struct Entry {
    std::string name;  ///< as written
    int count = 0;
    int line = 0;  ///< of the first
  };

  static std::string plain(std::string_view name);

  std::map<std::string, Entry> entries_;  // by plain name
};

}  // namespace buckens::mesh_io

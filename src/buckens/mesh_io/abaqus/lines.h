// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/source_location.h"

namespace buckens::mesh_io {

/// Place in a deck of several files.
struct DeckPlace {
  int file = 0;  ///< in the order in which the files were opened
  int line = 0;
};

/// A keyword line such as `*SOLID SECTION, ELSET=HOUSING, MATERIAL=STEEL`.
struct DeckKeyword {
  struct Parameter {
    std::string key;  ///< capitals without blanks: "REFNODE"
    std::string value;
  };

  std::string name;     ///< capitals without star and blanks: "SOLIDSECTION"; empty: a lone star
  std::string written;  ///< as in messages: "*SOLID SECTION"
  std::vector<Parameter> parameters;
  DeckPlace place;

  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Null if the parameter is missing; empty if it has no value.
  const std::string* find(std::string_view key) const;
};

/// A data line, split at its commas.
struct DeckRow {
  std::vector<std::string_view> cells;  ///< trimmed; valid as long as the deck
  bool continues = false;               ///< the line ends with a comma
  DeckPlace place;

  std::string_view cell(std::size_t i) const { return i < cells.size() ? cells[i] : ""; }
};

/// The lines of a deck of Abaqus or CalculiX, including those of included files in their places.
///
/// Comments and empty lines are left out, keyword lines that end with a comma are joined. Files
/// that include each other in a cycle, are nested too deeply or too large in total are refused.
class AbaqusLines {
 public:
  /// @throws IoError if the file cannot be read, InputError if it is no text
  explicit AbaqusLines(const std::filesystem::path& path);
  ~AbaqusLines();
  AbaqusLines(const AbaqusLines&) = delete;
  AbaqusLines& operator=(const AbaqusLines&) = delete;

  /// Goes to the next keyword, past data lines that were not read. False at the end.
  bool next_keyword(DeckKeyword& out);
  /// The next data line of the keyword. False if another keyword or the end follows.
  bool next_row(DeckRow& out) { return next_row(out, false); }
  /// The same, with empty lines as rows without cells: they represent omitted values.
  bool next_row_or_blank(DeckRow& out) { return next_row(out, true); }
  /// First value of the next data line; empty if there is none. Nothing is consumed.
  std::string first_cell_ahead();
  /// Reads the data lines of a keyword from another file: `*NODE, INPUT=nodes.txt`.
  void include(const std::string& name, DeckPlace place);

  SourceLocation where(DeckPlace place) const;
  /// @throws InputError with the place
  [[noreturn]] void fail(DeckPlace place, const std::string& what) const;

  /// A number of a row; an empty cell counts as missing.
  /// @throws InputError naming `what` with the place
  double number(const DeckRow& row, std::size_t i, const char* what) const;
  double number_or(const DeckRow& row, std::size_t i, double otherwise, const char* what) const;
  /// Number of a node or element: 1 … 999 999 999.
  std::int64_t label(std::string_view text, DeckPlace place, const char* what) const;

 private:
  struct Source;

  bool next_row(DeckRow& out, bool with_blank);
  bool peek();
  bool physical_line(std::string_view& line, DeckPlace& place);
  void open(const std::filesystem::path& path, const DeckPlace* from);
  DeckKeyword parse_keyword(const std::string& line, DeckPlace place) const;

  std::vector<std::unique_ptr<Source>> sources_;
  std::vector<int> stack_;  ///< open files, the innermost last
  std::size_t bytes_ = 0;
  bool has_line_ = false;  ///< a line was peeked at but not consumed
  std::string_view line_;
  DeckPlace place_;
};

/// Upper case, as Abaqus compares names: case only matters for quoted ones, which are rare.
std::string upper(std::string_view text);

}  // namespace buckens::mesh_io

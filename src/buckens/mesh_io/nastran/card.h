// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/source_location.h"
#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// One field of a card, with its position in the text of its file.
struct NastranField {
  const char* begin = nullptr;
  std::uint32_t size = 0;  ///< 0: blank
  std::uint32_t line = 0;
};

/// One bulk data entry with its continuations: the name and the data fields.
///
/// Fields are numbered from 0 after the name, eight per line of small fields, in all formats. The
/// manuals number from 2: their field 2 is number 0 here, and messages say "field 2". Blank fields
/// at the end are not stored.
class NastranCard {
 public:
  std::string name;  ///< upper case, without the asterisk of large fields
  const NastranFile* file = nullptr;
  int line = 0;  ///< first line
  std::vector<NastranField> fields;

  int size() const { return static_cast<int>(fields.size()); }
  bool blank(int i) const { return i >= size() || fields[static_cast<std::size_t>(i)].size == 0; }
  std::string_view text(int i) const;
  /// Upper-case text, "" for a blank field.
  std::string word(int i) const;
  bool is_integer(int i) const;
  /// Whether the first character is a letter.
  bool is_word(int i) const;

  /// @throws InputError with the place of the field, also where it is blank
  std::int64_t integer(int i) const;
  std::int64_t integer(int i, std::int64_t otherwise) const;
  /// A positive integer below 2^31. @throws InputError
  std::int64_t id(int i) const;
  std::int64_t id(int i, std::int64_t otherwise) const;
  /// @throws InputError unless the field is a finite number
  double real(int i) const;
  double real(int i, double otherwise) const;
  /// @throws InputError also unless the number is positive
  double positive(int i) const;

  /// @throws InputError: place of the field, name and number of the card, number of the field
  [[noreturn]] void fail(int i, const std::string& text) const;
  /// @throws InputError: first line, name and number of the card
  [[noreturn]] void fail(const std::string& text) const;
  SourceLocation where() const { return {file->name, line, 1}; }
  /// The second of two elements on one card, as in NASTRAN-95 for those of four fields.
  NastranCard second_half() const;
  /// Name and number: "CQUAD4 17".
  std::string label() const;

 private:
  SourceLocation where(int i) const;
};

}  // namespace buckens::mesh_io

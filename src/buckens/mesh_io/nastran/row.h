// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// One line of the bulk data split into its fields.
///
/// Lines with a comma are in free field: fields end at commas, NASTRAN-95 also allows blanks as
/// separators and `8)246` to name the field of a value. Lines whose first field ends or begins with
/// an asterisk are in large field (16 columns), others in small field (8 columns); a tab advances
/// to the next multiple of eight columns. DEQATN contains a formula and has no fields.
struct NastranRow {
  static constexpr std::size_t kSize = 8;

  std::string_view head;  ///< name, mark of a continuation, or a sign that repeats the line before
  std::array<std::string_view, kSize> data;
  std::size_t num_data = kSize;        ///< 4 in large field
  std::vector<std::string_view> more;  ///< beyond them, if a free line has too many
  std::string_view mark;               ///< that the next line repeats

  /// Whether fields repeat those of the line before: `=` first.
  bool repeats() const { return head.starts_with('='); }
};

/// @throws InputError for a line with too many fields, one of which is a continuation mark
NastranRow split_nastran_line(const NastranLine& line);

/// Whether a line continues the card before it.
/// @param after_comma the previous line ended with a comma: then a number may come first
bool continues_nastran_card(const NastranLine& line, bool after_comma);

/// Whether the mark at the end of a line matches the one at the start of another. The first
/// character may be a plus sign, an asterisk or, as in NASTRAN-95, anything.
bool is_same_mark(std::string_view announced, std::string_view found);

/// Without its leading sign.
std::string_view bare_mark(std::string_view mark);

}  // namespace buckens::mesh_io

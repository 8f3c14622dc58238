// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "buckens/mesh_io/nastran/row.h"

namespace buckens::mesh_io {

/// Lines that refer to the line before: `=` repeats a field, `==` the rest of the line,
/// `*4` or `*(4)` adds to a number, `/` adds the same as the field before (`//` twice), `%(7)` goes
/// to 7 in equal steps; `=3` or `=(3)` in the first field repeats the whole three times.
class NastranReplication {
 public:
  /// Takes a line with a name, which others may repeat; in NASTRAN-95 `==` in it, too, takes the
  /// rest from the line before.
  void take(NastranRow& row);

  /// Whether there are more copies to make.
  bool is_going_on() const { return copies_left_ > 0; }

  /// Reads a line that begins with `=`.
  /// @throws InputError if there is nothing to repeat, or more than a million lines are made
  void begin(const NastranRow& row, const NastranLine& line);

  /// The next copy, valid as long as this object.
  /// @throws InputError if something is added to a field that is not a number
  NastranRow next(const NastranLine& line);

 private:
  std::string_view keep(std::string text);
  std::string_view field(std::string_view before, std::string_view pattern, std::string_view& step,
                         const NastranLine& line);
  std::string_view sum(std::string_view before, std::string_view step, const NastranLine& line);

  NastranRow before_, pattern_;
  std::int64_t copies_left_ = 0, num_copies_ = 0;
  std::deque<std::string> texts_;
};

}  // namespace buckens::mesh_io

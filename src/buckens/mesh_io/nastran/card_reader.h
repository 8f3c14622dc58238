// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/mesh_io/nastran/card.h"
#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// Joins the lines of the bulk data section to cards.
///
/// Lines with a comma are in free field, lines whose first field ends or begins with an asterisk in
/// large field (16 columns), others in small field (8 columns); a tab goes on to the next multiple
/// of eight columns. Continuations follow their card directly.
class NastranCardReader {
 public:
  /// @param first a line of the bulk data that was taken from the source already
  explicit NastranCardReader(NastranSource& source, std::optional<NastranLine> first = {})
      : source_(source), pending_(first) {}

  /// Puts the next card into `card`, whose memory is used again. @return false at the end
  /// @throws InputError for lines that are no cards and lost continuations
  bool next(NastranCard& card);

  /// Whether the section was closed by ENDDATA; valid after next() returned false.
  bool found_end() const { return found_end_; }

 private:
  std::optional<NastranLine> take();

  NastranSource& source_;
  std::optional<NastranLine> pending_;  // read ahead
  bool found_end_ = false;
};

}  // namespace buckens::mesh_io

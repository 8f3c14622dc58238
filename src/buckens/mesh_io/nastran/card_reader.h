// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/mesh_io/nastran/card.h"
#include "buckens/mesh_io/nastran/replication.h"
#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// Joins the lines of the bulk data section to cards.
///
/// A continuation follows its card directly, or has the mark announced by the card, anywhere after
/// it. Lines that repeat others (NastranReplication) become separate cards.
class NastranCardReader {
 public:
  /// @param first a line of the bulk data that was already taken from the source
  explicit NastranCardReader(NastranSource& source, std::optional<NastranLine> first = {})
      : source_(source), pending_(first) {}

  /// Puts the next card into `card`, whose buffers are reused. Its text lives as long as source and
  /// reader. @return false at the end
  /// @throws InputError for lines that are not cards and lost continuations
  bool next(NastranCard& card);

  /// Whether the section was closed by ENDDATA; valid after next() returned false.
  bool found_end() const { return found_end_; }

 private:
  std::optional<NastranLine> from_source();
  void complete(NastranLine& line);
  std::optional<NastranLine> take();
  void put_back(const NastranLine& line);
  void gather();
  std::optional<NastranLine> find_continuation(std::string_view announced);
  std::optional<NastranLine> continuation_of(const NastranCard& card, std::string_view announced,
                                             bool after_comma);
  NastranRow first_row(const NastranLine& line);

  NastranSource& source_;
  std::optional<NastranLine> pending_;  // read ahead
  bool found_end_ = false, has_card_ = false;
  NastranLine before_;                 // the line that came last
  std::deque<std::string> completed_;  // lines whose rest stood in the line before
  NastranReplication replication_;
  NastranLine repeating_;  // the line being executed by replication_

  // All further lines, once a continuation was not where it should be.
  struct Ahead {
    NastranLine line;
    bool used = false;
  };
  bool has_gathered_ = false;
  std::vector<Ahead> ahead_;
  std::size_t place_ = 0;
  std::unordered_map<std::string, std::vector<std::size_t>> marks_;  // places in ahead_
};

}  // namespace buckens::mesh_io

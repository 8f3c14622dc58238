// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/files/isolated_work.h"
#include "buckens/mesh_io/step/trial.h"
#include "buckens/mesh_io/step/ways.h"

namespace buckens::mesh_io {

/// Of computing, to read a file and glue its solids.
constexpr unsigned kSecondsToRead = 120;

/// What became of one trial.
struct TrialOutcome {
  /// As mesh_in_trial() returns them.
  std::string lines;
  std::size_t trial = 0;  ///< index in those that were asked for
  double seconds = 0;
  bool timed_out = false;
  bool was_read = true;  ///< the part was read and glued in time
  /// As those of GluedPart.
  std::vector<std::size_t> smaller = {};
  double smaller_share = 0;

  /// "error", "open" or "failed"; the first word of other lines if there is a mesh.
  std::string kind() const { return lines.substr(0, lines.find(' ')); }
  bool has_mesh() const { return kind() != "error" && kind() != "open" && kind() != "failed"; }
  /// What follows the kind.
  std::string reason() const { return lines.substr(lines.find(' ') + 1); }
};

/// Whether the file has faces only.
bool is_without_solid(const TrialOutcome& outcome);

/// What is to be tried in one unit of length.
struct UnitTrials {
  std::vector<StepTrial> trials;          ///< all of the same unit
  int first_number = 1;                   ///< of the first, for reports of progress
  int most_timeouts = 1;                  ///< after which no further trial begins
  std::vector<std::size_t> without = {};  ///< places of solids that are left out
};

/// Reads the part and glues its solids once, in a process of its own, and meshes it in copies of
/// this process, each in another way, until one comes to a mesh or says that none can.
/// @return what became of each trial that was begun, at least of one
std::vector<TrialOutcome> try_in_one_unit(const StepTask& task, const UnitTrials& wanted,
                                          const files::IsolatedListener& listener);

}  // namespace buckens::mesh_io

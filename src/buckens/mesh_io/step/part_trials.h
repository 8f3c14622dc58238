// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "buckens/mesh_io/step/progress.h"
#include "buckens/mesh_io/step/trial.h"
#include "buckens/mesh_io/step/unit_trials.h"

namespace buckens::mesh_io {

/// The ways to mesh one part, tried one after the other until one comes to a mesh.
///
/// First those in metres, then those in millimetres. Small solids that overlap larger ones, such as
/// screws with drawn threads, are left out where nothing meshes them together. Faces that are no
/// solid are sewn together.
class PartTrials {
 public:
  /// @param doubt on the file itself, for messages
  PartTrials(const StepTask& task, std::string file, std::string doubt, MeshingProgress& progress)
      : task_(task), file_(std::move(file)), doubt_(std::move(doubt)), progress_(progress) {}

  /// @return the lines of the first that came to a mesh, as mesh_in_trial() returns them, and a
  /// note on how
  /// @throws InputError if none did
  std::string run();
  /// Seconds of the trials that came to no mesh.
  double in_vain() const { return in_vain_; }

 private:
  /// Which of the trials are made, and with what.
  struct Pass {
    bool in_millimetres = false;
    bool without_smaller = false;
  };

  [[noreturn]] void refuse(std::string reason) const;
  [[noreturn]] void refuse_slow() const;
  bool may_leave_out() const;
  std::optional<std::string> sew();
  std::optional<std::string> try_all(const std::vector<StepTrial>& trials, const Pass& pass);
  void take_failure(const TrialOutcome& one);

  const StepTask& task_;
  std::string file_, doubt_, first_, last_;
  std::string fold_;  // why a face that folds was not replaced; empty: none was in the way
  MeshingProgress& progress_;
  int count_ = 0, timeouts_ = 0;
  double in_vain_ = 0;                // seconds
  std::vector<std::size_t> smaller_;  // of solids that overlap
  double smaller_share_ = 0;          // of the volume
  bool is_open_ = false, has_no_solid_ = false;
};

}  // namespace buckens::mesh_io

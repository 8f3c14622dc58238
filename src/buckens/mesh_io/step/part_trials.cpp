// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/part_trials.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/step/smooth_faces.h"

namespace buckens::mesh_io {

namespace {

constexpr int kMostTimeouts = 2;  // after which no further trial begins
// Of the volume: solids that overlap larger ones, with which they cannot be meshed.
constexpr double kMostLeftOut = 0.1;

}  // namespace

std::string PartTrials::run() {
  auto lines = try_all(step_trials(), {});
  // Smaller elements and other units do not smooth a face.
  if (!lines && !fold_.empty()) refuse(fold_);
  // Cutting solids takes longest: those that leave slivers are not cut once more.
  const bool is_without = !lines && may_leave_out();
  if (is_without) {
    timeouts_ = 0;
    lines = try_all(step_trials(), {false, true});
  }
  if (!lines) lines = try_all(step_trials(), {true, is_without});
  if (!lines && is_open_) lines = sew();
  if (lines) return *lines;
  refuse(fmt::format(
      "{}. {} other methods were tried, including smaller elements. Check this location in the CAD "
      "program for slivers and for faces that touch or cut each other, or try another size{}",
      first_, count_ - 1,
      task_.request.solid.empty() ? ", or one solid of several by `solid`" : ""));
}

void PartTrials::refuse(std::string reason) const {
  const std::size_t at = reason.find(task_.step);  // the copy is of no interest to the user
  if (at != std::string::npos) {
    reason.replace(at, task_.step.size(), std::filesystem::path(file_).filename().string());
  }
  if (!doubt_.empty()) reason += ". Also, " + doubt_;
  throw InputError({file_, 0, 0}, "cannot be meshed: " + reason);
}

/// Screws and the like: so small that the body without them is of use.
bool PartTrials::may_leave_out() const {
  return !smaller_.empty() && smaller_share_ <= kMostLeftOut;
}

std::optional<std::string> PartTrials::sew() {
  auto lines = try_all(sewing_trials(), {true});
  if (lines) return lines;
  refuse(
      fmt::format("{}. Gaps of up to {:g} of the part's diagonal are closed by sewing, after "
                  "which {}. Close it in the CAD program, or export the part as a solid",
                  first_, sewing_trials().back().tolerance, last_));
}

/// Those of the trials of this pass that can be of use.
std::optional<std::string> PartTrials::try_all(const std::vector<StepTrial>& trials,
                                               const Pass& pass) {
  UnitTrials wanted{{}, count_ + 1, kMostTimeouts - timeouts_, {}};
  if (pass.without_smaller) wanted.without = smaller_;
  for (const StepTrial& trial : trials) {
    const bool is_of_use = trial.tolerance > 0 || !has_no_solid_;
    if (trial.in_millimetres == pass.in_millimetres && is_of_use) wanted.trials.push_back(trial);
  }
  if (wanted.trials.empty() || wanted.most_timeouts <= 0) return std::nullopt;
  for (const TrialOutcome& one : try_in_one_unit(task_, wanted, progress_.listener())) {
    ++count_;
    if (!one.has_mesh()) {
      take_failure(one);
      continue;
    }
    const StepTrial& trial = wanted.trials[one.trial];
    if (*trial.what == '\0' || trial.tolerance > 0) return one.lines;
    return one.lines +
           fmt::format("note meshed {}, since the usual method failed: {}\n", trial.what, first_);
  }
  return std::nullopt;
}

void PartTrials::take_failure(const TrialOutcome& one) {
  if (!one.was_read) refuse_slow();
  if (one.kind() == "error") refuse(one.reason());
  in_vain_ += one.seconds;
  if (smaller_.empty()) {
    smaller_ = one.smaller;
    smaller_share_ = one.smaller_share;
  }
  if (one.timed_out) ++timeouts_;
  is_open_ = is_open_ || one.kind() == "open";
  has_no_solid_ = has_no_solid_ || is_without_solid(one);
  last_ = one.reason();
  if (fold_.empty() && is_stopped_by_fold(last_)) fold_ = last_;
  if (first_.empty()) first_ = last_;
}

void PartTrials::refuse_slow() const {
  if (progress_.being_glued() > 0) {
    refuse(fmt::format(
        "its {} solids could not be glued where they touch within {} s of computing, whatever the "
        "size; choose one of them by `solid`, or join them in the CAD program",
        progress_.being_glued(), kSecondsToRead));
  }
  refuse(
      fmt::format("it could not be read within {} s of computing, whatever the size; simplify the "
                  "part in the CAD program: leave out threads, letters and patterns of many holes",
                  kSecondsToRead));
}

}  // namespace buckens::mesh_io

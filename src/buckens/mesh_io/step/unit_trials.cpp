// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/unit_trials.h"

#include <csignal>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/stopwatch.h"
#include "buckens/mesh_io/step/glued_part.h"
#include "buckens/mesh_io/step/progress.h"

namespace buckens::mesh_io {

namespace {

/// The outcomes as text, between processes.
std::string packed(const std::vector<TrialOutcome>& outcomes) {
  std::string out;
  for (const TrialOutcome& one : outcomes) {
    out += fmt::format("{} {} {} {} {} {} {}\n", one.trial, one.seconds, one.timed_out ? 1 : 0,
                       one.smaller_share, one.smaller.size(), fmt::join(one.smaller, " "),
                       one.lines.size());
    out += one.lines;
  }
  return out;
}

std::vector<TrialOutcome> unpacked(const std::string& text) {
  std::vector<TrialOutcome> out;
  std::istringstream stream(text);
  TrialOutcome one;
  std::size_t count = 0, length = 0;
  while (stream >> one.trial >> one.seconds >> one.timed_out >> one.smaller_share >> count) {
    one.smaller.resize(count);
    for (std::size_t& place : one.smaller) stream >> place;
    stream >> length;
    stream.ignore();  // the end of the line
    one.lines.resize(length);
    stream.read(one.lines.data(), static_cast<std::streamsize>(length));
    out.push_back(one);
  }
  return out;
}

std::string crash(int signal) {
  return fmt::format(
      "failed Gmsh's library crashed on this file (signal {}), whose geometry may be broken",
      signal);
}

TrialOutcome outcome_of(const files::IsolatedResult& result) {
  TrialOutcome out;
  out.timed_out = !result.is_complete && result.signal == SIGXCPU;
  out.lines = result.is_complete ? result.output
              : out.timed_out    ? "failed Gmsh did not finish within minutes of computing"
                                 : crash(result.signal);
  return out;
}

/// To be called in a separate process.
std::vector<TrialOutcome> try_all(const StepTask& task, const UnitTrials& wanted) {
  // Heeded when the kernel is loaded.
  if (!task.settings.empty()) ::setenv("CSF_STEPDefaults", task.settings.c_str(), 1);
  say_trial(wanted.first_number);
  base::Stopwatch watch;
  GluedPart part(task, wanted.trials.front().in_millimetres, wanted.without);
  std::vector<TrialOutcome> out;
  int timeouts = 0;
  bool has_solid = true, is_open = false;
  for (std::size_t k = 0; k < wanted.trials.size() && timeouts < wanted.most_timeouts; ++k) {
    const StepTrial& trial = wanted.trials[k];
    // Of a surface that is open one way may tell that it only seems so.
    if ((!has_solid || is_open) && trial.tolerance == 0) continue;
    if (k > 0) say_trial(wanted.first_number + static_cast<int>(k));
    out.push_back(outcome_of(files::do_isolated([&] { return mesh_in_trial(part, task, trial); },
                                                kSecondsToRead,
                                                [](const std::string& line) {
                                                  if (!line.empty()) files::say_to_listener(line);
                                                })));
    out.back().trial = k;
    out.back().seconds = watch.lap();
    out.back().smaller = part.smaller();
    out.back().smaller_share = part.smaller_share();
    if (out.back().has_mesh() || out.back().kind() == "error") break;
    if (out.back().timed_out) ++timeouts;
    is_open = is_open || out.back().kind() == "open";
    has_solid = has_solid && !is_without_solid(out.back());
  }
  return out;
}

}  // namespace

bool is_without_solid(const TrialOutcome& outcome) {
  return outcome.lines.starts_with("open there is no solid");
}

std::vector<TrialOutcome> try_in_one_unit(const StepTask& task, const UnitTrials& wanted,
                                          const files::IsolatedListener& listener) {
  const base::Stopwatch watch;
  const auto work = [&] {
    try {
      return packed(try_all(task, wanted));
    } catch (const std::exception& error) {
      return packed({{outcome_of(error)}});
    }
  };
  const files::IsolatedResult result = files::do_isolated(work, kSecondsToRead, listener);
  if (result.is_complete) return unpacked(result.output);
  TrialOutcome out = outcome_of(result);
  out.seconds = watch.seconds();
  out.was_read = !out.timed_out;
  return {out};
}

}  // namespace buckens::mesh_io

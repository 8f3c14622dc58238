// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/timed_phase.h"

#include <algorithm>
#include <utility>

namespace buckens::base {

namespace {

thread_local PhaseSeconds phases;
thread_local TimedPhase* innermost = nullptr;

std::size_t place_of(const std::string& name, PhaseSeconds& in) {
  const auto found = std::find_if(in.begin(), in.end(),
                                  [&name](const auto& phase) { return phase.first == name; });
  if (found == in.end()) {
    in.emplace_back(name, 0.0);
    return in.size() - 1;
  }
  return static_cast<std::size_t>(found - in.begin());
}

}  // namespace

TimedPhase::TimedPhase(const char* name) : outer_(std::exchange(innermost, this)), name_(name) {
  place_of(name, phases);
}

TimedPhase::~TimedPhase() {
  innermost = outer_;
  const double seconds = watch_.seconds();
  phases[place_of(name_, phases)].second += seconds - inner_;
  if (outer_ != nullptr) outer_->inner_ += seconds;
}

PhaseSeconds take_phases() { return std::exchange(phases, {}); }

void add_phases(const PhaseSeconds& more, PhaseSeconds& to) {
  for (const auto& [name, seconds] : more) to[place_of(name, to)].second += seconds;
}

}  // namespace buckens::base

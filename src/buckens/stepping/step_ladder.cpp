// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/step_ladder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace buckens::stepping {

namespace {

void add(SolveCounts& sum, const SolveCounts& counts) {
  sum.factorisations += counts.factorisations;
  sum.solves += counts.solves;
  sum.recycled += counts.recycled;
  sum.setup_solves += counts.setup_solves;
  sum.iterations += counts.iterations;
  sum.solve_seconds += counts.solve_seconds;
  sum.solver_bytes = std::max(sum.solver_bytes, counts.solver_bytes);
}

void add(StepSeconds& sum, const StepSeconds& seconds) {
  sum.large_solves += seconds.large_solves;
  sum.newton += seconds.newton;
  sum.completion += seconds.completion;
}

}  // namespace

StepLadder::StepLadder(const model::Model& model, const StepSettings& settings,
                       std::vector<int> rows_in_use, const Limits& limits)
    : model_(model),
      settings_(settings),
      rows_in_use_(std::move(rows_in_use)),
      limits_(limits),
      retired_counts_(model.bodies.size()) {
  rung(0);
}

double StepLadder::step(int k) const { return std::ldexp(settings_.step, -k); }

Stepper& StepLadder::rung(int k) {
  ++uses_;
  for (Rung& known : rungs_) {
    if (known.k != k) continue;
    known.last_used = uses_;
    return *known.stepper;
  }
  // All factors have about the same size: that of the first says how much room the next needs.
  if (!rungs_.empty()) make_room(rungs_.front().stepper->factor_entries());
  rungs_.push_back({k, uses_, make_stepper(k)});
  return *rungs_.back().stepper;
}

std::unique_ptr<Stepper> StepLadder::make_stepper(int k) {
  StepSettings settings = settings_;
  settings.step = step(k);
  settings.vectors = &vectors_;
  auto out = std::make_unique<Stepper>(model_, settings, rows_in_use_);
  factorisations_.resize(std::max(factorisations_.size(), static_cast<std::size_t>(k) + 1), 0);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    factorisations_[static_cast<std::size_t>(k)] += out->counts(b).factorisations;
  }
  return out;
}

Stepper& StepLadder::latest() {
  return *std::max_element(rungs_.begin(), rungs_.end(), [](const Rung& a, const Rung& b) {
            return a.last_used < b.last_used;
          })->stepper;
}

void StepLadder::make_room(double entries) {
  while (rungs_.size() >= 2) {
    double sum = entries;
    for (const Rung& rung : rungs_) sum += rung.stepper->factor_entries();
    if (rungs_.size() < limits_.most_kept && sum <= limits_.most_entries) return;
    const auto oldest =
        std::min_element(rungs_.begin(), rungs_.end(),
                         [](const Rung& a, const Rung& b) { return a.last_used < b.last_used; });
    retire(*oldest->stepper);
    rungs_.erase(oldest);
  }
}

void StepLadder::retire(const Stepper& stepper) {
  for (std::size_t b = 0; b < retired_counts_.size(); ++b) {
    add(retired_counts_[b], stepper.counts(b));
  }
  add(retired_seconds_, stepper.seconds());
}

SolveCounts StepLadder::counts(std::size_t body) const {
  SolveCounts out = retired_counts_[body];
  for (const Rung& rung : rungs_) add(out, rung.stepper->counts(body));
  return out;
}

StepSeconds StepLadder::seconds() const {
  StepSeconds out = retired_seconds_;
  for (const Rung& rung : rungs_) add(out, rung.stepper->seconds());
  return out;
}

long StepLadder::factorisations(int k) const {
  const auto index = static_cast<std::size_t>(k);
  return index < factorisations_.size() ? factorisations_[index] : 0;
}

}  // namespace buckens::stepping

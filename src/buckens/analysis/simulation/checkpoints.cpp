// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/checkpoints.h"

#include <algorithm>
#include <utility>

namespace buckens::analysis {

namespace {

constexpr int kMostShare = 20;  // of the time spent on saving: its inverse
constexpr double kLongest = 1e9;

}  // namespace

Checkpoints::Checkpoints(Simulation& simulation, double interval, Write write)
    : simulation_(simulation),
      interval_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(std::min(interval, kLongest)))),
      write_(std::move(write)),
      next_(Clock::now() + interval_) {
  simulation.on_step([this](const StepView&) { after_step(); });
}

void Checkpoints::after_step() {
  const Clock::time_point begin = Clock::now();
  if (begin < next_ || simulation_.is_done()) return;  // there is nothing to go on with
  write_(simulation_.save_to_write());
  const Clock::time_point end = Clock::now();
  next_ = end + std::max(interval_, (kMostShare - 1) * (end - begin));
}

}  // namespace buckens::analysis

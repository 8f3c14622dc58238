// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/reading_growth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/simulation/signal_growth.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

namespace {

// Changes to and fro that grow are no motion that steps resolve, nor is growth in one direction by
// at least this factor per step.
constexpr double kLeastOneWay = 1.5;
// What grows by more in one step has jumped.
constexpr double kMostPerStep = 1e3;
// The growth that ends the run: from rounding to what is seen, and beyond all that was before.
constexpr double kGrownBy = 1e9;
constexpr double kBeyondBefore = 1e3;
constexpr long kLeastGrown = 10;
constexpr long kMostGrown = 1L << 52U;

}  // namespace

ReadingGrowth::ReadingGrowth(const model::Model& model) : model_(model) {
  if (!follows_signals(model)) return;
  for (std::size_t k = 0; k < model.signals.all.size(); ++k) {
    if (!model.signals.all[k].held) continue;
    readings_.emplace_back();
    readings_.back().signal = k;
  }
}

void ReadingGrowth::follow(const std::vector<double>& signals) {
  for (Reading& one : readings_) {
    const double value = signals[one.signal + 1];
    const double change = value - one.last;
    const double ratio = one.change == 0.0 ? 0.0 : change / one.change;
    const bool grows = (ratio < -1.0 || ratio >= kLeastOneWay) && std::abs(ratio) <= kMostPerStep;
    if (grows && (one.count == 0 || (one.ratio < 0.0) == (ratio < 0.0))) {
      ++one.count;
    } else {
      one.count = 0;
      one.first_change = std::abs(change);
      one.largest_before = one.largest;
      one.since = signals[0];
    }
    one.ratio = ratio;
    one.last = value;
    one.change = change;
    one.largest = std::max(one.largest, std::abs(value));
    const double least = std::max(kGrownBy * one.first_change, kBeyondBefore * one.largest_before);
    if (one.count >= kLeastGrown && std::abs(change) >= least) refuse(one, signals[0]);
  }
}

void ReadingGrowth::refuse(const Reading& reading, double t) const {
  const model::Signal& signal = model_.signals.all[reading.signal];
  throw NumericalError(
      signal.where,
      fmt::format(
          "signal \"{}\", read from sensor \"{}\" at the ends of steps, has grown to {:.3g} "
          "at t = {:.6g} s: since t = {:.6g} s, each of its changes is about {:.3g} times "
          "the one before, so what it controls diverges, whatever the step; reduce the "
          "gain of its feedback, or put a `lag` of several steps into it",
          signal.name, signal.held->sensor, reading.last, t, reading.since, reading.ratio));
}

void ReadingGrowth::visit_saved(const base::SaveVisit& visit) {
  for (std::size_t k = 0; k < readings_.size(); ++k) {
    Reading& one = readings_[k];
    const base::SaveVisit reading = visit.inside(k);
    reading.number("last", one.last);
    reading.number("change", one.change);
    reading.number("largest", one.largest);
    reading.number("first_change", one.first_change);
    reading.number("largest_before", one.largest_before);
    reading.number("since", one.since);
    reading.count("count", one.count, 0, kMostGrown);
    reading.number("ratio", one.ratio);
  }
}

}  // namespace buckens::analysis

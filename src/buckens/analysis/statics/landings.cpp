// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/landings.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/statics/held_spots.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/dynamics/travel.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

namespace {

// Overlap of contacts that press, as a share of the model's length: less may be rounding.
constexpr double kPresses = 1e-9;
// Steps that one contact ends: bodies that roll or rock may leave it and come back.
constexpr int kMostLandings = 10;
constexpr int kMostTrials = 60;

}  // namespace

Landings::Landings(const RestRows& rest) : rest_(rest) {
  for (std::size_t k = 0, end = 0; k < rest.size(); k = end) {
    end = k + 1;
    if (!rest[k].is_elastic()) continue;
    while (end < rest.size() && rest[end].load == rest[k].load && rest[end].pair == rest[k].pair) {
      ++end;
    }
    touches_.push_back({k, end});
  }
}

double Landings::gap(const Touch& touch, const std::vector<dynamics::BodyMotion>& motions,
                     double t) const {
  const model::Model& model = rest_.model();
  HeldSpots spots;
  if (rest_[touch.first].pair >= 0) {
    const model::NearPair& pair = rest_.pair(touch.first);
    const auto& group = *model.contact_groups[static_cast<std::size_t>(pair.group)];
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    const auto first = dynamics::evaluate_marker(model, group.members[i].marker, motions);
    const auto second = dynamics::evaluate_marker(model, group.members[j].marker, motions);
    spots.look(group.contact(i, j), {t, first.motion, second.motion});
  } else {
    const model::Load& load = model.loads[rest_[touch.first].load];
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, nullptr);
    spots.look(dynamic_cast<const loads::Contact&>(*load.element),
               {t, ends.first.motion, ends.second.motion});
  }
  return spots.gap();
}

bool Landings::hold(const RestValues& values, const std::vector<dynamics::BodyMotion>& end,
                    double t, RestStands& stands) const {
  bool has_any = false;
  for (const Touch& touch : touches_) {
    const auto waits = [&](std::size_t k) { return values.nears[k] != 0 && stands[k].regime == 0; };
    bool may_land = false;
    for (std::size_t k = touch.first; k < touch.end; ++k) may_land = may_land || waits(k);
    if (!may_land || gap(touch, end, t) >= -kPresses * rest_.model().length) continue;
    for (std::size_t k = touch.first; k < touch.end; ++k) {
      if (waits(k)) stands[k].regime = kLanding;
    }
    has_any = true;
  }
  return has_any;
}

std::optional<double> Landings::find(const Way& way, double t) {
  if (touches_.empty()) return std::nullopt;
  const double length = rest_.model().length;
  const auto before = way(0.0), after = way(1.0);
  std::vector<Touch*> found;
  for (Touch& touch : touches_) {
    if (touch.landings == kMostLandings || gap(touch, after, t) >= -kPresses * length) continue;
    if (gap(touch, before, t) >= kDifference * length) found.push_back(&touch);
  }
  if (found.empty()) return std::nullopt;
  Touch* first = nullptr;
  const auto least_gap = [&](double share) {
    const auto there = way(share);
    double least = HUGE_VAL;
    for (Touch* touch : found) {
      const double own = gap(*touch, there, t);
      if (own < least) first = touch;
      least = std::min(least, own);
    }
    return least;
  };
  // The secant finds where straight ways touch, halving where others do.
  double open = 0.0, pressing = 1.0;
  double gap_open = least_gap(open), gap_pressing = least_gap(pressing);
  for (int k = 0; k < kMostTrials && gap_open > kPresses * length; ++k) {
    const double secant =
        open + (pressing - open) * (gap_open - 0.5 * kPresses * length) / (gap_open - gap_pressing);
    const double share = k % 3 == 2 ? 0.5 * (open + pressing) : secant;
    const double there = least_gap(share);
    (there < 0.0 ? pressing : open) = share;
    (there < 0.0 ? gap_pressing : gap_open) = there;
  }
  least_gap(open);
  ++first->landings;
  return open;
}

}  // namespace buckens::analysis

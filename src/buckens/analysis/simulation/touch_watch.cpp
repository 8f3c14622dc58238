// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/touch_watch.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/dynamics/citing.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/coordinate_law.h"

namespace buckens::analysis {

namespace {
// Of the energy involved; what less does to it is lost among other errors.
constexpr double kNoticeable = 0.01;
}  // namespace

TouchWatch::TouchWatch(const model::Model& model) : model_(model) {
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const loads::ForceElement* const element = model.loads[k].element.get();
    const bool touches = dynamic_cast<const loads::CoordinateStop*>(element) != nullptr ||
                         dynamic_cast<const loads::Contact*>(element) != nullptr;
    if (!touches) continue;
    touches_.emplace_back();
    touches_.back().load = k;
  }
}

void TouchWatch::add_step(std::span<const dynamics::LoadPower> of_loads, double h) {
  for (Touches& own : touches_) {
    const double stored = of_loads[own.load].stored;
    if (stored > 0.0) {
      ++own.steps;
      own.time += h;
      own.energy = std::max(own.energy, stored);
    } else if (own.steps > 0) {
      ++own.all;
      if (own.steps < kFew) {
        ++own.brief;
        if (own.energy > own.worst_energy) {
          own.worst_energy = own.energy;
          own.worst_steps = own.steps;
          own.worst_time = own.time;
        }
      }
      own.steps = 0;
      own.time = own.energy = 0.0;
    }
  }
}

std::vector<std::string> TouchWatch::warnings(double scale) const {
  std::vector<std::string> out;
  for (const Touches& own : touches_) {
    if (own.worst_energy <= kNoticeable * scale) continue;
    out.push_back(dynamics::naming(
        model_.loads[own.load],
        fmt::format("{} of {} touches were over within fewer than {} steps, that with the largest "
                    "energy, {:.3g} J, within {}; the steps do not resolve its spring, and such "
                    "touches create or destroy energy; use a step of {:.2g} s at most, a lower "
                    "stiffness, or none, so that it is rigid and strikes",
                    own.brief, own.all, kFew, own.worst_energy, own.worst_steps,
                    own.worst_time / kEnough)));
  }
  return out;
}

void TouchWatch::visit_saved(const base::SaveVisit& visit) {
  constexpr long kMost = 1L << 60;
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const base::SaveVisit own = visit.inside(k);
    own.count("steps", touches_[k].steps, 0, kMost);
    own.number("time", touches_[k].time);
    own.number("energy", touches_[k].energy);
    own.count("all", touches_[k].all, 0, kMost);
    own.count("brief", touches_[k].brief, 0, kMost);
    own.count("worst_steps", touches_[k].worst_steps, 0, kMost);
    own.number("worst_time", touches_[k].worst_time);
    own.number("worst_energy", touches_[k].worst_energy);
  }
}

}  // namespace buckens::analysis

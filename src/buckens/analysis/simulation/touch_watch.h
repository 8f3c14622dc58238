// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/forces.h"
#include "buckens/model/model.h"

namespace buckens::analysis {

/// Watches whether steps resolve the touches of elastic stops and contacts.
///
/// A touch lasts half a period of the mass on its spring. Where a step leads over its beginning or
/// its end, the force at one end of the step acts through all of it, and gives energy to the touch
/// or takes it: up to (ωh)²/4 of what is in it. Theory: docs/theory/25-contact.md §7. Cost: one
/// comparison per such load and step. Contacts of many bodies with each other are not watched, as
/// one of them or another touches at any time.
class TouchWatch {
 public:
  /// Ends of steps within a touch, below which it counts as brief: the error is then above 4 %.
  static constexpr long kFew = 8;
  /// Of the touch; the error is then below 1 %.
  static constexpr double kEnough = 20;

  explicit TouchWatch(const model::Model& model);

  /// To be called after each step. @param of_loads what each load holds at its end
  /// @param h its length [s]
  void add_step(std::span<const dynamics::LoadPower> of_loads, double h);

  /// A warning for each stop or contact with brief touches that held a noticeable share of the
  /// energy. @param scale energy involved [J]
  std::vector<std::string> warnings(double scale) const;

  /// Saves or restores what was collected so far. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Touches {
    std::size_t load = 0;
    // Of the one that goes on: ends of steps in it, time since it was seen first [s], largest
    // energy [J].
    long steps = 0;
    double time = 0, energy = 0;
    // Of those that have ended; of the brief one with the largest energy.
    long all = 0, brief = 0;
    long worst_steps = 0;
    double worst_time = 0, worst_energy = 0;
  };

  const model::Model& model_;
  std::vector<Touches> touches_;
};

}  // namespace buckens::analysis

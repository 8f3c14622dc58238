// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Sees signals go through zero.
class EventWatch {
 public:
  /// One event that happened.
  struct Found {
    std::string text;  ///< "event "landed" at t = 0.4515 s: signal "height" falls through zero"
    bool stops = false;
    const model::EventSpec* spec = nullptr;
  };

  explicit EventWatch(const model::BuiltModel& built);

  /// What happened in a step. The instant is found on the motion interpolated between its ends.
  /// @throws NumericalError naming an event that happens again and again
  std::vector<Found> after_step(const model::State& before, const model::State& after);

  /// Whether a step contains an event that acts on the motion.
  bool holds_action(const model::State& before, const model::State& after) const;
  /// What happened because actions have changed the values of signals.
  /// @param before values of all signals before these actions
  /// @throws NumericalError as after_step()
  std::vector<Found> after_actions(const std::vector<double>& before, const model::State& state);

  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Event {
    const model::EventSpec* spec = nullptr;
    std::size_t signal = 0;    // place in RowMemory::signals
    bool is_held = false;      // it hangs on what is read at the ends of steps
    std::vector<long> recent;  // numbers of the steps in which it happened, the last of them
  };
  double crossing(const Event& event, const model::State& before, const model::State& after) const;
  void count(Event& event, double t);

  const model::BuiltModel& built_;
  std::vector<Event> events_;
  long steps_ = 0;
};

}  // namespace buckens::analysis

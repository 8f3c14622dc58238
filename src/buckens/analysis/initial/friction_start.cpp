// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/friction_start.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/initial/quasi_static_start.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/dynamics/travel.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

namespace {

// Friction depends on reactions and changes them, by its coefficient times a ratio of levers each
// time.
constexpr int kReactionRounds = 8;
// Laws also react to each other.
constexpr int kSweeps = 12;
constexpr double kAtRest = 1e-9;
// Central differences of rates in time [s]: both curvature and rounding are negligible.
constexpr double kTimeDifference = 1e-6;

/// A law with a state, at rest.
struct RestingLaw {
  std::size_t load = 0;
  double most = 0;   ///< strain at which it gives way
  double slope = 0;  ///< acceleration of the coordinate per strain [1/s²], negative
};

class FrictionStart {
 public:
  FrictionStart(const model::Model& model, const dynamics::MassMetric& metric,
                const std::vector<int>& rows_in_use, model::State& state)
      : model_(model), metric_(metric), rows_in_use_(rows_in_use), state_(state) {}

  void run() {
    for (int round = 0; round < kReactionRounds; ++round) settle();
    find_resting();
    for (int sweep = 0; sweep < kSweeps && !resting_.empty(); ++sweep) {
      double largest = 0.0;
      for (RestingLaw& law : resting_) largest = std::max(largest, relax(law));
      if (largest <= kAtRest) break;
    }
  }

 private:
  void settle() { settle_accelerations(model_, metric_, rows_in_use_, state_); }

  double& strain(const RestingLaw& law) {
    return state_.memory.laws[model_.loads[law.load].first_state];
  }

  /// The admissible strain of the law closest to the given one.
  double admitted(const RestingLaw& law, double strain) {
    const model::Load& load = model_.loads[law.load];
    const auto motions = dynamics::motions_of(model_, state_);
    const dynamics::LoadEnds ends = dynamics::ends_of(model_, load, motions, &state_.memory);
    loads::Sight sight =
        dynamics::sight_of(model_, law.load, state_.t, dynamics::circumstances_of(state_), ends);
    sight.states = &strain;
    double out = 0.0;
    load.element->find_states(sight, &out);
    return out;
  }

  void find_resting() {
    for (std::size_t k = 0; k < model_.loads.size(); ++k) {
      const model::Load& load = model_.loads[k];
      if (load.element->num_states() != 1 || load.coordinate < 0) continue;
      RestingLaw law{k, 0.0, 0.0};
      if (strain(law) != 0.0) continue;  // slides from the start
      law.most = admitted(law, 1.0 / kTimeDifference);
      if (law.most > 0.0) resting_.push_back(law);
    }
  }

  /// Rate of the law's coordinate a little before or after.
  double rate_after(const RestingLaw& law, double t) const {
    model::State moved = state_;
    for (model::BodyState& s : moved.bodies) {
      s.frame.X_WB.p += t * s.frame.v;
      s.frame.X_WB.q = s.frame.X_WB.q * spatial::exp_rotation(t * s.frame.w);
      s.frame.v += t * s.v_dot;
      s.frame.w += t * s.w_dot;
      s.d.change() += t * s.d_dot.whole();
      s.d_dot.change() += t * s.d_ddot.whole();
    }
    const model::Load& load = model_.loads[law.load];
    const auto motions = dynamics::motions_of(model_, moved);
    return dynamics::coordinate_motion(model_, static_cast<std::size_t>(load.coordinate), state_.t,
                                       &state_.memory, motions)
        .rate;
  }

  double acceleration(const RestingLaw& law) const {
    return (rate_after(law, kTimeDifference) - rate_after(law, -kTimeDifference)) /
           (2.0 * kTimeDifference);
  }

  /// Strains one law so that its coordinate rests. @return change as a fraction of its limit
  double relax(RestingLaw& law) {
    const double before = strain(law);
    const double open = acceleration(law);
    if (law.slope == 0.0) {
      strain(law) = 0.5 * law.most;
      settle();
      law.slope = (acceleration(law) - open) / (0.5 * law.most - before);
      if (!(law.slope < 0.0)) {  // nothing that it could hold
        strain(law) = before;
        settle();
        return 0.0;
      }
    }
    strain(law) = admitted(law, before - open / law.slope);
    settle();
    return std::abs(strain(law) - before) / law.most;
  }

  const model::Model& model_;
  const dynamics::MassMetric& metric_;
  const std::vector<int>& rows_in_use_;
  model::State& state_;
  std::vector<RestingLaw> resting_;
};

}  // namespace

void settle_friction(const model::Model& model, const dynamics::MassMetric& metric,
                     const std::vector<int>& rows_in_use, model::State& state) {
  FrictionStart(model, metric, rows_in_use, state).run();
}

}  // namespace buckens::analysis

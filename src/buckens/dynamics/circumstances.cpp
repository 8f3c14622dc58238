// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/circumstances.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_law.h"

namespace buckens::dynamics {

namespace {

// A measured angle jumps at π; without memory the side is unknown.
constexpr double kLargestUncounted = 3.0;

/// Where the memory is that of a state of rest: how a load stands there, else null.
const loads::RowStand* stand_at_rest(std::size_t load, const Circumstances& around) {
  if (around.memory == nullptr || around.memory->at_rest.empty()) return nullptr;
  return &around.memory->at_rest[load];
}

/// How the rigid row of a law stands.
loads::RowStand stand_of(const model::Model& model, std::size_t k, const Circumstances& around,
                         const double* states) {
  const model::Load& load = model.loads[k];
  if (around.stands != nullptr) return (*around.stands)[static_cast<std::size_t>(load.rigid_row)];
  if (const loads::RowStand* stand = stand_at_rest(k, around)) return *stand;
  if (states == nullptr) return {};
  return {static_cast<int>(states[0]), states[1]};
}

/// Force of the rigid row of a law.
double force_of_row(const model::Model& model, std::size_t k, const Circumstances& around) {
  const bool has_memory = around.memory != nullptr && around.memory->laws.size() > 0;
  const double* const laws = has_memory ? around.memory->laws.data() : nullptr;
  return stand_of(model, k, around, laws != nullptr ? laws + model.loads[k].first_state : nullptr)
      .force;
}

/// Torque on the second marker of a ball whose friction is three rigid rows, of all of them.
/// @param row which of the three the load is, @param R_WF axes of the first marker
Eigen::Vector3d torque_of_ball(const model::Model& model, std::size_t load, int row,
                               const Circumstances& around, const Eigen::Matrix3d& R_WF) {
  const std::size_t first = load - static_cast<std::size_t>(row);
  return R_WF * Eigen::Vector3d(force_of_row(model, first, around),
                                force_of_row(model, first + 1, around),
                                force_of_row(model, first + 2, around));
}

/// Force on the second body of a rigid contact: of the row across the surface, which is that of the
/// load before the directions of friction, and of these.
spatial::Wrench reaction_of(const model::Model& model, std::size_t load,
                            const Circumstances& around, const loads::Sight& sight,
                            const loads::ContactFriction& friction) {
  const std::size_t across = load - 1 - static_cast<std::size_t>(friction.direction());
  const spatial::TouchPlace place = friction.touch().look(sight.first, sight.second);
  const auto& stop = static_cast<const loads::RigidLaw&>(*model.loads[across].element);
  spatial::Wrench out;
  out.force = (stop.contact(0.0).sign * force_of_row(model, across, around)) * place.normal;
  for (int k = 0; k < friction.touch().num_directions(); ++k) {
    const auto direction = static_cast<std::size_t>(k);
    out.force += force_of_row(model, across + 1 + direction, around) * place.along[direction];
  }
  return out;
}

/// What a load may see besides motions and the reaction of its joint.
void tell_rest(const model::Model& model, std::size_t load, const Circumstances& around,
               loads::Sight& sight) {
  const model::Load& own = model.loads[load];
  if (around.memory != nullptr && around.memory->laws.size() > 0) {
    sight.states = around.memory->laws.data() + own.first_state;
  }
  if (own.rigid_row >= 0) {
    sight.stand = stand_of(model, load, around, sight.states);
    const auto* friction = dynamic_cast<const loads::ContactFriction*>(own.element.get());
    if (friction != nullptr) sight.reaction = reaction_of(model, load, around, sight, *friction);
    const int row = static_cast<const loads::RigidLaw&>(*own.element).row_of_ball();
    // The joint itself transmits no torque.
    if (row >= 0) sight.reaction.torque = torque_of_ball(model, load, row, around, sight.first.R);
  }
  sight.signals = signals_of(around);
}

}  // namespace

bool is_open_place(const model::Model& model, std::size_t load, const Circumstances& around) {
  if (model.loads[load].rigid_row < 0) return false;
  const auto& law = static_cast<const loads::RigidLaw&>(*model.loads[load].element);
  const int row = law.row_of_place();
  if (row < 0) return false;
  const auto is_open = [&](std::size_t k) {
    const bool has_memory = around.memory != nullptr && around.memory->laws.size() > 0;
    const double* const states =
        has_memory ? around.memory->laws.data() + model.loads[k].first_state : nullptr;
    const loads::RowStand stand = stand_of(model, k, around, states);
    return stand.regime == 0 && stand.force == 0.0 && stand.taken_back == 0.0;
  };
  return is_open(load) && (row == 0 || is_open(load - static_cast<std::size_t>(row)));
}

Circumstances circumstances_of(const model::State& state) {
  return {&state.inputs, &state.memory, &state.lambda, nullptr};
}

namespace {

joints::CountedValue uncounted(const model::Model& model, std::size_t coordinate, double fraction) {
  const joints::JointCoordinate& law = model.coordinates[coordinate].law;
  if (law.is_angle() && std::abs(fraction) > kLargestUncounted) {
    const auto joint = static_cast<std::size_t>(model.coordinates[coordinate].joint);
    throw NumericalError(fmt::format(
        "the angle of joint \"{}\" is {:.4g} rad; static analyses count no turns and measure "
        "angles up to {} rad; keep the motion within that",
        model.joints[joint].name, fraction, kLargestUncounted));
  }
  return {0, fraction};
}

}  // namespace

joints::CountedValue counted_coordinate(const model::Model& model, std::size_t coordinate, double t,
                                        const model::RowMemory* memory,
                                        const spatial::MarkerMotion& first,
                                        const spatial::MarkerMotion& second) {
  const joints::JointCoordinate& law = model.coordinates[coordinate].law;
  const joints::CountedValue* const before = before_of(memory, coordinate);
  if (before == nullptr) return uncounted(model, coordinate, law.fraction(first, second, nullptr));
  const joints::CountedValue expected = law.expect(*before, t);
  return law.follow(expected, law.fraction(first, second, &expected));
}

JointWrenches wrenches_of(const model::Joint& joint, double t, const model::RowMemory* memory,
                          const linalg::Vector& lambda, const spatial::MarkerMotion& first,
                          const spatial::MarkerMotion& second) {
  spatial::PairRow sum = spatial::PairRow::Zero();
  const double* states = states_of(joint, memory);
  for (std::size_t k = 0; k < joint.rows.size(); ++k) {
    const joints::ConstraintRow& row = joint.rows[k];
    sum += lambda[joint.first_row + static_cast<int>(k)] * row.evaluate(first, second, t, states).J;
    if (states != nullptr) states += row.num_states();
  }
  JointWrenches out;
  out.on_first = {sum.segment<3>(0).transpose(), sum.segment<3>(3).transpose()};
  out.on_second = {sum.segment<3>(6).transpose(), sum.segment<3>(9).transpose()};
  return out;
}

loads::CoordinateMotion coordinate_motion(const model::Model& model, std::size_t coordinate,
                                          double t, const model::RowMemory* memory,
                                          const spatial::MarkerMotion& first,
                                          const spatial::MarkerMotion& second,
                                          joints::CountedValue* counted_now) {
  const joints::JointCoordinate& law = model.coordinates[coordinate].law;
  const joints::CountedValue* const at = before_of(memory, coordinate);
  joints::CountedValue expected;
  if (at != nullptr) expected = law.expect(*at, t);
  const joints::CoordinateLook look = law.look(first, second, at != nullptr ? &expected : nullptr);
  const joints::CountedValue now = at != nullptr ? law.follow(expected, look.fraction)
                                                 : uncounted(model, coordinate, look.fraction);
  if (counted_now != nullptr) {
    // One by one: a copy of the whole waits for what was written in parts.
    counted_now->turns = now.turns;
    counted_now->fraction = now.fraction;
    counted_now->rate = look.rate;
    counted_now->t = t;
  }
  loads::CoordinateMotion out;
  out.J = look.J;
  out.rate = look.rate;
  out.value = now.value();
  if (at == nullptr) return out;
  out.change = spatial::difference(*at, now);
  return out;
}

loads::Sight sight_of(const model::Model& model, std::size_t load, double t,
                      const Circumstances& around, const spatial::MarkerMotion& first,
                      const spatial::MarkerMotion& second, const Travel* travel) {
  const model::Load& own = model.loads[load];
  loads::Sight sight{t, first, second, {}, {}, nullptr, {}};
  const bool has_reaction = around.lambda != nullptr && around.lambda->size() > 0;
  if (travel != nullptr) {
    sight.coordinate = travel->coordinate(static_cast<std::size_t>(own.coordinate), around.memory);
    if (has_reaction) sight.reaction = travel->reaction(t, *around.lambda);
  } else if (own.coordinate >= 0) {
    sight.coordinate = coordinate_motion(model, static_cast<std::size_t>(own.coordinate), t,
                                         around.memory, first, second);
  }
  if (own.joint >= 0 && travel == nullptr && has_reaction) {
    sight.reaction = wrenches_of(model.joints[static_cast<std::size_t>(own.joint)], t,
                                 around.memory, *around.lambda, first, second)
                         .on_second;
  }
  tell_rest(model, load, around, sight);
  return sight;
}

loads::Sight sight_at_joint(const model::Model& model, std::size_t load, double t,
                            const Circumstances& around, const spatial::MarkerMotion& first,
                            const spatial::MarkerMotion& second, const spatial::Wrench& reaction,
                            joints::CountedValue* now) {
  const int coordinate = model.loads[load].coordinate;
  // Formed in its place: a law at a joint is evaluated in every iteration of a step.
  loads::Sight sight{t, first, second,
                     coordinate >= 0
                         ? coordinate_motion(model, static_cast<std::size_t>(coordinate), t,
                                             around.memory, first, second, now)
                         : loads::CoordinateMotion{},
                     reaction};
  tell_rest(model, load, around, sight);
  return sight;
}

loads::Action action_of(const model::Model& model, std::size_t load, double t,
                        const Circumstances& around, const spatial::MarkerMotion& first,
                        const spatial::MarkerMotion& second, const Travel* travel) {
  const loads::ForceElement& element = *model.loads[load].element;
  if (around.memory != nullptr && around.memory->is_off(load)) return {};
  if (around.inputs != nullptr && !around.inputs->empty() && (*around.inputs)[load]) {
    return element.act(*(*around.inputs)[load], first);
  }
  if (model.loads[load].coordinate < 0 && element.num_states() == 0 && !element.uses_signals()) {
    return element.evaluate(t, first, second);
  }
  const loads::Sight sight = sight_of(model, load, t, around, first, second, travel);
  const loads::RowStand* const stand = stand_at_rest(load, around);
  const bool has_coordinate = model.loads[load].coordinate >= 0;
  if (stand != nullptr && stand->regime != 0 && has_coordinate && model.loads[load].rigid_row < 0) {
    return loads::along_coordinate(sight.coordinate, stand->force);  // frozen friction
  }
  return element.respond(sight);
}

}  // namespace buckens::dynamics

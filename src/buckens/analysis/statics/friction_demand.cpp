// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/friction_demand.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/loads/joint_law_spec.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

namespace {

// Beyond the limit by this share is rounding: a body at its limit holds.
constexpr double kAtLimit = 1e-9;

/// What friction of a joint or of an elastic contact, or a brake, gives.
double most_of(const model::Model& model, std::size_t load,
               const std::vector<dynamics::BodyMotion>& motions, const linalg::Vector& lambda,
               const model::State& state) {
  const model::Load& own = model.loads[load];
  const dynamics::LoadEnds ends = dynamics::ends_of(model, own, motions, nullptr);
  dynamics::SignalValues signals;
  const dynamics::Circumstances around = dynamics::with_signals(
      model, motions, state.t, {nullptr, &state.memory, &lambda, nullptr, nullptr}, signals);
  const loads::Sight sight = dynamics::sight_of(model, load, state.t, around, ends);
  if (const auto* brake = dynamic_cast<const loads::CoordinateBrake*>(own.element.get())) {
    return brake->bound(sight);
  }
  if (const auto* contact = dynamic_cast<const loads::Contact*>(own.element.get())) {
    return contact->data().static_coefficient * contact->read(sight).normal;
  }
  return dynamic_cast<const loads::ReactionFollower&>(*own.element).most_at_rest(sight);
}

/// Friction of a cross joint: each arm has its own bearing.
bool rubs_by_arm(const model::Model& model, std::size_t load) {
  const int joint = model.loads[load].joint;
  return model.loads[load].kind == loads::BallFrictionSpec::kKey && joint >= 0 &&
         model.joints[static_cast<std::size_t>(joint)].type == joints::JointType::universal;
}

/// Two bodies of a contact of many, and what friction between them gives.
struct RubbingPair {
  std::string name;
  double most = 0;
};

RubbingPair pair_of(const model::Model& model, const model::NearPair& pair,
                    const std::vector<dynamics::BodyMotion>& motions, double t) {
  const model::ContactGroup& group = *model.contact_groups[static_cast<std::size_t>(pair.group)];
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const auto body = [&](std::size_t member) -> std::string {
    const int b = group.members[member].marker.body;
    return b == model::kGround ? "ground" : model.bodies[static_cast<std::size_t>(b)].name;
  };
  const auto at = [&](std::size_t member) {
    return dynamics::evaluate_marker(model, group.members[member].marker, motions).motion;
  };
  const spatial::MarkerMotion first = at(i), second = at(j);
  return {
      fmt::format("{}\" between \"{}\" and \"{}", model.loads[group.load].name, body(i), body(j)),
      group.law.static_coefficient * group.contact(i, j).read({t, first, second}).normal};
}

linalg::Vector least_reactions(const model::Model& model, const dynamics::MassMetric& metric,
                               const std::vector<dynamics::BodyMotion>& motions,
                               const model::State& state) {
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, motions, state.t, &state.memory, constraints);
  return dynamics::least_multipliers(model, metric, constraints.rows, state.lambda);
}

/// Two bodies may touch by several shapes.
void add_pair(const RubbingPair& pair, std::map<std::string, FrictionDemand>& found) {
  FrictionDemand& demand = found[pair.name];
  demand.load = pair.name;
  demand.most += pair.most;
}

/// Both rows of one place of a contact: its row across, or its load, pair of bodies and spot.
struct Place {
  int across;
  std::size_t load;
  int pair, spot;
  auto operator<=>(const Place&) const = default;
};

}  // namespace

double FrictionDemand::ratio() const {
  if (most > 0.0) return force / most;
  return force > 0.0 ? HUGE_VAL : 0.0;
}

std::string FrictionDemand::text() const {
  const char* unit = is_torque ? "N m" : "N";
  return fmt::format(
      "frozen friction \"{}\" holds {:.6g} {}, its limit is {:.6g} {}{}: it would slide; give it "
      "more friction, or look for the equilibrium with `friction: free`",
      load, force, unit, most, unit,
      most > 0.0 ? fmt::format(" (ratio {:.6g})", ratio()) : std::string());
}

std::vector<FrictionDemand> friction_demands(const model::Model& model,
                                             const dynamics::MassMetric& metric,
                                             const RestRows& rest, const RestStands& stands,
                                             const model::State& state) {
  const auto motions = dynamics::motions_of(model, state);
  const linalg::Vector lambda = least_reactions(model, metric, motions, state);
  std::map<std::string, FrictionDemand> found;
  std::map<Place, double> squares;  // of the forces along the surface
  std::map<int, RubbingPair> pairs;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const RestRow& row = rest[k];
    if (row.kind == RestRow::Kind::one_sided) continue;
    if (row.pair >= 0) {
      if (stands[k].force == 0.0) continue;
      squares[{-1, row.load, row.pair, row.part / RestRow::kOfSpot}] +=
          std::pow(stands[k].force, 2);
      if (pairs.contains(row.pair)) continue;
      add_pair(pairs[row.pair] = pair_of(model, rest.pair(k), motions, state.t), found);
      continue;
    }
    FrictionDemand& demand = found[rest.name(k)];
    demand.load = rest.name(k);
    demand.is_torque = row.is_angle;
    const double force = std::abs(stands[k].force);
    if (row.kind == RestRow::Kind::along) {
      const bool is_rigid = row.across >= 0;
      const Place place{row.across, is_rigid ? 0 : row.load, row.pair,
                        is_rigid ? 0 : row.part / RestRow::kOfSpot};
      squares[place] += force * force;
      if (!is_rigid && demand.most == 0.0)
        demand.most = most_of(model, row.load, motions, lambda, state);
      continue;
    }
    const bool is_by_arm = rubs_by_arm(model, row.load);
    demand.force = is_by_arm ? std::max(demand.force, force) : std::hypot(demand.force, force);
    demand.most = most_of(model, row.load, motions, lambda, state);
  }
  for (const auto& [place, square] : squares) {
    if (place.across < 0) {
      const std::string& name =
          place.pair < 0 ? model.loads[place.load].name : pairs.at(place.pair).name;
      found[name].force += std::sqrt(square);
      continue;
    }
    const auto across = static_cast<std::size_t>(place.across);
    FrictionDemand& demand = found[rest.name(across)];
    demand.force += std::sqrt(square);
    // Its rows along the surface come behind it.
    const auto& friction =
        static_cast<const loads::ContactFriction&>(*model.loads[rest[across].load + 1].element);
    demand.most +=
        friction.data().static_coefficient * std::max(0.0, rest.push(across, stands[across]));
  }
  std::vector<FrictionDemand> out;
  for (auto& [name, demand] : found) out.push_back(std::move(demand));
  return out;
}

std::vector<std::string> overloaded_friction(const std::vector<FrictionDemand>& demands) {
  std::vector<std::string> out;
  for (const FrictionDemand& demand : demands) {
    if (demand.ratio() > 1.0 + kAtLimit) out.push_back(demand.text());
  }
  return out;
}

}  // namespace buckens::analysis

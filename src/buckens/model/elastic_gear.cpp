// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/elastic_gear.h"

#include <algorithm>
#include <cmath>

namespace buckens::model {

using loads::Action;
using loads::Sight;
using loads::SoftRow;

namespace {
constexpr std::array<double, 2> kSides = {1.0, -1.0};  // of the gap
using MeshStates = std::array<double, joints::GearMesh::kStates>;
// Last, where the joint has the flank that carries.
constexpr int kFlank = joints::GearMesh::kFlank, kMiddle = kFlank;
}  // namespace

std::array<ElasticGear::Flank, 2> ElasticGear::look(const Sight& sight) const {
  Eigen::Matrix<double, 12, 1> V;
  V << sight.first.w, sight.first.v, sight.second.w, sight.second.v;
  std::array<Flank, 2> out;
  for (std::size_t k = 0; k < kSides.size(); ++k) {
    // A joint's multiplier pushes against its gap: the flank has the opposite sign.
    MeshStates states{};
    if (sight.states != nullptr) {
      std::copy_n(sight.states, kFlank, states.begin());
      states[kFlank] = -kSides[k];
    } else {
      mesh_.follow(sight.first, sight.second, -kSides[k], sight.t, nullptr, states.data());
    }
    const joints::RowValue row = mesh_.evaluate(sight.first, sight.second, sight.t, states.data());
    Flank& flank = out[k];
    flank.J = kSides[k] * row.J;
    const double middle = sight.states != nullptr ? sight.states[kMiddle] : meshed_at(row.g);
    flank.depth = kSides[k] * (row.g - middle) - 0.5 * data_.play;
    flank.rate = flank.J.dot(V);
    if (!flank.touches()) continue;
    const double elastic = data_.stiffness * flank.depth;
    flank.viscous = data_.damping * flank.rate;
    flank.is_limited = std::abs(flank.viscous) > elastic;
    if (flank.is_limited) flank.viscous = std::copysign(elastic, flank.viscous);
  }
  return out;
}

Action ElasticGear::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                             const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action ElasticGear::respond(const Sight& sight) const {
  Action out;
  const std::array<Flank, 2> flanks = look(sight);
  for (std::size_t k = 0; k < flanks.size(); ++k) {
    const Flank& flank = flanks[k];
    if (!flank.touches()) continue;
    const double push = data_.stiffness * flank.depth + flank.viscous;
    const spatial::PairRow wrench = -push * flank.J;
    out.on_first += {wrench.segment<3>(0).transpose(), wrench.segment<3>(3).transpose()};
    out.on_second += {wrench.segment<3>(6).transpose(), wrench.segment<3>(9).transpose()};
    out.stored_energy += 0.5 * data_.stiffness * flank.depth * flank.depth;
    out.active_power -= flank.viscous * flank.rate;
    // Nothing, elastic, or with the damper at its limit on either side.
    const int state = !flank.is_limited ? 1 : flank.viscous > 0.0 ? 2 : 3;
    out.regime += (k == 0 ? 1 : 4) * state;
  }
  out.dissipation = -out.active_power;
  return out;
}

void ElasticGear::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  for (const Flank& flank : look(sight)) {
    SoftRow row;
    row.J = flank.J;
    if (flank.touches() && !(flank.is_limited && flank.viscous < 0.0)) {
      // Where the damper pushes with all the force of the spring the damping is no tangent, but
      // never less steep than the force on the way out: a flatter one would jump out and back.
      row.stiffness = (flank.is_limited ? 2.0 : 1.0) * data_.stiffness;
      row.damping = data_.damping;
    }
    rows.push_back(row);
  }
}

ElasticGear::Reading ElasticGear::read(const Sight& sight) const {
  Reading out;
  const std::array<Flank, 2> flanks = look(sight);
  for (std::size_t k = 0; k < flanks.size(); ++k) {
    const Flank& flank = flanks[k];
    if (!flank.touches()) continue;
    const double push = data_.stiffness * flank.depth + flank.viscous;
    out.force += kSides[k] * push / data_.cosine;
    out.deflection += kSides[k] * flank.depth * data_.cosine;
  }
  return out;
}

double ElasticGear::meshed_at(double g) const {
  return mesh_.pitch() * std::round(g / mesh_.pitch());
}

void ElasticGear::start_states(const Sight& sight, double* states) const {
  Sight fresh = sight;
  fresh.states = nullptr;
  find_states(fresh, states);
  states[kMiddle] = meshed_at(mesh_.evaluate(sight.first, sight.second, sight.t, states).g);
}

void ElasticGear::restart_states(const Sight& sight, double* states) const {
  start_states(sight, states);
  states[kMiddle] = 0.0;
  states[kMiddle] = mesh_.evaluate(sight.first, sight.second, sight.t, states).g;
}

void ElasticGear::find_states(const Sight& sight, double* states) const {
  MeshStates before{}, after{};
  if (sight.states != nullptr) std::copy_n(sight.states, kFlank, before.begin());
  mesh_.follow(sight.first, sight.second, 0.0, sight.t,
               sight.states != nullptr ? before.data() : nullptr, after.data());
  const double middle = sight.states != nullptr ? sight.states[kMiddle] : 0.0;
  std::copy_n(after.begin(), kFlank, states);
  states[kMiddle] = middle;
}

}  // namespace buckens::model

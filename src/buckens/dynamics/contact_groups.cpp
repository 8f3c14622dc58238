// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/contact_groups.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_friction.h"
#include "buckens/loads/near_pairs.h"
#include "buckens/model/contact_group.h"

namespace buckens::dynamics {

using model::ContactGroup;
using model::ContactMember;
using model::NearPair;

namespace {

// How far around a shape others count as near, as a share of its size; and how much further than it
// moves in a step of the present length.
constexpr double kMargin = 0.02;
constexpr double kStepsAhead = 2.0;
// Nothing is looked for further away than this many times its size: what moves that far in a step
// passes through others anyway.
constexpr double kFarthest = 1.0;
// Margins within which pairs of rigid groups stay: what goes to and fro does not come anew each
// time.
constexpr double kKeeps = 2.0;

/// A near pair at one instant.
struct PairAt {
  const ContactGroup& group;
  const ContactMember& first;
  const ContactMember& second;
  body::MarkerKinematics first_at, second_at;
  loads::Contact contact;

  PairAt(const model::Model& model, const NearPair& pair, const std::vector<BodyMotion>& motions)
      : group(*model.contact_groups[static_cast<std::size_t>(pair.group)]),
        first(group.members[static_cast<std::size_t>(pair.first)]),
        second(group.members[static_cast<std::size_t>(pair.second)]),
        first_at(evaluate_marker(model, first.marker, motions)),
        second_at(evaluate_marker(model, second.marker, motions)),
        contact(group.contact(static_cast<std::size_t>(pair.first),
                              static_cast<std::size_t>(pair.second))) {}

  loads::Sight sight(double t, const double* states, std::span<const double> signals) const {
    return {t, first_at.motion, second_at.motion, {}, {}, states, {}, signals};
  }
};

/// Calls f(pair, its states or null) for all near pairs that are switched on.
template <class F>
void for_near_pairs(const model::Model& model, const std::vector<BodyMotion>& motions,
                    const model::RowMemory* memory, F&& f) {
  if (model.contact_groups.empty()) return;
  if (memory == nullptr) {
    for (const NearPair& pair : find_near(model, motions, 0.0)) {
      f(PairAt(model, pair, motions), nullptr);
    }
    return;
  }
  const double* states = memory->near_states.data();
  for (const NearPair& pair : memory->near) {
    const PairAt at(model, pair, motions);
    if (!memory->is_off(at.group.load)) f(at, states);
    states += at.contact.num_states();
  }
}

/// Speed of the fastest point of a shape [m/s]; of unbounded ones that of its marker.
double fastest(const loads::ContactShape& shape, const spatial::MarkerMotion& at) {
  const double reach = shape.kind == loads::ContactShape::Kind::plane
                           ? 0.0
                           : shape.radius + shape.half_length + shape.half.norm();
  return at.v.norm() + reach * at.w.norm();
}

double least_gap(const loads::ContactPair& pair, const spatial::MarkerMotion& first,
                 const spatial::MarkerMotion& second) {
  loads::ContactPair::Spots spots;
  const Eigen::Matrix3d R_FW = first.R.transpose();
  pair.find(R_FW * (second.p - first.p), R_FW * second.R, spots);
  double gap = HUGE_VAL;
  for (int k = 0; k < pair.num_spots(); ++k) {
    gap = std::min(gap, spots[static_cast<std::size_t>(k)].gap);
  }
  return gap;
}

/// What is known of the members of a group; kept, so that steps allocate nothing.
struct MemberBuffers {
  std::vector<spatial::MarkerMotion> at;
  std::vector<double> margin;
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<std::pair<int, int>> pairs;
};

/// How far around shapes others are looked for.
struct Margins {
  double ahead = 0;  ///< time over which they move [s]
  double widen = 1;  ///< factor of all margins
  double farthest = kFarthest;

  /// @param speed of the fastest point of a shape [m/s], @param size of it [m]
  double of(double speed, double size) const {
    if (ahead == 0.0) return 0.0;
    const double moves = speed > 0.0 ? kStepsAhead * ahead * speed : 0.0;
    if (std::isinf(size)) return widen * moves;
    return widen * (kMargin * size + (moves > farthest * size ? farthest * size : moves));
  }
  /// Whether gaps say how far apart shapes are: of those that are near each other.
  bool by_gaps() const { return !std::isinf(farthest); }
};

void find_near_in(const model::Model& model, std::size_t number,
                  const std::vector<BodyMotion>& motions, const Margins& margins,
                  std::vector<NearPair>& out) {
  const ContactGroup& group = *model.contact_groups[number];
  const std::size_t count = group.members.size();
  thread_local MemberBuffers kept;
  auto& [at, margin, boxes, pairs] = kept;
  at.resize(count);
  margin.resize(count);
  boxes.resize(count);
  pairs.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const ContactMember& member = group.members[k];
    at[k] = evaluate_marker(model, member.marker, motions).motion;
    margin[k] = margins.of(fastest(member.shape, at[k]), loads::size_of(member.shape));
    boxes[k] = loads::bounding_box(member.shape, at[k]);
    boxes[k].min().array() -= margin[k];
    boxes[k].max().array() += margin[k];
  }
  loads::find_overlapping(boxes, pairs);
  for (const auto& [a, b] : pairs) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (!group.can_touch(i, j)) continue;
    const auto [first, second] = group.ordered(i, j);
    const loads::ContactPair pair(group.members[first].shape, group.members[second].shape);
    const bool is_endless = !boxes[i].sizes().allFinite() || !boxes[j].sizes().allFinite();
    if ((is_endless || margins.by_gaps()) &&
        least_gap(pair, at[first], at[second]) > margin[i] + margin[j]) {
      continue;
    }
    out.push_back({static_cast<int>(number), static_cast<int>(first), static_cast<int>(second)});
  }
}

/// @param rigid of which groups
void find_near_into(const model::Model& model, const std::vector<BodyMotion>& motions,
                    const Margins& margins, bool rigid, std::vector<NearPair>& out) {
  out.clear();
  for (std::size_t k = 0; k < model.contact_groups.size(); ++k) {
    if (model.contact_groups[k]->rigid.has_value() != rigid) continue;
    find_near_in(model, k, motions, margins, out);
  }
  std::sort(out.begin(), out.end());
}

/// Finds pairs and room for their states.
void find_pairs(const model::Model& model, const std::vector<BodyMotion>& motions, double ahead,
                const model::RowMemory& before, model::RowMemory& out) {
  find_near_into(model, motions, {ahead}, false, out.near);
  std::erase_if(out.near, [&](const NearPair& pair) {
    return before.is_off(model.contact_groups[static_cast<std::size_t>(pair.group)]->load);
  });
}

}  // namespace

std::vector<NearPair> find_near(const model::Model& model, const std::vector<BodyMotion>& motions,
                                double ahead) {
  std::vector<NearPair> out;
  find_near_into(model, motions, {ahead}, false, out);
  return out;
}

namespace {

std::vector<NearPair> find_rigid_within(const model::Model& model,
                                        const std::vector<BodyMotion>& motions,
                                        const Margins& margins) {
  std::vector<NearPair> out, wide, kept;
  find_near_into(model, motions, margins, true, out);
  find_near_into(model, motions, {margins.ahead, kKeeps, margins.farthest}, true, wide);
  for (const model::PairLoads& known : model.pair_loads) {
    const bool stays = std::binary_search(wide.begin(), wide.end(), known.pair) &&
                       !std::binary_search(out.begin(), out.end(), known.pair);
    if (stays) kept.push_back(known.pair);
  }
  out.insert(out.end(), kept.begin(), kept.end());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::vector<NearPair> find_rigid_pairs(const model::Model& model,
                                       const std::vector<BodyMotion>& motions, double ahead) {
  return find_rigid_within(model, motions, {ahead});
}

std::vector<NearPair> find_rigid_pairs_on(const model::Model& model,
                                          const std::vector<BodyMotion>& motions) {
  return find_rigid_within(model, motions, {1.0, 1.0, HUGE_VAL});
}

void add_group_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const Circumstances& around, Forces& out) {
  for_near_pairs(model, motions, around.memory, [&](const PairAt& at, const double* states) {
    const loads::Action action = at.contact.respond(at.sight(t, states, signals_of(around)));
    add_wrench(model, at.first.marker, at.first_at, action.on_first, out);
    add_wrench(model, at.second.marker, at.second_at, action.on_second, out);
    out.stored_energy += action.stored_energy;
    out.active_power += action.active_power;
    out.dissipation += action.dissipation;
    if (!out.of_loads.empty()) out.of_loads[at.group.load].add(action);
    out.regimes.push_back(action.regime);
  });
}

void append_group_tangents(const model::Model& model, const std::vector<BodyMotion>& motions,
                           double t, const Circumstances& around, SoftRows& out) {
  const std::size_t before = out.rows.size();
  for_near_pairs(model, motions, around.memory, [&](const PairAt& at, const double* states) {
    const loads::Sight sight = at.sight(t, states, signals_of(around));
    out.of_one.clear();
    at.contact.append_tangent(sight, out.of_one);
    out.regimes.push_back(at.contact.respond(sight).regime);
    for (const loads::SoftRow& row : out.of_one) {
      out.rows.push_back(
          system_row(model, at.first.marker, at.first_at, at.second.marker, at.second_at, row.J));
      out.stiffness.push_back(row.stiffness);
      out.damping.push_back(row.damping);
      out.rigid.push_back(-1);
      out.is_closed.push_back(0);
    }
  });
  out.num_of_groups = static_cast<int>(out.rows.size() - before);
}

void start_near(const model::Model& model, const std::vector<BodyMotion>& motions,
                model::RowMemory& out) {
  if (model.contact_groups.empty()) return;
  const model::RowMemory nothing;
  advance_near(model, motions, 0.0, {nullptr, &nothing, nullptr, nullptr}, out);
}

void advance_near(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                  const Circumstances& around, model::RowMemory& out) {
  if (model.contact_groups.empty()) return;
  const model::RowMemory& before = *around.memory;
  // Beyond the first step its length is known; margins are limited by sizes in any case.
  find_pairs(model, motions, t > before.near_time ? t - before.near_time : HUGE_VAL, before, out);
  out.near_time = t;
  thread_local std::vector<PairAt> pairs;  // kept, so that steps allocate nothing
  pairs.reserve(out.near.size());
  Eigen::Index count = 0;
  for (const NearPair& pair : out.near) {
    count += pairs.emplace_back(model, pair, motions).contact.num_states();
  }
  out.near_states.setZero(count);
  double* states = out.near_states.data();
  auto known = before.near.begin();
  const double* known_states = before.near_states.data();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    while (known != before.near.end() && *known < out.near[k]) {
      known_states += PairAt(model, *known, motions).contact.num_states();
      ++known;
    }
    const bool is_known = known != before.near.end() && *known == out.near[k];
    if (is_known) {
      pairs[k].contact.find_states(pairs[k].sight(t, known_states, signals_of(around)), states);
    } else {
      pairs[k].contact.start_states(pairs[k].sight(t, nullptr, signals_of(around)), states);
    }
    states += pairs[k].contact.num_states();
  }
  pairs.clear();
}

void restrain_near(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                   model::RowMemory& memory) {
  const linalg::Vector before = memory.near_states;
  const double* known = before.data();
  double* states = memory.near_states.data();
  for (const NearPair& pair : memory.near) {
    const PairAt at(model, pair, motions);
    const int count = at.contact.num_states();
    if (at.contact.is_changed()) {
      at.contact.find_states(at.sight(t, known, memory.signals), states);
    }
    known += count;
    states += count;
  }
}

double stored_in_group(const model::Model& model, std::size_t group,
                       const std::vector<BodyMotion>& motions, double t,
                       const Circumstances& around) {
  const ContactGroup* const own = model.contact_groups[group].get();
  double out = 0.0;
  for_near_pairs(model, motions, around.memory, [&](const PairAt& at, const double* states) {
    if (&at.group != own) return;
    out += at.contact.respond(at.sight(t, states, signals_of(around))).stored_energy;
  });
  return out;
}

namespace {

GroupReading read_rigid_group(const model::Model& model, std::size_t group,
                              const std::vector<BodyMotion>& motions, double t,
                              const Circumstances& around) {
  GroupReading out;
  for (const model::PairLoads& pair : model.pair_loads) {
    if (static_cast<std::size_t>(pair.pair.group) != group) continue;
    if (around.memory != nullptr && around.memory->is_off(pair.first)) continue;
    const model::Load& any = model.loads[pair.first];
    const auto first = evaluate_marker(model, any.first, motions).motion;
    const auto second = evaluate_marker(model, any.second, motions).motion;
    Eigen::Vector3d friction = Eigen::Vector3d::Zero();
    bool touches = false;
    for (std::size_t k = pair.first; k < pair.first + pair.count; ++k) {
      const auto& law = static_cast<const loads::RigidLaw&>(*model.loads[k].element);
      const loads::Sight sight = sight_of(model, k, t, around, first, second);
      const loads::Action action = law.respond(sight);
      if (dynamic_cast<const loads::ContactFriction*>(&law) != nullptr) {
        friction += action.on_second.force;
        continue;
      }
      out.normal += std::abs(action.along_coordinate);
      touches = touches || sight.stand.regime != 0;
    }
    out.friction += friction.norm();
    out.touching += touches ? 1 : 0;
  }
  return out;
}

}  // namespace

GroupReading read_group(const model::Model& model, std::size_t group,
                        const std::vector<BodyMotion>& motions, double t,
                        const Circumstances& around) {
  GroupReading out;
  const ContactGroup* const own = model.contact_groups[group].get();
  if (own->rigid) return read_rigid_group(model, group, motions, t, around);
  for_near_pairs(model, motions, around.memory, [&](const PairAt& at, const double* states) {
    if (&at.group != own) return;
    const loads::ContactReading one = at.contact.read(at.sight(t, states, signals_of(around)));
    out.normal += one.normal;
    out.friction += one.friction;
    out.touching += one.gap < 0.0 ? 1 : 0;
  });
  return out;
}

}  // namespace buckens::dynamics

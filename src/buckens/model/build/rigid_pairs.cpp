// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/rigid_pairs.h"

#include <algorithm>

#include "buckens/loads/elastic_contact.h"
#include "buckens/model/build/rigid_touches.h"

namespace buckens::model {

namespace {

spatial::Pose as_placed(const Model& model, const MarkerId& id) {
  if (id.body == kGround) return id.X_WF;
  const auto b = static_cast<std::size_t>(id.body);
  return model.placed[b] * model.bodies[b].markers[static_cast<std::size_t>(id.marker)].X_BF;
}

}  // namespace

std::vector<spatial::RigidTouch> touches_of(const Model& model, const ContactMember& first,
                                            const ContactMember& second) {
  const spatial::Pose X_WF = as_placed(model, first.marker);
  const spatial::Pose X_WM = as_placed(model, second.marker);
  joints::Placement placed;
  placed.R_WF = X_WF.R();
  placed.R_WM = X_WM.R();
  placed.r_F = placed.R_WF.transpose() * (X_WM.p - X_WF.p);
  std::optional<Eigen::Vector3d> normal;
  if (model.planar) normal = spatial::normal(*model.planar);
  return rigid_touches(loads::ContactPair(first.shape, second.shape), placed, normal);
}

bool RigidPairs::are_needed(const Model& model) {
  return std::any_of(model.contact_groups.begin(), model.contact_groups.end(),
                     [](const auto& group) { return group->rigid.has_value(); });
}

const std::vector<RigidContactRow>& RigidPairs::rows_of(const NearPair& pair) {
  const auto [place, is_new] = known_.try_emplace(pair);
  if (!is_new) return place->second;
  const ContactGroup& group = *model_.contact_groups[static_cast<std::size_t>(pair.group)];
  const ContactMember& first = group.members[static_cast<std::size_t>(pair.first)];
  const ContactMember& second = group.members[static_cast<std::size_t>(pair.second)];
  Load like;
  like.name = model_.loads[group.load].name;
  like.kind = model_.loads[group.load].kind;
  like.first = first.marker;
  like.second = second.marker;
  place->second =
      rigid_contact_rows(like, touches_of(model_, first, second), *group.rigid,
                         std::min(loads::size_of(first.shape), loads::size_of(second.shape)));
  return place->second;
}

void RigidPairs::set(const std::vector<NearPair>& pairs) {
  if (!model_.pair_loads.empty()) {
    const PairLoads& front = model_.pair_loads.front();
    model_.loads.erase(model_.loads.begin() + static_cast<std::ptrdiff_t>(front.first),
                       model_.loads.end());
    model_.coordinates.erase(model_.coordinates.begin() + front.first_coordinate,
                             model_.coordinates.end());
    model_.pair_loads.clear();
  }
  int state = model_.num_law_states();
  int rigid_row = model_.num_rigid_rows();
  for (const NearPair& pair : pairs) {
    PairLoads own;
    own.pair = pair;
    own.first = model_.loads.size();
    own.first_coordinate = static_cast<int>(model_.coordinates.size());
    own.first_state = state;
    for (const RigidContactRow& row : rows_of(pair)) {
      Load& load = model_.loads.emplace_back(row.load);
      load.coordinate = static_cast<int>(model_.coordinates.size());
      load.first_state = state;
      load.rigid_row = rigid_row++;
      state += load.element->num_states();
      model_.coordinates.push_back(row.coordinate);
    }
    own.count = model_.loads.size() - own.first;
    own.num_states = state - own.first_state;
    model_.pair_loads.push_back(own);
  }
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/contact_group.h"

#include <algorithm>

namespace buckens::model {

bool ContactGroup::can_touch(std::size_t i, std::size_t j) const {
  const ContactMember& first = members[i];
  const ContactMember& second = members[j];
  if (first.marker.body == second.marker.body) return false;
  if (has_two_lists && first.is_against == second.is_against) return false;
  const std::pair<int, int> bodies = std::minmax(first.marker.body, second.marker.body);
  return !std::binary_search(joined.begin(), joined.end(), bodies);
}

std::pair<std::size_t, std::size_t> ContactGroup::ordered(std::size_t i, std::size_t j) const {
  if (loads::ContactPair::knows(members[i].shape.kind, members[j].shape.kind)) return {i, j};
  return {j, i};
}

loads::Contact ContactGroup::contact(std::size_t first, std::size_t second) const {
  const loads::ContactPair pair(members[first].shape, members[second].shape);
  const double inertia = 1.0 / (members[first].inverse_mass + members[second].inverse_mass);
  return {pair, loads::contact_data(law, pair, inertia, gravity), settings};
}

}  // namespace buckens::model

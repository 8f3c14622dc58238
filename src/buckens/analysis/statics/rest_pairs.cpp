// SPDX-License-Identifier: Apache-2.0
// Rows at rest of pairs in groups of contacts, which come and go as the bodies move.
#include <algorithm>
#include <map>
#include <numeric>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/analysis/statics/rest_stop.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/model/contact_group.h"

namespace buckens::analysis {

using Kind = RestRow::Kind;

bool RestRows::is_off(const model::NearPair& pair) const {
  return switched_.is_off(model_.contact_groups[static_cast<std::size_t>(pair.group)]->load);
}

bool RestRows::follow_pairs(const std::vector<dynamics::BodyMotion>& way, bool keeps) {
  if (groups_ == nullptr) return false;
  std::vector<model::NearPair> now = dynamics::find_rigid_pairs_on(model_, way);
  std::erase_if(now, [this](const model::NearPair& pair) { return is_off(pair); });
  if (keeps) {
    for (const PairRows& known : order_) now.push_back(known.pair);
    std::sort(now.begin(), now.end());
    now.erase(std::unique(now.begin(), now.end()), now.end());
  }
  const auto& loads = model_.pair_loads;
  const bool are_same =
      std::equal(now.begin(), now.end(), loads.begin(), loads.end(),
                 [](const model::NearPair& a, const model::PairLoads& b) { return a == b.pair; });
  if (!are_same) groups_->set(now);
  const RestOrder before = order_;
  add_rigid_pairs();
  return order_ != before;
}

void RestRows::add_rigid_pairs() {
  rows_.resize(num_lasting_);
  order_.clear();
  for (const model::PairLoads& pair : model_.pair_loads) {
    const std::size_t before = rows_.size();
    int across = -1;
    for (std::size_t k = pair.first; k < pair.first + pair.count; ++k) {
      if (stop_of(model_.loads[k]) != nullptr) {
        across = static_cast<int>(rows_.size());
        rows_.push_back({Kind::one_sided, k});
      } else if (friction_ == model::RestFriction::frozen) {
        RestRow row{Kind::along, k};
        row.across = across;
        rows_.push_back(row);
      }
    }
    order_.push_back({pair.pair, rows_.size() - before});
  }
}

std::vector<int> RestRows::places_in(const RestOrder& then) const {
  std::vector<int> out(rows_.size(), -1);
  std::iota(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(num_lasting_), 0);
  std::map<model::NearPair, std::size_t> first_then;
  std::size_t place = num_lasting_;
  for (const PairRows& pair : then) {
    first_then.emplace(pair.pair, place);
    place += pair.count;
  }
  auto row = out.begin() + static_cast<std::ptrdiff_t>(num_lasting_);
  for (const PairRows& pair : order_) {
    const auto end = row + static_cast<std::ptrdiff_t>(pair.count);
    const auto known = first_then.find(pair.pair);
    if (known != first_then.end()) std::iota(row, end, static_cast<int>(known->second));
    row = end;
  }
  return out;
}

RestStands RestRows::carried(const RestOrder& then, const RestStands& stands) const {
  RestStands out(rows_.size());
  const std::vector<int> places = places_in(then);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (places[k] >= 0) out[k] = stands[static_cast<std::size_t>(places[k])];
  }
  return out;
}

void RestRows::add_pairs(std::size_t load) {
  RestRow row{Kind::along, load};
  for (std::size_t g = 0; g < model_.contact_groups.size(); ++g) {
    const model::ContactGroup& group = *model_.contact_groups[g];
    if (group.load != load) continue;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      for (std::size_t j = i + 1; j < group.members.size(); ++j) {
        if (!group.can_touch(i, j)) continue;
        const auto [first, second] = group.ordered(i, j);
        row.pair = static_cast<int>(pairs_.size());
        pairs_.push_back({static_cast<int>(g), static_cast<int>(first), static_cast<int>(second)});
        const int count = group.contact(first, second).num_soft_rows();
        for (row.part = 0; row.part < count; ++row.part) {
          if (row.part % RestRow::kOfSpot != 0) rows_.push_back(row);
        }
      }
    }
  }
}

/// @param soft scratch: rows of the same pair, of the row before
void RestRows::evaluate_pair(std::size_t k, const std::vector<dynamics::BodyMotion>& motions,
                             double t, std::vector<loads::SoftRow>& soft, RestValues& out) const {
  const RestRow& row = rows_[k];
  const model::NearPair& pair = pairs_[static_cast<std::size_t>(row.pair)];
  const model::ContactGroup& group = *model_.contact_groups[static_cast<std::size_t>(pair.group)];
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const model::MarkerId &first = group.members[i].marker, &second = group.members[j].marker;
  const auto first_at = dynamics::evaluate_marker(model_, first, motions);
  const auto second_at = dynamics::evaluate_marker(model_, second, motions);
  find_soft_rows(k, group.contact(i, j), {t, first_at.motion, second_at.motion}, soft, out);
  const spatial::PairRow& J = soft[static_cast<std::size_t>(row.part)].J;
  out.rows.push_back(dynamics::system_row(model_, first, first_at, second, second_at, J));
  out.values.push_back(0.0);
  out.pushes.push_back({J.segment<3>(6).transpose(), J.segment<3>(9).transpose()});
}

}  // namespace buckens::analysis

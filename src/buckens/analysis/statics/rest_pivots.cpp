// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/rest_pivots.h"

#include <algorithm>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

// Rounds in which all rows may move although no fewer of them disagree.
constexpr int kPatience = 5;
constexpr int kMostPivots = 200;
// Beyond so many, rows along a surface stay as they are: which of them are closed follows from
// others, and that may lead in circles.
constexpr int kFollowing = 60;
// Pulls of this share of the force scale, and overlaps of the length, are rounding.
constexpr double kRoundedPivot = 1e-12;

}  // namespace

std::vector<std::size_t> RestPivots::disagreeing(const StaticBalance& balance,
                                                 const linalg::Vector& step,
                                                 const StaticPoint& point) const {
  const RestRows& rest = system_.rest();
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k].kind != RestRow::Kind::one_sided) continue;
    loads::RowStand after = point.rest[k];
    if (after.regime != 0) {
      after.force += system_.force_change(k, step);
      if (system_.scaled_force(k, rest.push(k, after)) < -kRoundedPivot) out.push_back(k);
      continue;
    }
    const loads::RigidLaw::Contact& contact = balance.rest.contacts[k];
    const double gap = contact.gap + contact.sign * system_.gap_change(k, step);
    if (system_.scaled_gap(k, gap) < -kRoundedPivot) out.push_back(k);
  }
  return out;
}

RestPivots::Outcome RestPivots::revise(const StaticBalance& balance, const linalg::Vector& step,
                                       StaticPoint& point) {
  const RestRows& rest = system_.rest();
  std::vector<std::size_t> rows = disagreeing(balance, step, point);
  if (rows.empty()) return Outcome::settled;
  if (++rounds_ > kMostPivots) {
    lost_text_ = fmt::format(
        "static equilibrium: load \"{}\" and {} other rigid rows find no stand, pressing or open, "
        "that suits all of them ({} changes); give one of them a `stiffness`",
        rest.name(rows.back()), rows.size() - 1, kMostPivots);
    return Outcome::lost;
  }
  if (rows.size() < fewest_) {
    fewest_ = rows.size();
    patience_ = kPatience;
  } else if (patience_ > 0) {
    --patience_;
  } else {
    rows = {rows.back()};
  }
  for (const std::size_t k : rows) {
    loads::RowStand& stand = point.rest[k];
    stand.regime = stand.regime != 0 ? 0 : balance.rest.contacts[k].regime;
  }
  if (rounds_ <= kFollowing) rest.follow_contacts(balance.rest, point.rest);
  return Outcome::moved;
}

}  // namespace buckens::analysis

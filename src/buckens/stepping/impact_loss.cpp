// SPDX-License-Identifier: Apache-2.0
// Energy lost in impacts. Theory: docs/theory/23-impacts.md §2.
#include <algorithm>
#include <cmath>
#include <map>

#include "buckens/stepping/impacts.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

// Energy that impulses give the bodies, divided by what they take from them: 1 if all of it is
// returned. What accelerates bodies between the instant of the impact and the end of the step, and
// restitution that depends on friction, may make it a little more; wedges made it thousands of
// times as much.
constexpr double kMostGiven = 1.25;

}  // namespace

double Impacts::rate_of(const dynamics::SystemRow& row,
                        const std::vector<dynamics::BodyMotion>& motions) {
  double sum = 0;
  for (const dynamics::BodyRow* part : row.parts()) {
    if (part->body != model::kGround)
      sum += part->rate(motions[static_cast<std::size_t>(part->body)]);
  }
  return sum;
}

void Impacts::lose(const Vector& P, const Vector& jump,
                   const std::vector<dynamics::BodyMotion>& end) {
  for (std::size_t k = 0; k < num_pushes(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const bool is_slip = k >= touches_.size();
    const Touch& touch = touches_[is_slip ? slips_[k - touches_.size()].touch : k];
    const Law& law = laws_[touch.law];
    const std::size_t load = is_slip ? friction_of(slips_[k - touches_.size()]).load : law.load;
    if (moves_mesh(law)) {
      lose(load, is_slip ? loss_of_slip(slips_[k - touches_.size()], P[i], jump[i])
                         : loss_on_mesh(touch, P[i], jump[i]));
      continue;
    }
    const double rate_end = rate_of(push(k).row, end), rate_start = rate_of(push(k).row, start_);
    const double met = rate_end + touch.rest / scheme_.h * (rate_start - rate_end);
    const double loss = -P[i] * (met + 0.5 * jump[i]);
    // What strikes returns no energy: a negative loss comes from lifting bodies out of an end that
    // they were in before, and is left for the balance to show.
    const bool gives_nothing = !is_slip && touch.strikes && !touch.is_wedged;
    lose(load, gives_nothing ? std::max(0.0, loss) : loss);
  }
}

double Impacts::loss_on_mesh(const Touch& touch, double P, double jump) const {
  if (!(touch.approach > 0.0)) return 0.0;
  return 0.5 * touch.lost_share * P * (touch.approach - touch.met - jump);
}

double Impacts::loss_of_slip(const Slip& slip, double P, double jump) const {
  const double after = slip.speed + jump;
  // If friction holds, its work on the motion due to weight within the rest of the step is no loss;
  // if it slides, all of its work on the way is.
  const bool holds =
      !touches_[slip.touch].is_of_step && std::abs(after) <= Slip::kStopped * std::abs(slip.speed);
  const double share =
      holds && slip.speed != 0.0 ? std::clamp(slip.at_impact / slip.speed, 0.0, 1.0) : 1.0;
  return -0.5 * share * P * (slip.at_impact + after);
}

std::vector<Eigen::Index> Impacts::gaining(const Vector& P, const Vector& jump,
                                           const std::vector<dynamics::BodyMotion>& end) const {
  struct Exchange {
    double taken = 0, given = 0;  // by stopping the bodies, and by moving them afterwards [J]
    bool has_mesh = false;
  };
  std::map<std::size_t, Exchange> exchanges;  // by island
  const auto touch_of = [&](std::size_t k) -> const Touch& {
    return touches_[k < touches_.size() ? k : slips_[k - touches_.size()].touch];
  };
  for (std::size_t k = 0; k < num_pushes(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    Exchange& own = exchanges[island_of(touch_of(k))];
    own.taken -= P[i] * rate_of(push(k).row, end);
    own.given += 0.5 * P[i] * jump[i];
    own.has_mesh = own.has_mesh || moves_mesh(laws_[touch_of(k).law]);
  }
  std::vector<Eigen::Index> out;
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Exchange& own = exchanges[island_of(touches_[k])];
    if (own.has_mesh || !(own.given > kMostGiven * own.taken)) continue;
    out.push_back(static_cast<Eigen::Index>(k));
  }
  return out;
}

bool Impacts::stay_on_meshes() const {
  bool has_any = false;
  for (const Touch& touch : touches_) {
    if (touch.is_of_step) return false;
    has_any = has_any || (touch.strikes && moves_mesh(laws_[touch.law]));
  }
  return has_any;
}

void Impacts::lose_in_all(double energy) {
  const double known = loss_;
  loss_ = std::max(0.0, energy);
  if (known > 0.0) {
    for (ImpactShare& share : shares_) share.energy *= loss_ / known;
    return;
  }
  for (ImpactShare& share : shares_) share.energy = loss_ / static_cast<double>(shares_.size());
}

void Impacts::lose(std::size_t load, double energy) {
  loss_ += energy;
  shares_.push_back({load, energy});
}

}  // namespace buckens::stepping

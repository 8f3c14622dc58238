// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/held_spots.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/statics/rest_rows.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

// What the cosine of the angle between normals of a plane face may leave to one.
constexpr double kSameNormal = 1e-9;

}  // namespace

void HeldSpots::look(const loads::Contact& contact, const loads::Sight& sight) {
  R_ = sight.first.R;
  const Eigen::Matrix3d R_FW = R_.transpose();
  loads::ContactPair::Spots found;
  contact.pair().find(R_FW * (sight.second.p - sight.first.p), R_FW * sight.second.R, found);
  spots_.clear();
  for (int k = 0; k < contact.pair().num_spots(); ++k) {
    const loads::ContactSpot& spot = found[static_cast<std::size_t>(k)];
    spots_.push_back({spot.place, spot.normal, spot.gap});
  }
}

double HeldSpots::gap() const {
  double out = HUGE_VAL;
  for (const Spot& spot : spots_) out = std::min(out, spot.gap);
  return out;
}

bool HeldSpots::is_near(std::size_t spot, double reach) const {
  return spots_[spot].gap >= 0.0 && spots_[spot].gap < reach;
}

void HeldSpots::level(double reach, std::vector<loads::SoftRow>& rows) const {
  for (std::size_t k = 0; k < spots_.size(); ++k) {
    const Vector3d& normal = spots_[k].normal;
    double sum = 0.0;
    int count = 0;
    for (const Spot& other : spots_) {
      if (!(other.gap < reach) || !(other.normal.dot(normal) > 1.0 - kSameNormal)) continue;
      sum += other.place.dot(normal);
      ++count;
    }
    if (!(spots_[k].gap < reach) || count < 2) continue;
    const Vector3d shift = R_ * normal * (sum / count - spots_[k].place.dot(normal));
    for (std::size_t along = 1; along < RestRow::kOfSpot; ++along) {
      spatial::PairRow& J = rows[RestRow::kOfSpot * k + along].J;
      const Vector3d turn = shift.cross(Vector3d(J.segment<3>(9).transpose()));
      J.segment<3>(0) -= turn.transpose();
      J.segment<3>(6) += turn.transpose();
    }
  }
}

}  // namespace buckens::analysis

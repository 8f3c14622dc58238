// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/contact.h"

namespace buckens::analysis {

/// The spots of an elastic contact in one configuration, as frozen friction sees them.
class HeldSpots {
 public:
  void look(const loads::Contact& contact, const loads::Sight& sight);
  /// Least distance, negative: overlap [m].
  double gap() const;
  /// Whether a spot is open by less than `reach` [m].
  bool is_near(std::size_t spot, double reach) const;
  /// Moves the rows along a plane face into one plane, the mean of those of its spots that are not
  /// farther than `reach`. They sink in by different amounts: rows that are not in one plane would
  /// hold the face from rocking on its springs, with forces that cancel each other.
  /// @param rows as Contact::append_tangent() gives them
  void level(double reach, std::vector<loads::SoftRow>& rows) const;

 private:
  struct Spot {
    Eigen::Vector3d place, normal;  ///< in axes of the first marker
    double gap = 0;                 ///< [m]
  };
  Eigen::Matrix3d R_;  // of the first marker
  std::vector<Spot> spots_;
};

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <utility>

#include "buckens/spatial/marker_motion.h"

namespace buckens::loads {

/// Where one body is in the axes of another.
struct RelativePose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();  ///< orientation of the second in the first
  Eigen::Vector3d r = Eigen::Vector3d::Zero();  ///< origin of the second in axes of the first [m]

  static RelativePose of(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second) {
    return {first.R.transpose() * second.R, first.R.transpose() * (second.p - first.p)};
  }
};

/// What was found for the last pose, which is asked for several times in a row: value, rates and
/// accelerations of one place. It depends on the pose alone, so nothing changes by remembering.
template <class Found>
class PoseMemory {
 public:
  /// @param find (pose) → Found
  template <class Find>
  Found at(const RelativePose& pose, Find&& find) {
    {
      const std::lock_guard<std::mutex> lock(access_);
      if (pose.R == pose_.R && pose.r == pose_.r) return found_;
    }
    Found found = std::forward<Find>(find)(pose);
    const std::lock_guard<std::mutex> lock(access_);
    pose_ = pose;
    found_ = found;
    return found;
  }

 private:
  std::mutex access_;
  RelativePose pose_;  // a rotation that is zero is no pose
  Found found_{};
};

}  // namespace buckens::loads

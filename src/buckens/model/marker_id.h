// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/spatial/pose.h"

namespace buckens::model {

/// Body index that stands for the ground.
inline constexpr int kGround = -1;

/// A marker of a body, or a frame fixed to the ground.
struct MarkerId {
  int body = kGround;
  int marker = 0;      ///< index into Body::markers; unused on the ground
  spatial::Pose X_WF;  ///< ground only
  std::string text;    ///< as named in the model file, for messages
};

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "buckens/base/source_location.h"

namespace buckens::base {

/// Name of a marker as in a model file: "ground", "rod", "rod/end", {ground: [x, y, z]}.
struct MarkerRef {
  std::string body;  ///< "ground" or the name of a body
  /// The part after the slash; empty means the body frame (its mass centre). "origin", "com",
  /// "start", "mid" and "end" are predefined, followed by the body's nodes and markers.
  std::string marker;
  std::optional<Eigen::Vector3d> point;  ///< on the ground: place in the world [m]
  SourceLocation where;
  std::string text;  ///< as written, for messages

  bool is_ground() const { return body == "ground"; }
};

}  // namespace buckens::base

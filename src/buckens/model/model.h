// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/joints/joint.h"
#include "buckens/loads/force_element.h"
#include "buckens/model/whole_body.h"
#include "buckens/spatial/plane.h"

namespace buckens::model {

/// Index of the ground in place of a body.
inline constexpr int kGround = -1;

/// A marker of a body, or a frame fixed to the ground.
struct MarkerId {
  int body = kGround;
  int marker = 0;      ///< index into Body::markers; unused on the ground
  spatial::Pose X_WF;  ///< ground only
  std::string text;    ///< as the model file names it, for messages
};

/// Joint between two markers with its place in λ.
struct Joint {
  std::string name;
  joints::JointType type = joints::JointType::fixed;
  MarkerId first, second;
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();
  std::vector<joints::ConstraintRow> rows;
  int first_row = 0;     ///< of λ
  SourceLocation where;  ///< in the model file; that of the body for ties
  /// Holds the parts of a divided body together; stands in no model file.
  bool is_tie = false;
};

/// Load or force law between two markers.
struct Load {
  std::string name;
  std::unique_ptr<loads::ForceElement> element;
  MarkerId first, second;
};

/// A checked mechanism: bodies, joints and loads. Never changes after build().
struct Model {
  std::string title;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²] world
  std::optional<spatial::Plane> planar;
  std::vector<body::Body> bodies;
  /// The bodies of the model file in its order. Empty in models made without one.
  std::vector<WholeBody> wholes;
  std::vector<Joint> joints;
  std::vector<Load> loads;
  std::vector<spatial::Pose> placed;  ///< X_WB of each body as placed
  double length = 1.0;                ///< characteristic length L [m]
  std::vector<std::string> notes;     ///< what a user should know about the model

  int num_constraint_rows() const;
  /// Joint and row within it that own a row of λ.
  std::pair<const Joint*, int> owner_of_row(int row) const;
  int find_body(const std::string& name) const;
  /// Index into `wholes` of the body with this name, −1 if there is none.
  int find_whole(const std::string& name) const;
  /// Index into `wholes` of the whole to which a body belongs.
  int whole_of(int body) const;
};

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "buckens/fem/constraint/node_region.h"

namespace buckens::model {

/// An interface of a body with its nodes.
struct InterfaceRegion {
  std::string name;
  fem::NodeRegion region;
  bool is_rigid = false;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< place of its frame, model axes [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

}  // namespace buckens::model

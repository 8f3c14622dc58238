// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/model_scales.h"

#include <algorithm>

namespace buckens::dynamics {

linalg::Vector row_lengths(const model::Model& model) {
  linalg::Vector out = linalg::Vector::Ones(model.num_constraint_rows());
  for (const model::Joint& joint : model.joints) {
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      if (joint.rows[k].is_length()) out[joint.first_row + static_cast<int>(k)] = model.length;
    }
  }
  return out;
}

double rounding_length(const model::Model& model, const std::vector<spatial::Pose>& X_WB) {
  double out = model.length;
  for (const spatial::Pose& X : X_WB) out = std::max(out, X.p.cwiseAbs().maxCoeff());
  return out;
}

double rounding_length(const model::Model& model, const std::vector<BodyMotion>& motions) {
  double out = model.length;
  for (const BodyMotion& motion : motions) {
    out = std::max(out, motion.frame.X_WB.p.cwiseAbs().maxCoeff());
  }
  return out;
}

double shortest_lever(const model::Model& model) {
  double out = model.length;
  for (const model::Joint& joint : model.joints) {
    for (const model::MarkerId* end : {&joint.first, &joint.second}) {
      if (end->body == model::kGround) continue;
      const body::Body& body = model.bodies[static_cast<std::size_t>(end->body)];
      if (body.rotation_basis.cols() == 0) continue;
      const double z = body.markers[static_cast<std::size_t>(end->marker)].X_BF.p.norm();
      const double gyration = body.length_scale();
      // At the mass centre itself a joint turns nothing.
      if (z > 0.0) out = std::min(out, (gyration * gyration + z * z) / z);
    }
  }
  return out;
}

}  // namespace buckens::dynamics

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/results/observation.h"

namespace buckens::results {

/// Results of a divided body as a whole. Axes: those of model::whole_motion().
///
/// For an undivided body `frame` is the frame of its one body.
class DividedBody {
 public:
  DividedBody(const model::Model& model, const model::WholeBody& whole)
      : model_(model), whole_(whole) {}

  /// Displacement of a marker's origin from its undeformed position [m].
  Eigen::Vector3d displacement(const Observation& now, const model::MarkerId& id) const;
  /// Undeformed position of a marker's origin in the frame of the whole [m].
  Eigen::Vector3d place(const model::MarkerId& id) const;

  /// Appends translation [m] and rotation vector [rad] of every node of the whole mesh.
  void append_displacements(const Observation& now, std::vector<double>& values) const;

  /// Columns of a per-element table (section forces, stresses) in the order of the whole mesh.
  /// @param tables one per body of the model
  void append_elements(const std::vector<linalg::Matrix>& tables,
                       std::vector<double>& values) const;

  /// Von Mises stresses of the solid elements in the order of the whole mesh [Pa].
  /// @param tables one per body of the model, see Observation::solid_stresses
  void append_solid_stresses(const std::vector<linalg::Matrix>& tables,
                             std::vector<double>& values) const;

  /// Joints of the model that tie its parts, in the order of cut_force.
  std::vector<std::size_t> ties() const;
  /// Appends force [N] and torque [N m] at each tie on the part with the higher number, in the axes
  /// of the part with the lower.
  void append_cut_forces(const Observation& now, std::vector<double>& values) const;

 private:
  const body::FrameMotion& frame(const Observation& now) const;

  const model::Model& model_;
  const model::WholeBody& whole_;
};

}  // namespace buckens::results

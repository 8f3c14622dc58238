// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/name_index.h"
#include "buckens/model/build/marker_table.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// Finds what a joint, load or sensor of the model file is attached to, while the model is built.
class MarkerFinder {
 public:
  /// @param tables one per body of `model`; both outlive the finder
  MarkerFinder(Model& model, const std::vector<std::unique_ptr<MarkerTable>>& tables)
      : model_(model), tables_(tables) {}

  /// @param needs_mesh true where a force acts: see MarkerTable::find
  /// @throws InputError with the nearest name if body or marker are unknown
  MarkerId marker(const base::MarkerRef& ref, bool needs_mesh);

  /// Pose in the world with the bodies as placed.
  spatial::Pose placed(const MarkerId& id) const;

  /// Relative placement of two markers for a joint between them.
  joints::Placement placement(const MarkerId& first, const MarkerId& second) const;

  /// The given axis, or the normal of a planar model in the axes of the first marker.
  /// @throws InputError if neither exists
  Eigen::Vector3d axis_or_normal(const std::optional<Eigen::Vector3d>& axis,
                                 const Eigen::Matrix3d& R_WF, const std::string& what,
                                 const SourceLocation& where) const;

  /// @param axis_W unit vector in the world, @param of "a belt", for the message
  /// @throws InputError if a planar model has its plane elsewhere than across the axis
  void require_across_plane(const Eigen::Vector3d& axis_W, const char* of, const std::string& what,
                            const SourceLocation& where) const;

  /// @throws ModelError if the marker's mesh has no rotations
  void require_moment(const MarkerId& id, const std::string& what,
                      const SourceLocation& where) const;
  /// @throws ModelError if both markers are on the same body or both on the ground
  void require_two_bodies(const MarkerId& first, const MarkerId& second, const std::string& what,
                          const SourceLocation& where) const;

  Model& model() { return model_; }
  MarkerTable& table(int body) { return *tables_[static_cast<std::size_t>(body)]; }

 private:
  const body::Marker* on_body(const MarkerId& id) const;
  /// Body of the model that holds a marker of a whole body.
  int body_of(const WholeBody& whole, const std::string& marker) const;

  Model& model_;
  base::NameIndex wholes_;  // of those of the model
  const std::vector<std::unique_ptr<MarkerTable>>& tables_;
};

}  // namespace buckens::model

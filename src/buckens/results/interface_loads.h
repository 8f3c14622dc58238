// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/build/field_places.h"
#include "buckens/model/state.h"
#include "buckens/results/field_layout.h"

namespace buckens::results {

/// Forces and torques on one body of the model file, place by place.
///
///     fields/bodies/<body>/interfaces/<place>   {6}  of all joints, springs and concentrated loads
///                                                    at a marker, torque about its origin
///     fields/bodies/<body>/loads/<load>         {6}  resultant of a load on a part of the body,
///                                                    torque about the origin of the body frame
///
/// Components are in world axes and act on the body. Gravity is not a load at a place; joints
/// between the parts of a divided body are not external loads.
class InterfaceLoads {
 public:
  /// @param model outlives the object
  InterfaceLoads(const model::Model& model, const model::FieldPlaces& places);

  bool is_empty() const { return places_.empty(); }
  void add_channels(FieldLayout& layout) const;

  /// Appends the values of all places.
  /// @param motions of all bodies, see dynamics::motions_of
  /// @param lambda multipliers of the joints
  /// @param load_factor multiplies applied loads
  void append(const model::State& state, const std::vector<dynamics::BodyMotion>& motions,
              const linalg::Vector& lambda, double load_factor, std::vector<double>& values) const;

 private:
  enum class Side { first, second, other };
  struct Share {
    std::size_t index = 0;  // of the joint or load in the model
    bool is_joint = false;
    Side side = Side::first;
    std::size_t coupled = 0;  // which coordinate of a coupler; which of Load::others
  };
  struct Place {
    std::string path;             // after the body's: "interfaces/end"
    bool is_distributed = false;  // torque about the frame of the body rather than the marker
    std::vector<Share> shares;
  };

  void add(const std::string& path, bool is_distributed, const Share& share);
  /// The joint on whose markers a joint acts: itself, of a coupler that of one of its coordinates.
  const model::Joint& markers_of(const model::Joint& joint, std::size_t coupled) const;
  bool is_of_body(const model::MarkerId& id) const;
  const model::MarkerId& marker_of(const Share& share) const;
  spatial::Wrench wrench_of(const Share& share, const model::State& state,
                            const std::vector<dynamics::BodyMotion>& motions,
                            const linalg::Vector& lambda, double load_factor) const;

  const model::Model& model_;
  int whole_;
  std::vector<Place> places_;
};

}  // namespace buckens::results

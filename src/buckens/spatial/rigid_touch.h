// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/spatial/marker_motion.h"

namespace buckens::spatial {

/// Where two surfaces touch, or are next to each other, at one instant. World axes.
struct TouchPlace {
  Eigen::Vector3d place;                 ///< between both [m]; at planes on the second surface
  Eigen::Vector3d normal;                ///< unit vector from the first to the second
  std::array<Eigen::Vector3d, 2> along;  ///< unit vectors in the surface
  double gap = 0;                        ///< [m]
  Eigen::Vector3d place_rate;            ///< with which the place moves in space [m/s]
  Eigen::Vector3d normal_rate;           ///< [1/s]

  /// Row of the relative velocity of both bodies at the place along a direction.
  PairRow row(const Eigen::Vector3d& direction, const MarkerMotion& F, const MarkerMotion& M) const;
  /// Velocity of the second body over the first one at the place [m/s].
  Eigen::Vector3d velocity(const MarkerMotion& F, const MarkerMotion& M) const;
};

/// A sphere or a point of M that touches a plane, a sphere or a socket of F in one place.
///
/// Directions in the surface are those of F where the normal is as placed, turned with it on the
/// shortest way; in planar models the first one lies in the plane. Theory:
/// docs/theory/25-contact.md §4.
class RigidTouch {
 public:
  enum class Surface { plane, sphere, socket };
  struct Data {
    Surface surface = Surface::plane;
    /// Unit vector in F: of a plane its normal; of others the normal as placed.
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    double first_radius = 0;                           ///< of a sphere or socket of F [m]
    double radius = 0;                                 ///< of the sphere of M [m]
    Eigen::Vector3d at = Eigen::Vector3d::Zero();      ///< its centre in M, at planes only [m]
    std::optional<Eigen::Vector3d> out_of_plane = {};  ///< unit vector in F of planar models
  };
  explicit RigidTouch(const Data& data) : data_(data) {}

  TouchPlace look(const MarkerMotion& F, const MarkerMotion& M) const;
  /// In how many directions it can slip.
  int num_directions() const { return data_.out_of_plane ? 1 : 2; }

 private:
  void look_at_plane(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const;
  void look_at_sphere(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const;

  Data data_;
};

}  // namespace buckens::spatial

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/touch_surface.h"

namespace buckens::spatial {

/// Where two surfaces touch, or are next to each other, at one instant. World axes.
struct TouchPlace {
  Eigen::Vector3d place;                 ///< between both [m]; at planes on the second surface
  Eigen::Vector3d normal;                ///< unit vector from the first to the second
  std::array<Eigen::Vector3d, 2> along;  ///< unit vectors in the surface
  double gap = 0;                        ///< [m]
  Eigen::Vector3d place_rate;            ///< with which the place moves in space [m/s]
  Eigen::Vector3d normal_rate;           ///< [1/s]
  /// False: there is nothing to hold on to, whatever the gap; a distance from what is around.
  bool touches = true;

  /// Row of the relative velocity of both bodies at the place along a direction.
  PairRow row(const Eigen::Vector3d& direction, const MarkerMotion& F, const MarkerMotion& M) const;
  /// Velocity of the second body over the first one at the place [m/s].
  Eigen::Vector3d velocity(const MarkerMotion& F, const MarkerMotion& M) const;
};

/// A place that is found anew in each look, such as one of several on an edge or a patch.
class TouchFinder {
 public:
  virtual ~TouchFinder() = default;
  /// @param out all but its directions is written
  virtual void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const = 0;
};

using TouchFinders = std::vector<std::shared_ptr<const TouchFinder>>;

/// One place in which shapes of F and M touch.
///
/// Directions in the surface are those of F where the normal is as placed, turned with it on the
/// shortest way; in planar models the first one lies in the plane. Theory:
/// docs/theory/25-contact.md §4.
class RigidTouch {
 public:
  enum class Feature {
    point_of_second,  ///< a sphere or a point of M at the surface of F
    point_of_first,   ///< a sphere or a point of F at the surface of M
    rim,              ///< the lowest point of a rim of M on the plane of F; it moves along the rim
    axes,             ///< the nearest places of two capsules
    found             ///< by a finder
  };
  struct Data {
    Feature feature = Feature::point_of_second;
    TouchSurface surface;  ///< of F; with point_of_first: of M
    /// Unit vector in F: normal as placed.
    Eigen::Vector3d pole = Eigen::Vector3d::UnitZ();
    double radius = 0;  ///< of the sphere, the rim or the second capsule [m]
    /// Centre of the sphere or the rim, in axes of its marker [m].
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    /// Of the rim and the second capsule, in M: unit vector.
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    double half_length = 0;                            ///< of the second capsule [m]
    std::optional<Eigen::Vector3d> out_of_plane = {};  ///< unit vector in F of planar models
    std::shared_ptr<const TouchFinder> finder = {};
  };
  explicit RigidTouch(const Data& data);

  /// Costs next to nothing where this touch or a copy of it was last looked at for the same
  /// motions.
  TouchPlace look(const MarkerMotion& F, const MarkerMotion& M) const;
  /// Whether it can cease to touch while the bodies are near: TouchPlace::touches.
  bool may_go() const { return data_.feature == Feature::found; }
  /// In how many directions it can slip.
  int num_directions() const { return data_.out_of_plane ? 1 : 2; }

 private:
  void look_anew(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const;
  void look_at_rim(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const;
  void set_directions(const MarkerMotion& F, TouchPlace& out) const;

  Data data_;
  std::uint64_t number_;  // that of its copies, too
};

}  // namespace buckens::spatial

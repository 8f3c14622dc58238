// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Dense>

namespace buckens::loads {

/// A triangle that bulges so that it meets its neighbours without a kink: Nagata's quadratic patch
/// (Simple local interpolation of surfaces using normal vectors, 2005), its edges being parabolas
/// across the normals at their ends.
///
///     x(λ) = Σ x_k λ_k − Σ c_k λ_k λ_(k+1)                                                    (C8)
///
/// c_k belongs to the edge from corner k to the next one. Flat where all of them vanish.
struct CurvedFacet {
  std::array<Eigen::Vector3d, 3> corner;  ///< [m]
  std::array<Eigen::Vector3d, 3> bulge;   ///< c_k [m]

  /// c of an edge between two corners with unit normals; the same from either side.
  static Eigen::Vector3d bulge_between(const Eigen::Vector3d& a, const Eigen::Vector3d& normal_a,
                                       const Eigen::Vector3d& b, const Eigen::Vector3d& normal_b);

  /// Where a place of a facet lies: −1 inside, 0 … 2 on that edge, 3 … 5 on corner 0 … 2.
  struct Place {
    Eigen::Vector3d at;      ///< [m]
    Eigen::Vector3d normal;  ///< of the surface there, not of unit length
    double square = 0;       ///< of the distance [m²]
    int feature = -1;
    Eigen::Vector2d parameters = Eigen::Vector2d::Zero();  ///< λ₁ and λ₂
  };
  /// Second derivatives of the distance of a point from the facet [1/m].
  /// @param place its nearest place, apart from it
  Eigen::Matrix3d curvature(const Eigen::Vector3d& point, const Place& place) const;
  /// The nearest place to a point.
  Place nearest(const Eigen::Vector3d& point) const;

  /// x(λ).
  Eigen::Vector3d at(const Eigen::Vector3d& lambda) const;

  bool is_flat() const;
  /// Corners and middles of the edges' control polygons: their hull contains the facet.
  std::array<Eigen::Vector3d, 6> hull() const;
};

}  // namespace buckens::loads

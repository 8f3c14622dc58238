// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/shell/element.h"

namespace buckens::fem {

/// Largest number of inner variables of a shell element.
inline constexpr int kMostInner = 5;

/// Strains at one point per outer (nodal) and inner variables.
struct ShellStrainPoint {
  double area = 0;  ///< weight times area [m²]
  ShellStrain outer;
  Eigen::Matrix<double, 8, kMostInner> inner = Eigen::Matrix<double, 8, kMostInner>::Zero();
  /// Drilling rotation relative to the rotation of the surface; empty where the membrane strains
  /// contain it.
  ShellRow drilling;
  Eigen::Matrix<double, 1, kMostInner> inner_drilling =
      Eigen::Matrix<double, 1, kMostInner>::Zero();
};

/// The strains of an element at its integration points and its centre.
struct ShellStrainField {
  std::vector<ShellStrainPoint> points;
  int num_inner = 0;          ///< variables to condense out
  double drilling_share = 1;  ///< stiffness of ShellStrainPoint::drilling
  ShellStrainPoint centre;
  Eigen::Matrix3d centre_axes = Eigen::Matrix3d::Identity();
  std::vector<ShellStrainPoint> corners;  ///< at all nodes; empty unless requested
  std::vector<Eigen::Matrix3d> corner_axes;
};

/// Adds the contribution of the motion of the nodes to a row over the nodal variables.
struct ShellRowBuilder {
  const ShellElement& element;

  /// vector · Σ f_i (u_i + offset θ_i × n_i)
  template <class Row, class Factors>
  void add_surface(Row&& row, const Eigen::Vector3d& vector, const Factors& f) const {
    for (Eigen::Index i = 0; i < element.nodes.cols(); ++i) {
      row.template segment<3>(6 * i) += f[i] * vector.transpose();
      if (element.offset == 0.0) continue;
      row.template segment<3>(6 * i + 3) += f[i] * element.offset * turned(i, vector);
    }
  }
  /// vector · Σ f_i θ_i × n_i
  template <class Row, class Factors>
  void add_director(Row&& row, const Eigen::Vector3d& vector, const Factors& f) const {
    for (Eigen::Index i = 0; i < element.nodes.cols(); ++i) {
      row.template segment<3>(6 * i + 3) += f[i] * turned(i, vector);
    }
  }
  /// vector · Σ f_i θ_i
  template <class Row, class Factors>
  void add_rotation(Row&& row, const Eigen::Vector3d& vector, const Factors& f) const {
    for (Eigen::Index i = 0; i < element.nodes.cols(); ++i) {
      row.template segment<3>(6 * i + 3) += f[i] * vector.transpose();
    }
  }

 private:
  Eigen::RowVector3d turned(Eigen::Index node, const Eigen::Vector3d& vector) const {
    const Eigen::Vector3d n = element.directors.col(node);
    return n.cross(vector).transpose();
  }
};

/// Curvature rows 3…5 of the nodal variables: κ_ab = e_a·W,b + D,a·U,b, symmetrised.
/// @param slope ∂N/∂x, ∂N/∂y in the axes of the point
void set_curvature(const ShellElement& element, const Eigen::Matrix3d& axes,
                   const ShellSlope& slope, ShellStrain& rows);

/// Covariant transverse shear X,α·W + D·U,α at a point, rows r and s.
using ShellShearRows = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6 * kMostShellNodes>;
ShellShearRows covariant_shear(const ShellElement& element, double r, double s);

/// Fraction of its drilling stiffness that a curved element keeps,
/// 1/(1 + (|n_i − n| l/h)²). Where the normals n_i of the nodes differ from that of the element by
/// l/2R, a curvature κ of the shell appears as drilling rotations of order |n_i − n| l κ. This
/// bounds their energy by that of bending, h² κ²; as elements get smaller the fraction returns to 1
/// like l⁴. Flat elements keep all of it.
/// @param square l², the area of a quadrilateral, twice that of a triangle [m²]
double drilling_share(const ShellElement& element, const Eigen::Vector3d& normal, double square);

ShellStrainField quadrilateral_strain(const ShellElement& element, bool with_corners = false);
ShellStrainField triangle_strain(const ShellElement& element, bool with_corners = false);

/// Rotations of the nodes about the normal relative to that of the triangle in its plane.
struct TriangleDrilling {
  std::array<ShellRow, 3> rows;
  double area = 0;  ///< [m²]
};
TriangleDrilling triangle_drilling(const ShellElement& element);

}  // namespace buckens::fem

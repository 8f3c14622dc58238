// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/shell/strain.h"

namespace buckens::fem {

/// Covariant strains of a shell with nodes on its sides, as rows over its nodal variables followed
/// by its inner ones: the displacement of the surface by the bubble function (quadrilaterals, model
/// axes), then the motion of the director along two axes perpendicular to it.
class CovariantStrain {
 public:
  template <int rows>
  using Rows =
      Eigen::Matrix<double, rows, Eigen::Dynamic, rows == 1 ? Eigen::RowMajor : Eigen::ColMajor,
                    rows, 6 * kMostShellNodes + kMostInner>;

  explicit CovariantStrain(const ShellElement& element);

  /// The surface X and its directors D at a point.
  struct Point {
    ShellShape shape;
    double bubble = 0;
    Eigen::Vector2d bubble_slope;          ///< with respect to the natural coordinates
    Eigen::Matrix<double, 3, 2> tangents;  ///< ∂X/∂r, ∂X/∂s
    Eigen::Matrix<double, 3, 2> bend;      ///< ∂D/∂r, ∂D/∂s
    Eigen::Vector3d director;
  };
  Point at(double r, double s) const;

  Eigen::Index num_nodal() const { return element_.num_variables(); }
  int num_inner() const { return element_.is_triangle() ? 2 : 5; }
  Eigen::Index num_columns() const { return num_nodal() + num_inner(); }

  /// ε_rr, ε_ss, 2 ε_rs with ε_αβ = ½ (X,α·U,β + X,β·U,α).
  Rows<3> membrane(const Point& p) const;
  /// κ_rr, κ_ss, 2 κ_rs with κ_αβ = ½ (X,α·W,β + D,α·U,β + X,β·W,α + D,β·U,α).
  Rows<3> curvature(const Point& p) const;
  /// γ_r, γ_s with γ_α = X,α·W + D·U,α.
  Rows<2> shear(const Point& p) const;

  /// Adds vector · Σ f_i (u_i + offset θ_i × n_i), the bubble with a separate factor.
  template <class Row, class Factors>
  void add_surface(Row&& row, const Eigen::Vector3d& vector, const Factors& f,
                   double bubble) const {
    ShellRowBuilder{element_}.add_surface(row, vector, f);
    if (element_.is_triangle()) return;
    row.template segment<3>(num_nodal()) += bubble * vector.transpose();
  }
  /// Adds vector · Σ f_i θ_i × n_i, the bubble with a separate factor.
  template <class Row, class Factors>
  void add_director(Row&& row, const Eigen::Vector3d& vector, const Factors& f,
                    double bubble) const {
    ShellRowBuilder{element_}.add_director(row, vector, f);
    row.template segment<2>(num_columns() - 2) += bubble * vector.transpose() * across_;
  }

 private:
  const ShellElement& element_;
  ShellVectors middle_;
  Eigen::Matrix<double, 3, 2> across_;  // unit vectors perpendicular to the director at the centre
};

/// Membrane and transverse shear strains interpolated between tying points.
class TiedStrain {
 public:
  explicit TiedStrain(const CovariantStrain& covariant, bool is_triangle);

  CovariantStrain::Rows<3> membrane(double r, double s) const;
  CovariantStrain::Rows<2> shear(double r, double s) const;

 private:
  using Row = CovariantStrain::Rows<1>;

  void tie_triangle(const CovariantStrain& covariant);
  void tie_quadrilateral(const CovariantStrain& covariant);

  bool is_triangle_;
  // Quadrilateral: at (±a, −b), (±a, 0), (±a, b), a² = 1/3, b² = 3/5, of each direction, and at
  // (±a, ±a). Triangle: three for each side.
  std::array<std::vector<Row>, 3> membrane_;
  // Quadrilateral: at the points of the membrane. Triangle: coefficients of eight functions.
  std::array<std::vector<Row>, 2> shear_;
};

}  // namespace buckens::fem

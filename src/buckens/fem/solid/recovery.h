// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "buckens/fem/fe_model.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::fem {

/// A face on the surface of a mesh of solids.
struct SurfaceFace {
  std::array<int, 4> nodes;  ///< counter-clockwise seen from outside; fourth −1 for triangles
  int element = 0;           ///< to which it belongs, numbered through solids, then shells
};

/// The faces that belong to one solid element only, in the order of the elements, then the shells.
std::vector<SurfaceFace> surface_faces(const FeModel& fe);

/// Whether all solid elements are connected through common faces: then a mesh of solids alone is
/// not a mechanism.
bool solids_join_by_faces(const FeModel& fe);

/// Number of solid and shell elements. They are numbered together, solids first.
int num_solids(const FeModel& fe);

/// The solid and shell elements at each node, numbered as by num_solids().
std::vector<std::vector<int>> solids_at_nodes(const FeModel& fe);

/// Row of the von Mises stress in SolidRecovery::stresses.
inline constexpr int kMises = 6;

/// Von Mises stress of σ_xx, σ_yy, σ_zz, τ_xy, τ_yz, τ_zx.
double mises_stress(const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& s);

/// F of the von Mises stress ‖F σ‖ of these.
Eigen::Matrix<double, 6, 6> mises_factor();

/// The table of SolidRecovery::stresses from products with the rows of elements (stress_rows.h).
linalg::Matrix stresses_of_rows(const linalg::Vector& products, Eigen::Index solids,
                                Eigen::Index shells, TaskPool* pool = nullptr);

/// Stresses of all solid elements at once, at their centres, where those of trilinear elements are
/// most accurate. For shells, which are numbered after them, stresses of both sides.
class SolidRecovery {
 public:
  explicit SolidRecovery(const FeModel& fe);

  int num_elements() const { return num_solids_ + num_shells_; }

  /// @param d nodal variables
  /// @return 7×(number of elements): σ_xx, σ_yy, σ_zz, τ_xy, τ_yz, τ_zx in model axes, then the von
  ///         Mises stress [Pa]. Shells: those of the side the normal points to, and the larger of
  ///         the von Mises stresses of both sides. Cost: one sparse product.
  linalg::Matrix stresses(const linalg::Vector& d, TaskPool* pool = nullptr) const;
  /// The largest von Mises stress, found by other processes if they have the rows and the nodal
  /// variables: one number comes from each.
  std::optional<double> largest_elsewhere(const linalg::NodalVector& d) const {
    return rows_.largest_norm(d, mises_factor());
  }

 private:
  linalg::SparseRows rows_;  // 6 per solid, 12 per shell
  int num_solids_ = 0;
  int num_shells_ = 0;
};

}  // namespace buckens::fem

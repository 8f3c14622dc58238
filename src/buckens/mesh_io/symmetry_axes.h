// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "buckens/fem/element/material_spec.h"

namespace buckens::mesh_io {

/// Stress per strain, rows and columns xx, yy, zz, xy, yz, zx, shear strains as 2ε.
using StiffnessMatrix = Eigen::Matrix<double, 6, 6>;

/// The same material seen in other axes.
/// @param axes orthonormal, as columns
StiffnessMatrix in_axes(const StiffnessMatrix& C, const Eigen::Matrix3d& axes);

/// The largest constant that couples stretch and shear, or two shears, as a share of the largest
/// one.
double coupling_of(const StiffnessMatrix& C);

/// Axes along which a material has three planes of symmetry: in them it couples nothing. Also found
/// where they are not unique (cubic and transversely isotropic materials).
/// @param rounding coupling that is taken for rounding of the constants
/// @return none if there are no such axes
std::optional<Eigen::Matrix3d> symmetry_axes(const StiffnessMatrix& C, double rounding);

/// The nine constants of a material without coupling; what couples is not looked at. Its axes are
/// those of the constants.
/// @return none if the stiffness is not positive definite
std::optional<fem::OrthotropicSpec> orthotropic_constants(const StiffnessMatrix& C);

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Core>

#include "buckens/fem/element/material.h"

namespace buckens::fem {

/// Stress per strain of a solid [Pa]: rows and columns xx, yy, zz, xy, yz, zx, shear strains as
/// 2ε, model axes.
using Elasticity = Eigen::Matrix<double, 6, 6>;

/// Elasticity of an isotropic or orthotropic material.
Elasticity solid_elasticity(const Material& material);

/// Refuses impossible constants.
/// @param where beginning of the message
/// @throws ModelError unless the strain energy of every strain is positive, ρ ≥ 0 and an isotropic
/// material has G = E/(2(1+ν))
void check_solid_material(const std::string& where, const Material& material);

/// @throws ModelError if the material of a beam or bar is orthotropic
void refuse_orthotropic(const std::string& where, const Material& material);

}  // namespace buckens::fem

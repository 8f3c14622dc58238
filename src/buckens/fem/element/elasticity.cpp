// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/element/elasticity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

using Eigen::Matrix3d;

namespace {

constexpr std::array<std::array<int, 2>, 6> kPlaces = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Strains in the axes of the material per strains in model axes.
Elasticity turn_strains(const Matrix3d& axes) {
  Elasticity T;
  for (Eigen::Index column = 0; column < 6; ++column) {
    const auto& [p, q] = kPlaces[static_cast<std::size_t>(column)];
    Matrix3d strain = Matrix3d::Zero();
    strain(p, q) += 0.5;
    strain(q, p) += 0.5;
    const Matrix3d turned = axes.transpose() * strain * axes;
    for (Eigen::Index row = 0; row < 6; ++row) {
      const auto& [i, j] = kPlaces[static_cast<std::size_t>(row)];
      T(row, column) = i == j ? turned(i, i) : 2.0 * turned(i, j);
    }
  }
  return T;
}

Elasticity orthotropic(const Orthotropy& o) {
  Elasticity S = Elasticity::Zero();  // compliance in the axes of the material
  S.topLeftCorner<3, 3>() << 1.0 / o.E[0], -o.nu12 / o.E[0], -o.nu13 / o.E[0],  //
      -o.nu12 / o.E[0], 1.0 / o.E[1], -o.nu23 / o.E[1],                         //
      -o.nu13 / o.E[0], -o.nu23 / o.E[1], 1.0 / o.E[2];
  S.diagonal().tail<3>() << 1.0 / o.G12, 1.0 / o.G23, 1.0 / o.G13;
  Elasticity D = Elasticity::Zero();
  D.topLeftCorner<3, 3>() = S.topLeftCorner<3, 3>().inverse();
  D.diagonal().tail<3>() = S.diagonal().tail<3>().cwiseInverse();
  const Elasticity T = turn_strains(o.axes);
  D = T.transpose() * D * T;
  return 0.5 * (D + D.transpose());
}

Elasticity isotropic(double E, double nu) {
  const double lame = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double shear = E / (2.0 * (1.0 + nu));
  Elasticity D = Elasticity::Zero();
  D.topLeftCorner<3, 3>().setConstant(lame);
  D.diagonal().head<3>().array() += 2.0 * shear;
  D.diagonal().tail<3>().setConstant(shear);
  return D;
}

void check_isotropic(const std::string& where, const Material& m) {
  if (!(m.E > 0.0 && m.nu > -1.0 && m.nu < 0.5)) {
    throw ModelError(
        fmt::format("{}: E = {:g} Pa, nu = {:g}, rho = {:g} kg/m³; a solid needs E > 0, "
                    "-1 < nu < 0.5 and rho >= 0 (use 0.49 for rubber)",
                    where, m.E, m.nu, m.rho));
  }
  const double G = m.E / (2.0 * (1.0 + m.nu));
  if (std::abs(m.G - G) > 1e-6 * G) {
    throw ModelError(fmt::format(
        "{}: G = {:g} Pa, but an isotropic solid with this E and nu has {:g} Pa; leave `G` out",
        where, m.G, G));
  }
}

void check_orthotropic(const std::string& where, const Orthotropy& o) {
  if (!(o.E.minCoeff() > 0.0 && std::min({o.G12, o.G13, o.G23}) > 0.0)) {
    throw ModelError(
        fmt::format("{}: orthotropic material with E1, E2, E3 = {:g}, {:g}, {:g} Pa and G12, G13, "
                    "G23 = {:g}, {:g}, {:g} Pa; all must be positive",
                    where, o.E[0], o.E[1], o.E[2], o.G12, o.G13, o.G23));
  }
  struct Contraction {
    const char* name;
    double nu, first, second;
  };
  for (const Contraction& p :
       {Contraction{"12", o.nu12, o.E[0], o.E[1]}, Contraction{"13", o.nu13, o.E[0], o.E[2]},
        Contraction{"23", o.nu23, o.E[1], o.E[2]}}) {
    const double most = std::sqrt(p.first / p.second);
    if (std::abs(p.nu) < most) continue;
    throw ModelError(fmt::format(
        "{}: orthotropic material with nu{} = {:g}: some strain would have no energy; |nu{}| must "
        "be below sqrt(E{}/E{}) = {:.4g} (nu{} is the contraction along {} of a pull along {})",
        where, p.name, p.nu, p.name, p.name[0], p.name[1], most, p.name, p.name[1], p.name[0]));
  }
  // Compliance scaled to ones on the diagonal: its determinant is the last condition.
  const double c12 = o.nu12 * std::sqrt(o.E[1] / o.E[0]);
  const double c13 = o.nu13 * std::sqrt(o.E[2] / o.E[0]);
  const double c23 = o.nu23 * std::sqrt(o.E[2] / o.E[1]);
  const double determinant = 1.0 - c12 * c12 - c13 * c13 - c23 * c23 - 2.0 * c12 * c13 * c23;
  if (determinant > 1e-9) return;
  throw ModelError(fmt::format(
      "{}: orthotropic material with nu12, nu13, nu23 = {:g}, {:g}, {:g}: some strain would have "
      "no energy (determinant of the scaled compliance {:.3g}, must be positive); make one of "
      "them smaller",
      where, o.nu12, o.nu13, o.nu23, determinant));
}

}  // namespace

Elasticity solid_elasticity(const Material& material) {
  if (material.orthotropy) return orthotropic(*material.orthotropy);
  return isotropic(material.E, material.nu);
}

void check_solid_material(const std::string& where, const Material& material) {
  if (!(material.rho >= 0.0)) {
    throw ModelError(
        fmt::format("{}: rho = {:g} kg/m³; a density is not negative", where, material.rho));
  }
  if (material.orthotropy) {
    check_orthotropic(where, *material.orthotropy);
  } else {
    check_isotropic(where, material);
  }
}

void refuse_orthotropic(const std::string& where, const Material& material) {
  if (!material.orthotropy) return;
  throw ModelError(where +
                   ": its material is orthotropic, which only solids can be; give beams and bars a "
                   "material with `E` and `nu`");
}

}  // namespace buckens::fem

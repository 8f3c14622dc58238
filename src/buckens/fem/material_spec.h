// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/fem/material.h"

namespace buckens::fem {

/// Rayleigh damping C = αM + βK, given by α and β or by a damping ratio at two frequencies.
struct DampingSpec {
  SourceLocation where;
  double mass = 0;                          ///< α [1/s]
  double stiffness = 0;                     ///< β [s]
  std::optional<double> ratio;              ///< ζ at both frequencies
  std::optional<std::array<double, 2>> at;  ///< f1 < f2 [Hz]

  /// α, also where ζ is given: α = 2ζ ω1 ω2/(ω1+ω2).
  double alpha() const { return ratio && at ? kFactor * *ratio * product() / sum() : mass; }
  /// β, also where ζ is given: β = 2ζ/(ω1+ω2).
  double beta() const { return ratio && at ? 2.0 * *ratio / (kTwoPi * sum()) : stiffness; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("mass", mass,
                      "factor α [1/s] of the mass matrix; one value per body, it acts on motion "
                      "relative to the body frame")
              .in(base::kFrequency)
              .non_negative()
              .like("2 1/s"));
    visit(base::field("stiffness", stiffness, "factor β of the stiffness matrix")
              .in(base::kTime)
              .non_negative()
              .like("1e-7 s"));
    visit(base::field("ratio", ratio,
                      "damping ratio at the two frequencies `at`, instead of `mass` and "
                      "`stiffness`")
              .within(base::Range::fraction)
              .like("2 %"));
    visit(base::field("at", at, "the two frequencies at which `ratio` holds")
              .in(base::kFrequency)
              .positive()
              .like("[10 Hz, 200 Hz]"));
  }

 private:
  static constexpr double kTwoPi = 6.283185307179586477;
  static constexpr double kFactor = 2.0 * kTwoPi;
  double product() const { return (*at)[0] * (*at)[1]; }
  double sum() const { return (*at)[0] + (*at)[1]; }
};

/// Constants of an orthotropic material for solids.
struct OrthotropicSpec {
  SourceLocation where;
  double E1 = 0, E2 = 0, E3 = 0;        ///< [Pa]
  double nu12 = 0, nu13 = 0, nu23 = 0;  ///< contraction along the second of a pull along the first
  double G12 = 0, G13 = 0, G23 = 0;     ///< [Pa]
  Eigen::Vector3d axis_1 = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_2 = Eigen::Vector3d::UnitY();  ///< near direction 2

  /// The constants with orthonormal axes: what `axis_2` has along `axis_1` is taken out.
  Orthotropy constants() const {
    Orthotropy out{{E1, E2, E3}, nu12, nu13, nu23, G12, G13, G23, Eigen::Matrix3d::Identity()};
    out.axes.col(0) = axis_1.normalized();
    out.axes.col(1) = (axis_2 - axis_2.dot(out.axes.col(0)) * out.axes.col(0)).normalized();
    out.axes.col(2) = out.axes.col(0).cross(out.axes.col(1));
    return out;
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    const auto modulus = [&visit](const char* key, double& member, const char* doc,
                                  const char* example) {
      visit(base::field(key, member, doc).in(base::kStress).required().positive().like(example));
    };
    modulus("E1", E1, "Young's modulus along direction 1", "135 GPa");
    modulus("E2", E2, "Young's modulus along direction 2", "10 GPa");
    modulus("E3", E3, "Young's modulus along direction 3", "10 GPa");
    visit(
        base::field("nu12", nu12, "contraction along 2 of a pull along 1").required().like("0.3"));
    visit(
        base::field("nu13", nu13, "contraction along 3 of a pull along 1").required().like("0.3"));
    visit(
        base::field("nu23", nu23, "contraction along 3 of a pull along 2").required().like("0.45"));
    modulus("G12", G12, "shear modulus between directions 1 and 2", "5 GPa");
    modulus("G13", G13, "shear modulus between directions 1 and 3", "5 GPa");
    modulus("G23", G23, "shear modulus between directions 2 and 3", "3.4 GPa");
    visit(base::field("axis-1", axis_1, "direction 1, in model axes").like("[1, 0, 0]"));
    visit(base::field("axis-2", axis_2,
                      "direction near direction 2, in model axes; what it has along direction 1 is "
                      "taken out")
              .like("[0, 1, 0]"));
  }
};

/// Linear elastic material. Exactly one of E and orthotropic is given.
struct MaterialSpec {
  std::string name;
  SourceLocation where;
  double E = 0;             ///< Young's modulus [Pa]; zero where orthotropic
  double nu = 0;            ///< Poisson's ratio
  std::optional<double> G;  ///< shear modulus [Pa]; default E/(2(1+ν))
  std::optional<OrthotropicSpec> orthotropic;
  double rho = 0;  ///< density [kg/m³]
  std::optional<DampingSpec> damping;

  double shear_modulus() const { return G ? *G : E / (2.0 * (1.0 + nu)); }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("E", E, "Young's modulus")
              .in(base::kStress)
              .positive()
              .like("200 GPa")
              .otherwise("give this or `orthotropic`"));
    visit(base::field("nu", nu, "Poisson's ratio").within(base::Range::poisson).like("0.3"));
    visit(base::field("G", G, "shear modulus")
              .in(base::kStress)
              .positive()
              .like("77 GPa")
              .otherwise("E/(2(1+nu))"));
    visit(base::field("orthotropic", orthotropic,
                      "nine constants in place of E, nu and G; for solids only")
              .otherwise("isotropic"));
    visit(base::field("rho", rho, "density")
              .in(base::kDensity)
              .required()
              .non_negative()
              .like("7870 kg/m^3"));
    visit(base::field("damping", damping, "Rayleigh damping").otherwise("none"));
  }
};

}  // namespace buckens::fem

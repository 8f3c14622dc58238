// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

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

/// Linear elastic isotropic material.
struct MaterialSpec {
  std::string name;
  SourceLocation where;
  double E = 0;             ///< Young's modulus [Pa]
  double nu = 0;            ///< Poisson's ratio
  std::optional<double> G;  ///< shear modulus [Pa]; default E/(2(1+ν))
  double rho = 0;           ///< density [kg/m³]
  std::optional<DampingSpec> damping;

  double shear_modulus() const { return G ? *G : E / (2.0 * (1.0 + nu)); }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("E", E, "Young's modulus")
              .in(base::kStress)
              .required()
              .positive()
              .like("200 GPa"));
    visit(base::field("nu", nu, "Poisson's ratio").within(base::Range::poisson).like("0.3"));
    visit(base::field("G", G, "shear modulus")
              .in(base::kStress)
              .positive()
              .like("77 GPa")
              .otherwise("E/(2(1+nu))"));
    visit(base::field("rho", rho, "density")
              .in(base::kDensity)
              .required()
              .non_negative()
              .like("7870 kg/m^3"));
    visit(base::field("damping", damping, "Rayleigh damping").otherwise("none"));
  }
};

}  // namespace buckens::fem

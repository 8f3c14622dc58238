// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/fem/element/material.h"

namespace buckens::fem {

/// Vibrations to which a damping ratio refers.
enum class DampedModes { held, free };

constexpr std::array<const char*, 2> choice_names(DampedModes) { return {"held", "free"}; }

/// Rayleigh damping C = αM + βK, given by α and β or by a damping ratio at one or two frequencies.
///
/// α acts on motion relative to the body frame: all of the motion if the free body vibrates, but
/// only a small part if joints hold the body, since the frame follows; see
/// FeModel::damps_held_motion.
struct DampingSpec {
  SourceLocation where;
  double mass = 0;              ///< α [1/s]
  double stiffness = 0;         ///< β [s]
  std::optional<double> ratio;  ///< ζ at all frequencies of `at`
  std::vector<double> at;       ///< f1, or f1 < f2 [Hz]
  DampedModes of = DampedModes::held;

  /// α; from ζ at two frequencies 2ζ ω1 ω2/(ω1+ω2), at one frequency 0.
  double alpha() const {
    if (!ratio) return mass;
    return at.size() == 2 ? 2.0 * kTurn * *ratio * at[0] * at[1] / (at[0] + at[1]) : 0.0;
  }
  /// β; from ζ at two frequencies 2ζ/(ω1+ω2), at one frequency 2ζ/ω1.
  double beta() const {
    if (!ratio) return stiffness;
    double sum = 0;
    for (const double frequency : at) sum += kTurn * frequency;
    return sum > 0.0 ? 2.0 * *ratio / sum : 0.0;
  }
  /// Whether α acts on the motion that the joints allow the body, rather than on motion relative to
  /// the frame.
  bool is_of_held_motion() const { return ratio && at.size() == 2 && of == DampedModes::held; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("mass", mass,
                      "factor α [1/s] of the mass matrix; one value per body, it acts on motion "
                      "relative to the body frame and has little effect on the low vibrations of a "
                      "body held by its joints")
              .in(base::kFrequency)
              .non_negative()
              .like("2 1/s"));
    visit(base::field("stiffness", stiffness, "factor β of the stiffness matrix")
              .in(base::kTime)
              .non_negative()
              .like("1e-7 s"));
    visit(base::field("ratio", ratio,
                      "damping ratio at the frequencies `at`, instead of `mass` and `stiffness`; "
                      "`buckens check` lists the ratios of the assembled model")
              .within(base::Range::fraction)
              .like("2 %"));
    visit(base::field(
              "at", at,
              "two frequencies at which `ratio` holds; it is lower between them and higher "
              "outside. One frequency: stiffness damping only, the ratio grows with frequency")
              .in(base::kFrequency)
              .positive()
              .like("[10 Hz, 200 Hz]"));
    visit(base::field("of", of,
                      "the vibrations to which `ratio` applies. held: of the body held by its "
                      "joints at t = 0; free: of the body alone in space"));
  }

 private:
  static constexpr double kTurn = 6.283185307179586477;
};

/// Constants of an orthotropic material for solids.
struct OrthotropicSpec {
  SourceLocation where;
  double E1 = 0, E2 = 0, E3 = 0;        ///< [Pa]
  double nu12 = 0, nu13 = 0, nu23 = 0;  ///< contraction along 2nd under tension along 1st
  double G12 = 0, G13 = 0, G23 = 0;     ///< [Pa]
  Eigen::Vector3d axis_1 = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_2 = Eigen::Vector3d::UnitY();  ///< near direction 2

  /// The constants with orthonormal axes: the component of `axis_2` along `axis_1` is removed.
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
    visit(base::field("nu12", nu12, "contraction along 2 under tension along 1")
              .required()
              .like("0.3"));
    visit(base::field("nu13", nu13, "contraction along 3 under tension along 1")
              .required()
              .like("0.3"));
    visit(base::field("nu23", nu23, "contraction along 3 under tension along 2")
              .required()
              .like("0.45"));
    modulus("G12", G12, "shear modulus between directions 1 and 2", "5 GPa");
    modulus("G13", G13, "shear modulus between directions 1 and 3", "5 GPa");
    modulus("G23", G23, "shear modulus between directions 2 and 3", "3.4 GPa");
    visit(base::field("axis-1", axis_1, "direction 1, in model axes").like("[1, 0, 0]"));
    visit(base::field(
              "axis-2", axis_2,
              "approximate direction 2, in model axes; its component along direction 1 is removed")
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
                      "nine constants instead of E, nu and G; for solids only")
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

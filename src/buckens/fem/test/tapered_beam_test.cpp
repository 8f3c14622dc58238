// SPDX-License-Identifier: Apache-2.0
// Tapered and curved chains of beams against exact solutions.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/assembly/geometric_stiffness.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/assembly/uniform_shares.h"
#include "buckens/fem/mesh/curved_beam.h"
#include "buckens/fem/test/held_solution.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;

const Material& steel_material() {
  static const Material m = Material::isotropic(2e11, 0.25, 8000);
  return m;
}

/// Of a cone: diameter from first to last.
SectionLaw cone(double first, double last) {
  return [first, last](double s) { return Section::circle((1 - s) * first + s * last); };
}

BeamProperties tapered(const SectionLaw& law, BeamTheory theory = BeamTheory::euler_bernoulli) {
  BeamProperties out = BeamProperties::of(steel_material(), law(0.5), theory);
  out.taper = law;
  return out;
}

/// A beam of 1 m along a skew direction, its nodes in order.
struct SkewBeam {
  Structure structure;
  std::vector<int> nodes;
  Vector3d t = Vector3d(2, 1, -2) / 3;

  SkewBeam(const BeamProperties& properties, int elements) {
    const int a = add_node(structure, "a", {0.3, -0.2, 0.1});
    const int b = add_node(structure, "b", Vector3d(0.3, -0.2, 0.1) + t);
    nodes = add_beam(structure, a, b, elements, properties).nodes;
  }
};

Vector held_at_first(const FeModel& fe, const Vector& f) {
  std::vector<bool> given(static_cast<std::size_t>(fe.dofs.num_dofs), false);
  for (const int dof : fe.dofs.node_dofs[0]) given[static_cast<std::size_t>(dof)] = true;
  return test::solve(fe, f, given, Vector::Zero(fe.dofs.num_dofs));
}

Eigen::Index dof_of(const FeModel& fe, int node, int variable) {
  return fe.dofs.node_dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(variable)];
}

/// Largest difference over the largest entry.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(TaperedBeam, IsDrawnWithTheRadiiOfItsEnds) {
  SkewBeam beam(tapered(cone(0.05, 0.02)), 3);
  const FeModel model = assemble(beam.structure);
  const auto lines = line_elements(model);
  ASSERT_EQ(lines.size(), 3U);
  for (std::size_t e = 0; e < 3; ++e) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double s = static_cast<double>(e + end) / 3.0;
      EXPECT_NEAR(lines[e].sections[end]->outer_radius, 0.5 * ((1 - s) * 0.05 + s * 0.02), 1e-15);
    }
  }
}

TEST(TaperedBeam, WithOneSectionIsUniform) {
  for (const BeamTheory theory : {BeamTheory::euler_bernoulli, BeamTheory::timoshenko}) {
    const Section section = Section::rectangle(0.05, 0.02);
    const BeamProperties plain = BeamProperties::of(steel_material(), section, theory);
    BeamProperties law = plain;
    law.taper = [section](double) { return section; };
    const FeModel a = assemble(SkewBeam(plain, 3).structure);
    const FeModel b = assemble(SkewBeam(law, 3).structure);
    // The interpolation through five points and the inverse of the flexibility round.
    EXPECT_LT(difference(b.K.whole(), a.K.whole()), 1e-12);
    EXPECT_LT(difference(b.M.whole(), a.M.whole()), 1e-12);
    EXPECT_LT(difference(b.shape.c, a.shape.c), 1e-12);
    EXPECT_LT(difference(b.shape.C0, a.shape.C0), 1e-12);
  }
}

TEST(TaperedBeam, HasMassCentreAndInertiaOfACone) {
  const double D = 0.1, d = 0.04;
  for (const int elements : {1, 3}) {
    const SkewBeam beam(tapered(cone(D, d), BeamTheory::timoshenko), elements);
    const FeModel fe = assemble(beam.structure);
    const double sum = D * D + D * d + d * d;
    const double mass = 8000 * std::numbers::pi / 12 * sum;
    const double centre = 0.25 * (D * D + 2 * D * d + 3 * d * d) / sum;
    EXPECT_NEAR(fe.shape.mass, mass, 1e-12 * mass);
    EXPECT_LT((fe.shape.com - beam.structure.nodes[0].position - centre * beam.t).norm(), 1e-13);
    // About the axis: (3/10) of mass times difference of fifth powers over that of cubes.
    const double axial =
        0.075 * mass * (std::pow(D, 5) - std::pow(d, 5)) / (std::pow(D, 3) - std::pow(d, 3));
    const Matrix3d J = fe.shape.J0;
    EXPECT_NEAR(beam.t.dot(J * beam.t), axial, 1e-11 * axial);
    // Across, about the centre: ∫ρA(x − x_c)² + ρI dx by Simpson's rule, exact for degree 4 with
    // four intervals to the fifth order of A (x − x_c)², so by Boole's rule.
    const Vector3d across = beam.t.cross(Vector3d::UnitX()).normalized();
    const auto density = [&](double x) {
      const double at = D + (d - D) * x;
      return 8000 * std::numbers::pi * at * at / 4 * ((x - centre) * (x - centre) + at * at / 16);
    };
    const double boole = (7 * density(0) + 32 * density(0.25) + 12 * density(0.5) +
                          32 * density(0.75) + 7 * density(1)) /
                         90;
    EXPECT_NEAR(across.dot(J * across), boole, 1e-11 * boole);
  }
}

TEST(TaperedBeam, BendsTwistsAndStretchesExactlyUnderEndLoads) {
  const double D = 0.1, d = 0.04, E = 2e11, G = 8e10;
  for (const int elements : {1, 4}) {
    const SkewBeam beam(tapered(cone(D, d)), elements);
    const FeModel fe = assemble(beam.structure);
    const int tip = beam.nodes.back();
    const Vector3d across = beam.t.cross(Vector3d::UnitZ()).normalized();
    const auto answer = [&](int first, const Vector3d& direction) {
      Vector f = Vector::Zero(fe.dofs.num_dofs);
      f.segment<3>(dof_of(fe, tip, first)) = direction;
      const Vector u = held_at_first(fe, f);
      return u.segment<3>(dof_of(fe, tip, first)).dot(direction);
    };
    // 64/(3π E) L³/(d D³), 4/(π E) L/(D d), 32/(3π G) (D² + D d + d²)/(D³ d³) L. Tolerance: that of
    // twelve Gauss points, and rounding.
    const double bend = 64 / (3 * std::numbers::pi * E) / (d * std::pow(D, 3));
    const double stretch = 4 / (std::numbers::pi * E) / (D * d);
    const double twist =
        32 / (3 * std::numbers::pi * G) * (D * D + D * d + d * d) / std::pow(D * d, 3);
    EXPECT_NEAR(answer(0, across), bend, 1e-9 * bend);
    EXPECT_NEAR(answer(0, beam.t), stretch, 1e-9 * stretch);
    EXPECT_NEAR(answer(3, beam.t), twist, 1e-9 * twist);
  }
}

TEST(TaperedBeam, ShearsAsItsSectionsDo) {
  const double D = 0.1, d = 0.05;
  const auto bend = [&](BeamTheory theory) {
    const SkewBeam beam(tapered(cone(D, d), theory), 2);
    const FeModel fe = assemble(beam.structure);
    Vector f = Vector::Zero(fe.dofs.num_dofs);
    const Vector3d across = beam.t.cross(Vector3d::UnitZ()).normalized();
    f.segment<3>(dof_of(fe, beam.nodes.back(), 0)) = across;
    return held_at_first(fe, f).segment<3>(dof_of(fe, beam.nodes.back(), 0)).dot(across);
  };
  // ∫ dx/(κ G A) with κ = 6/7; a thousandth of the deflection, which is known to 1e-9.
  const double shear = 7.0 / 6 * 4 / (std::numbers::pi * 8e10) / (D * d);
  EXPECT_NEAR(bend(BeamTheory::timoshenko) - bend(BeamTheory::euler_bernoulli), shear,
              1e-5 * shear);
}

/// Whether λ = ω √(ρA/(E I)) x₂ of a cone from x₁ (free) to x₂ (held), measured from its apex, is a
/// solution: w = x⁻¹ Z₂(2√(λx)) with Z = J, Y, I, K fulfils (x⁴ w″)″ = λ² x² w.
double cone_determinant(double lambda, double x1, double x2) {
  const auto derivative = [lambda](int kind, int order, double x) {
    const double n = 2 + order, z = 2 * std::sqrt(lambda * x);
    const double Z = kind == 0   ? std::cyl_bessel_j(n, z)
                     : kind == 1 ? std::cyl_neumann(n, z)
                     : kind == 2 ? std::cyl_bessel_i(n, z)
                                 : std::cyl_bessel_k(n, z);
    const double sign = kind == 2 ? 1.0 : -1.0;
    return std::pow(sign * std::sqrt(lambda), order) * std::pow(x, -0.5 * n) * Z;
  };
  Eigen::Matrix4d A;
  for (int kind = 0; kind < 4; ++kind) {
    A.col(kind) << derivative(kind, 2, x1), derivative(kind, 3, x1), derivative(kind, 0, x2),
        derivative(kind, 1, x2);
    A.col(kind).normalize();
  }
  return A.determinant();
}

/// First circular frequency of a cone 1 m long that is held at its thick end.
double exact_cone_frequency(double D, double d) {
  const double x2 = D / (D - d), x1 = x2 - 1;
  // A uniform beam has λ = 3.516 x₂, a tapered one more.
  double low = 3 * x2, step = 1e-2;
  while (cone_determinant(low, x1, x2) * cone_determinant(low + step, x1, x2) > 0) low += step;
  double high = low + step;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const bool is_below = cone_determinant(low, x1, x2) * cone_determinant(middle, x1, x2) > 0;
    (is_below ? low : high) = middle;
  }
  // λ² = ω² ρ A₂ x₂²/(E I₂), I/A = D²/16.
  return low / x2 * std::sqrt(2e11 / 8000) * D / 4;
}

double first_frequency(const BeamProperties& properties, int elements) {
  const FeModel fe = assemble(SkewBeam(properties, elements).structure);
  std::vector<Eigen::Index> kept;
  for (std::size_t n = 1; n < fe.dofs.node_dofs.size(); ++n) {
    for (const int dof : fe.dofs.node_dofs[n]) kept.push_back(dof);
  }
  const Eigen::MatrixXd K = Eigen::MatrixXd(fe.K.whole())(kept, kept),
                        M = Eigen::MatrixXd(fe.M.whole())(kept, kept);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, M,
                                                                        Eigen::EigenvaluesOnly);
  return std::sqrt(eigen.eigenvalues()[0]);
}

TEST(TaperedBeam, VibratesLikeAConeWithFourthOrder) {
  const double D = 0.05, d = 0.02, exact = exact_cone_frequency(D, d);
  // A cantilever whose tip is thinner vibrates faster than a uniform one, 3.516 √(E I/(ρ A)).
  EXPECT_GT(exact, 3.516 * std::sqrt(2e11 / 8000) * D / 4);
  const double coarse = first_frequency(tapered(cone(D, d)), 8) / exact - 1;
  const double fine = first_frequency(tapered(cone(D, d)), 16) / exact - 1;
  // Exact stiffness with the mass of cubic deflections: no bound from above, but h⁴. With 8 and 16
  // elements the next power, h⁵, still adds a little.
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.2);
  EXPECT_LT(std::abs(fine), std::pow(1.0 / 16, 4));
}

TEST(TaperedBeam, KnowsSectionsAndForcesAtItsEnds) {
  const double D = 0.1, d = 0.04;
  const SkewBeam beam(tapered(cone(D, d)), 2);
  const FeModel fe = assemble(beam.structure);
  Vector f = Vector::Zero(fe.dofs.num_dofs);
  f.segment<3>(dof_of(fe, beam.nodes.back(), 0)) = 1e3 * beam.t;
  const Vector u = held_at_first(fe, f);
  const Recovery recovery(fe);
  const linalg::Matrix stress = recovery.stresses(recovery.section_forces(u));
  // The larger of both ends of each element: that at its thin end, 4 F/(π d²).
  EXPECT_NEAR(stress(0, 0), 4e3 / (std::numbers::pi * 0.07 * 0.07), 1.0);
  EXPECT_NEAR(stress(0, 1), 4e3 / (std::numbers::pi * d * d), 1.0);
  // The stiffening tension is constant along the beam.
  const linalg::Vector tension = GeometricStiffness(fe).axial_forces(u);
  EXPECT_NEAR(tension[0], 1e3, 1e-6);
  EXPECT_NEAR(tension[1], 1e3, 1e-6);
}

TEST(TaperedBeam, CarriesBodyForcesByItsOwnMass) {
  const SkewBeam beam(tapered(cone(0.1, 0.04)), 2);
  const FeModel fe = assemble(beam.structure);
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  for (int line = 0; line < 2; ++line) {
    const LineIntegral own =
        line_integral(fe, line, line_section(beam.structure, line).mass_per_length);
    mass += own.extent;
    first += own.first_moment;
  }
  EXPECT_NEAR(mass, fe.shape.mass, 1e-12 * mass);
  EXPECT_LT((first / mass - fe.shape.com).norm(), 1e-12);
}

TEST(TaperedBeam, KeepsItsPlacesWhenDivided) {
  const SkewBeam beam(tapered(cone(0.1, 0.04)), 4);
  const BeamBlock half = beam.structure.beams.subset({2, 3}, {0, 1, 2, 3, 4});
  EXPECT_NEAR(half.end_section(0, 0)->outer_radius, 0.035, 1e-15);
  EXPECT_NEAR(half.end_section(1, 1)->outer_radius, 0.02, 1e-15);
}

// Curves.

/// A quarter of a circle of radius 1 from (0, 0, 0), where it is held and runs along y, to
/// (1, 1, 0).
struct QuarterCircle {
  Structure structure;
  BeamDivision beam;

  explicit QuarterCircle(int elements) {
    const int a = add_node(structure, "a", Vector3d::Zero());
    const int b = add_node(structure, "b", {1, 1, 0});
    const double c = std::sqrt(0.5);
    beam = add_curved_beam(
        structure, a, b, BeamPath::arc, {{1 - c, c, 0}}, elements,
        BeamProperties::of(steel_material(), Section::circle(0.02), BeamTheory::euler_bernoulli));
  }
  /// Displacement of the tip along its force of one newton.
  double answer(const Vector3d& direction) const {
    const FeModel fe = assemble(structure);
    Vector f = Vector::Zero(fe.dofs.num_dofs);
    f.segment<3>(dof_of(fe, beam.nodes.back(), 0)) = direction;
    return held_at_first(fe, f).segment<3>(dof_of(fe, beam.nodes.back(), 0)).dot(direction);
  }
};

TEST(CurvedBeam, HasItsNodesOnTheArc) {
  const QuarterCircle quarter(7);
  ASSERT_EQ(quarter.beam.nodes.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi / 2 * static_cast<double>(k) / 7;
    const Vector3d place(1 - std::cos(angle), std::sin(angle), 0);
    const auto node = static_cast<std::size_t>(quarter.beam.nodes[k]);
    EXPECT_LT((quarter.structure.nodes[node].position - place).norm(), 1e-15) << k;
  }
}

TEST(CurvedBeam, DeflectsAsCastiglianoSaysWithSecondOrder) {
  const double E = 2e11, G = 8e10, I = std::numbers::pi * std::pow(0.02, 4) / 64, A = kPi * 1e-4;
  struct Case {
    Vector3d force;
    double exact;
  };
  // From the tip φ = 0 to the root: a force along x gives M = R (1 − cos φ), N = cos φ, one along y
  // M = R sin φ, N = sin φ, one across bending sin φ and torsion 1 − cos φ.
  const Case cases[] = {
      {Vector3d::UnitX(), (3 * std::numbers::pi / 4 - 2) / (E * I) + kPi / 4 / (E * A)},
      {Vector3d::UnitY(), std::numbers::pi / 4 / (E * I) + kPi / 4 / (E * A)},
      {Vector3d::UnitZ(), std::numbers::pi / 4 / (E * I) + (3 * kPi / 4 - 2) / (G * 2 * I)},
  };
  for (const Case& c : cases) {
    const double coarse = QuarterCircle(8).answer(c.force) / c.exact - 1;
    const double fine = QuarterCircle(16).answer(c.force) / c.exact - 1;
    // The chords are shorter than the arc and lie inside: h²/24 and the like, h = π/16 here.
    EXPECT_NEAR(coarse / fine, 4.0, 0.1) << c.force.transpose();
    EXPECT_LT(std::abs(fine), 0.01);
  }
}

TEST(CurvedBeam, RingsVibrateByTheirFormulaWithSecondOrder) {
  // Inextensional bending in the plane: ω = n (n² − 1)/√(n² + 1) √(E I/(ρ A R⁴)).
  const double d = 0.01;
  const auto ring = [&](int elements) {
    Structure s;
    const int a = add_node(s, "a", {1, 0, 0}), b = add_node(s, "b", {-1, 0, 0});
    const BeamProperties round =
        BeamProperties::of(steel_material(), Section::circle(d), BeamTheory::euler_bernoulli);
    add_curved_beam(s, a, b, BeamPath::arc, {{0, 1, 0}}, elements / 2, round);
    add_curved_beam(s, b, a, BeamPath::arc, {{0, -1, 0}}, elements / 2, round);
    const FeModel fe = assemble(s, spatial::Plane::xy);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        Eigen::MatrixXd(fe.K.whole()), Eigen::MatrixXd(fe.M.whole()), Eigen::EigenvaluesOnly);
    return Eigen::VectorXd(eigen.eigenvalues().segment(3, 4).cwiseSqrt());
  };
  const Eigen::VectorXd coarse = ring(48), fine = ring(96);
  const double scale = std::sqrt(2e11 / 8000) * d / 4;
  for (int pair = 0; pair < 2; ++pair) {
    const double n = 2 + pair;
    const double exact = n * (n * n - 1) / std::sqrt(n * n + 1) * scale;
    const double far = coarse[2 * pair] / exact - 1, near = fine[2 * pair] / exact - 1;
    // Both modes of a pair are equal in a regular polygon.
    EXPECT_NEAR(fine[2 * pair + 1] / fine[2 * pair], 1.0, 1e-6);
    EXPECT_NEAR(far / near, 4.0, 0.1) << n;
    // What the formula leaves out, extension, has the share n² (d/4)²: 1e-4 at most.
    EXPECT_NEAR((4 * near - far) / 3, 0.0, 1e-4) << n;
  }
}

TEST(CurvedBeam, CarriesItsAxesWithoutTwist) {
  // In a vertical plane the usual z axis would turn over where the arc is vertical.
  Structure s;
  const int a = add_node(s, "a", {1, 0, 0}), b = add_node(s, "b", {-1, 0, 0});
  add_curved_beam(s, a, b, BeamPath::arc, {{0, 0, 1}}, 16,
                  BeamProperties::of(steel_material(), Section::rectangle(0.1, 0.01),
                                     BeamTheory::euler_bernoulli));
  const auto inwards = [&s](int e) {
    const auto [first, last] = s.beams.ends(e);
    const Vector3d way = s.nodes[static_cast<std::size_t>(last)].position -
                         s.nodes[static_cast<std::size_t>(first)].position;
    return s.beams.portion(e).up->cross(way.normalized()).y();
  };
  for (int e = 0; e < 16; ++e) EXPECT_NEAR(inwards(e), inwards(0), 1e-12) << e;
  EXPECT_NEAR(std::abs(inwards(0)), 1.0, 1e-12);
}

TEST(CurvedBeam, SplinesGoThroughTheirPoints) {
  const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0.2, 0}, {2, 0, 0.3}, {4, 0, 0}};
  for (const BeamPath path : {BeamPath::polyline, BeamPath::spline}) {
    const auto places = divide_path(path, points, 8);
    ASSERT_EQ(places.size(), 9u);
    for (const Vector3d& point : points) {
      double nearest = 1;
      for (const Vector3d& place : places) nearest = std::min(nearest, (place - point).norm());
      EXPECT_LT(nearest, 1e-15);
    }
    // Stretches of 1, 1 and 2 get two, two and four pieces; those of one stretch are alike.
    const double first = (places[1] - places[0]).norm();
    const double second = (places[2] - places[1]).norm();
    if (path == BeamPath::polyline) {
      EXPECT_NEAR(first, second, 1e-15);
    } else {
      // Halves of the first arc of the natural spline over chord lengths, by SciPy's CubicSpline
      // and 400 000 chords, good to 1e-10.
      EXPECT_NEAR(first, 0.5135804131, 1e-9);
      EXPECT_NEAR(second, 0.5115087777, 1e-9);
    }
  }
  // Points of a circle: the spline approximates it to fourth order, except at the ends.
  std::vector<Vector3d> round;
  for (int k = 0; k <= 8; ++k) {
    round.emplace_back(std::cos(std::numbers::pi * k / 8), std::sin(kPi * k / 8), 0);
  }
  const auto places = divide_path(BeamPath::spline, round, 32);
  for (std::size_t k = 8; k <= 24; ++k) EXPECT_NEAR(places[k].norm(), 1.0, 1e-3);
}

TEST(CurvedBeam, RefusesImpossibleWays) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(2, 0, 0), d(1, 1, 0);
  EXPECT_THROW(divide_path(BeamPath::arc, {a, b, c}, 4), ModelError);
  EXPECT_THROW(divide_path(BeamPath::arc, {a, d, b, c}, 4), ModelError);
  EXPECT_THROW(divide_path(BeamPath::polyline, {a, a, c}, 4), ModelError);
  EXPECT_THROW(divide_path(BeamPath::spline, {a, d, b, c}, 2), ModelError);
  Structure s;
  add_node(s, "a", a);
  EXPECT_THROW(add_curved_beam(s, 0, 3, BeamPath::arc, {d}, 4, tapered(cone(0.1, 0.1))),
               ModelError);
}

}  // namespace
}  // namespace buckens::fem

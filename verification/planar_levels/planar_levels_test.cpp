// SPDX-License-Identifier: Apache-2.0
// One planar beam element at each level of inertial coupling; see README.md.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "verification/planar_levels/paper_equations.h"

#include "buckens/base/test/source_directory.h"
#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::planar_levels {
namespace {

using body::CouplingChoice;
using body::CouplingLevel;
using body::CouplingTerm;
using Eigen::Vector3d;
using linalg::Vector;

const std::vector<std::pair<std::string, CouplingLevel>> kTabulated = {
    {"full", CouplingLevel::full},     {"none", CouplingLevel::none},
    {"nocent", CouplingLevel::nocent}, {"nocor", CouplingLevel::nocor},
    {"nojvar", CouplingLevel::nojvar}, {"noquad", CouplingLevel::noquad}};

nlohmann::json read_reference() {
  std::ifstream file(std::string(buckens::test::kSourceDirectory) +
                     "/verification/planar_levels/reference.json");
  return nlohmann::json::parse(file);
}

test::BeamConstants one_element() {
  test::BeamConstants beam;
  beam.EA = 500;
  beam.EIy = beam.EIz = 2;
  beam.elements = 1;
  return beam;
}

model::Model free_element(const CouplingChoice& choice) {
  test::Mechanism m(spatial::Plane::xy);
  m.add_flexible(test::straight_beam(one_element(), spatial::Plane::xy), choice, {});
  return m.take();
}

/// The elastic velocities of the case, sieved.
void vibrate(const model::Model& model, model::State& state) {
  model::BodyState& s = state.bodies[0];
  const auto& dofs = model.bodies[0].flexible->fe.dofs.node_dofs;
  for (const auto& [node, sign] : {std::pair(0, 1.0), std::pair(1, -1.0)}) {
    const auto& dof = dofs[static_cast<std::size_t>(node)];
    s.d_dot.change()[dof[0]] = -0.5 * sign;
    s.d_dot.change()[dof[5]] = 0.8 * sign;
  }
  model.bodies[0].flexible->sieve.apply(s.d_dot.change());
}

test::Start flying(const model::Model& model) {
  return test::consistent_start(model, [&model](model::State& state) {
    body::FrameMotion& frame = state.bodies[0].frame;
    frame.w << 0, 0, 3;
    frame.v << 0.3, 0.1 + 3 * 0.5, 0;
    vibrate(model, state);
  });
}

/// Places of the tip at ten equal instants up to 1 s, two numbers each.
Vector tips(const model::Model& model, const test::Start& start, double h) {
  // Without numerical damping, iterated to rounding: only the error of the step remains.
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, h);
  settings.rho_inf = 1.0;
  settings.iterate_coupling = true;
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  const long steps = std::lround(0.1 / h);
  Vector out(20);
  for (Eigen::Index k = 0; k < 10; ++k) {
    for (long i = 0; i < steps; ++i) stepper.step(state);
    out.segment<2>(2 * k) = test::node_position(model, state, 0, 1).head<2>();
  }
  return out;
}

struct Convergence {
  double coarse = 0, fine = 0;  ///< largest distances from the reference [m]
  double extrapolated = 0;      ///< of (4 fine − coarse)/3
};

Convergence converge(const model::Model& model, const test::Start& start, const Vector& expected) {
  const Vector coarse = tips(model, start, 4e-4);
  const Vector fine = tips(model, start, 2e-4);
  const auto largest = [](const Vector& x) { return x.cwiseAbs().maxCoeff(); };
  return {largest(coarse - expected), largest(fine - expected),
          largest((4.0 * fine - coarse) / 3.0 - expected)};
}

void expect_second_order(const Convergence& c) {
  // Modes up to 130 rad/s, h ω = 0.05: the next term of the expansion is below 1 % of the error.
  EXPECT_NEAR(test::observed_order(c.coarse, c.fine), 2.0, 0.05);
  // Measured 1.4e-6 m (pendulum) and 7e-6 m (flight) at h = 0.2 ms. Accelerations at the start
  // leave a term of order h³, smaller by h ω = 0.026 and less; measured 6 and 30 nm.
  EXPECT_LT(c.fine, 2e-5);
  EXPECT_LT(c.extrapolated, 0.01 * c.fine);
}

Vector tabulated(const nlohmann::json& rows) {
  Vector out(20);
  for (std::size_t k = 0; k < 10; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      out[static_cast<Eigen::Index>(2 * k + i)] = rows[k + 1][i].get<double>();
    }
  }
  return out;
}

TEST(PlanarLevels, PendulumAtEveryTabulatedLevel) {
  const auto reference = read_reference();
  for (const auto& [name, level] : kTabulated) {
    SCOPED_TRACE(name);
    model::Model model = test::planar_beam_pendulum(one_element(), level);
    const test::Start start = test::consistent_start(model);
    const Convergence found = converge(model, start, tabulated(reference["pendulum"][name]["tip"]));
    expect_second_order(found);
    RecordProperty(name, std::to_string(found.extrapolated * 1e9) + " nm");
  }
}

TEST(PlanarLevels, FreeFlightAtEveryTabulatedLevel) {
  const auto reference = read_reference();
  for (const auto& [name, level] : kTabulated) {
    SCOPED_TRACE(name);
    const model::Model model = free_element(level);
    const Convergence found =
        converge(model, flying(model), tabulated(reference["free"][name]["tip"]));
    expect_second_order(found);
    RecordProperty(name, std::to_string(found.extrapolated * 1e9) + " nm");
  }
}

TEST(PlanarLevels, EverySwitchFollowsTheEquationsAsPrinted) {
  // A second route for what the table does not hold: FM (48), (49) with the element's printed
  // matrices, integrated by Runge–Kutta.
  std::vector<CouplingChoice> choices = {CouplingLevel::first_order};
  for (int k = 0; k < 7; ++k) {
    choices.emplace_back(CouplingLevel::full, std::vector{static_cast<CouplingTerm>(k)});
  }
  for (const CouplingChoice& choice : choices) {
    SCOPED_TRACE(to_string(choice.terms));
    const model::Model model = free_element(choice);
    const Vector expected = paper::free_flight_tips(choice.terms);
    expect_second_order(converge(model, flying(model), expected));
  }
}

TEST(PlanarLevels, PaperRouteReproducesTheTable) {
  const auto reference = read_reference();
  for (const auto& [name, level] : kTabulated) {
    const Vector expected = tabulated(reference["free"][name]["tip"]);
    const Vector found = paper::free_flight_tips(CouplingChoice(level).terms);
    // Runge–Kutta with h = 1e-4 s: (h ω)⁴ is 3e-8 of motions of some centimetres.
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8) << name;
  }
}

/// Largest deviations of the level's own energy and angular momentum in free flight, relative.
std::pair<double, double> drift(CouplingLevel level, double h) {
  const model::Model model = free_element(level);
  const test::Start start = flying(model);
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, h);
  settings.rho_inf = 1.0;
  stepping::Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  const double E = dynamics::energy(model, state).total();
  const double H = dynamics::momentum(model, state).angular.z();
  std::pair<double, double> out{0, 0};
  for (long k = std::lround(1.0 / h); k > 0; --k) {
    stepper.step(state);
    const double energy = dynamics::energy(model, state).total();
    out.first = std::max(out.first, std::abs(energy / E - 1.0));
    out.second =
        std::max(out.second, std::abs(dynamics::momentum(model, state).angular.z() / H - 1.0));
  }
  return out;
}

TEST(PlanarLevels, LevelsFromALagrangianConserveTheirEnergyAndMomentum) {
  for (const CouplingLevel level :
       {CouplingLevel::full, CouplingLevel::first_order, CouplingLevel::none}) {
    SCOPED_TRACE(to_string(level));
    const auto coarse = drift(level, 4e-4);
    const auto fine = drift(level, 2e-4);
    // Only errors of the step are left, and they fall with its square.
    EXPECT_LT(fine.first, 2e-5);
    EXPECT_LT(fine.second, 1e-5);
    if (level == CouplingLevel::none) {
      // A linear vibration and a constant spin: nothing but rounding of 5000 steps.
      EXPECT_LT(fine.first, 1e-11);
      continue;
    }
    EXPECT_NEAR(test::observed_order(coarse.first, fine.first), 2.0, 0.1);
    EXPECT_NEAR(test::observed_order(coarse.second, fine.second), 2.0, 0.1);
  }
}

}  // namespace
}  // namespace buckens::verification::planar_levels

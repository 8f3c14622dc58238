// SPDX-License-Identifier: Apache-2.0
// A soft block of solids tumbles freely at three levels of coupling; see README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/analysis/initial/prepare.h"
#include "buckens/analysis/simulation/simulate.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::free_flight_hex8 {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const std::string kFlightFolder =
    std::string(buckens::test::kSourceDirectory) + "/verification/free_flight_hex8/";

nlohmann::json read_reference() {
  std::ifstream file(kFlightFolder + "reference.json");
  return nlohmann::json::parse(file);
}

Vector3d vector_of(const nlohmann::json& list) {
  const auto values = list.get<std::array<double, 3>>();
  return Vector3d(values[0], values[1], values[2]);
}

std::unique_ptr<model::BuiltModel> flying_block(const std::vector<std::string>& changes) {
  return model::build_model(model_file::read_model_file(kFlightFolder + "model.yaml", changes));
}

TEST(FreeFlightHex8, StartsAsTheReference) {
  const auto reference = read_reference();
  const auto built = flying_block({});
  const body::Body& body = built->model.bodies[0];
  EXPECT_NEAR(body.mass, reference["model"]["m"], 1e-13 * body.mass);
  const Vector3d J0 = vector_of(reference["model"]["J0"]);
  EXPECT_NEAR((body.J0.diagonal() - J0).norm(), 0, 1e-14);
  const dynamics::MassMetric metric(built->model);
  const model::State state = analysis::prepare(*built, metric).state;
  const double energy = reference["E_total"];
  EXPECT_NEAR(dynamics::energy(built->model, state).total(), energy, 1e-13 * energy);
  EXPECT_NEAR((dynamics::momentum(built->model, state).angular - vector_of(reference["H"])).norm(),
              0, 1e-13);
}

/// Deviations from the reference at the end.
struct Miss {
  double corner = 0;    ///< [m]
  double rotation = 0;  ///< of the frame [rad]
  double spin = 0;      ///< of the angular velocity [rad/s]
  double corner_ever = 0;
};

Miss miss(double step) {
  const auto reference = read_reference();
  const auto built = flying_block({fmt::format("simulation.step={}", step)});
  results::Table table;
  analysis::simulate(*built, table, {});
  const Eigen::MatrixXd pose = table.values("bodies/block/pose");
  const Eigen::MatrixXd spin = table.values("bodies/block/angular_velocity");
  const Eigen::MatrixXd corner = table.values("sensors/corner");
  const auto last = static_cast<Eigen::Index>(reference["t"].size()) - 1;
  EXPECT_EQ(pose.rows(), last + 1);
  Miss out;
  for (Eigen::Index k = 0; k <= last; ++k) {
    const Vector3d known = vector_of(reference["node_last"][static_cast<std::size_t>(k)]);
    out.corner = (corner.row(k).transpose() - known).norm();
    out.corner_ever = std::max(out.corner_ever, out.corner);
  }
  const auto& q = reference["quat_wxyz"].back();
  const Quaterniond known(q[0], q[1], q[2], q[3]);
  const Quaterniond found(pose(last, 3), pose(last, 4), pose(last, 5), pose(last, 6));
  out.rotation = known.angularDistance(found);
  const Vector3d w = vector_of(reference["omega_body"].back());
  out.spin = (spin.row(last).transpose() - w).norm();
  return out;
}

TEST(FreeFlightHex8, FullCouplingConvergesToTheReference) {
  const Miss coarse = miss(6.25e-5);
  const Miss middle = miss(3.125e-5);
  const Miss fine = miss(7.8125e-6);
  // Errors at one instant are smooth in h: order 2 to a few per cent, once the fastest vibrations
  // of the mesh are followed.
  for (const auto& [name, of] :
       {std::pair("corner", &Miss::corner), {"rotation", &Miss::rotation}, {"spin", &Miss::spin}}) {
    RecordProperty(name, fmt::format("{:.3g} {:.3g} {:.3g}", coarse.*of, middle.*of, fine.*of));
    EXPECT_NEAR(test::observed_order(coarse.*of, middle.*of), 2.0, 0.1) << name;
    EXPECT_NEAR(0.5 * test::observed_order(middle.*of, fine.*of), 2.0, 0.1) << name;
  }
  // Asked for.
  EXPECT_LT(fine.corner, 1e-5);
  EXPECT_LT(fine.corner_ever, 1e-5);
  EXPECT_LT(fine.rotation, 1e-5);
  EXPECT_LT(fine.spin, 1e-5);
}

/// Relative changes of the exact energy and angular momentum, maxima over the tabulated times.
struct Drift {
  double energy = 0, momentum = 0;
};

Drift drift(const std::string& level, double step) {
  const auto built = flying_block({"bodies.block.coupling=" + level});
  const dynamics::MassMetric metric(built->model);
  const analysis::Prepared start = analysis::prepare(*built, metric);
  stepping::StepSettings settings = test::settings(stepping::Method::generalized_alpha, step);
  settings.rho_inf = 1.0;
  stepping::Stepper stepper(built->model, settings, start.rows_in_use);
  const auto exact = [&](model::State state) {
    state.bodies[0].terms = body::CouplingTerms{};  // all of them, whatever the body keeps
    return std::pair(dynamics::energy(built->model, state).total(),
                     dynamics::momentum(built->model, state).angular);
  };
  model::State state = start.state;
  const auto [energy, momentum] = exact(state);
  Drift out;
  const long per_record = std::lround(0.1 / step);
  for (int k = 0; k < 10; ++k) {
    for (long i = 0; i < per_record; ++i) stepper.step(state);
    const auto [e, h] = exact(state);
    out.energy = std::max(out.energy, std::abs(e / energy - 1.0));
    out.momentum = std::max(out.momentum, (h - momentum).norm() / momentum.norm());
  }
  return out;
}

TEST(FreeFlightHex8, ReducedCouplingDriftsAsTabulated) {
  const auto reference = read_reference();
  for (const auto& [level, name] :
       {std::pair("first-order", "level_noquad_cons"), {"none", "level_none"}}) {
    const Drift found = drift(level, 1e-4);
    const double energy = reference[name]["dE_rel"];
    const double momentum = reference[name]["dH_rel"];
    RecordProperty(level,
                   fmt::format("energy {:.5g}, momentum {:.5g}", found.energy, found.momentum));
    // Asked for: 5 %. Both integrate the same equations with other methods and steps.
    EXPECT_NEAR(found.energy, energy, 0.05 * energy) << level;
    EXPECT_NEAR(found.momentum, momentum, 0.05 * momentum) << level;
  }
}

TEST(FreeFlightHex8, FullCouplingKeepsEnergyAndMomentumToTheSquareOfTheStep) {
  const Drift coarse = drift("full", 2.5e-4);
  const Drift fine = drift("full", 1.25e-4);
  RecordProperty("energy", fmt::format("{:.3g} {:.3g}", coarse.energy, fine.energy));
  RecordProperty("momentum", fmt::format("{:.3g} {:.3g}", coarse.momentum, fine.momentum));
  EXPECT_NEAR(test::observed_order(coarse.energy, fine.energy), 2.0, 0.15);
  EXPECT_NEAR(test::observed_order(coarse.momentum, fine.momentum), 2.0, 0.15);
}

}  // namespace
}  // namespace buckens::verification::free_flight_hex8

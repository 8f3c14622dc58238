// SPDX-License-Identifier: Apache-2.0
// Sensors of flexible bodies against deformations given by hand.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;
using model::test::at_marker;
using model::test::Described;
using model::test::kArea;
using model::test::kE;
using model::test::kIz;
using model::test::kWidth;
using test::Recorded;

using NodeField = std::function<Eigen::Matrix<double, 6, 1>(const Vector3d&)>;

/// Sets d (or its rate) from a field of translations and rotations over s, from the mass centre.
void set_nodes(const body::Body& body, const NodeField& field, linalg::Vector& d) {
  const fem::FeModel& fe = body.flexible->fe;
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Eigen::Matrix<double, 6, 1> value = field(fe.nodes[n].position - body.com);
    for (int k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[n][static_cast<std::size_t>(k)];
      if (dof >= 0) d[dof] = value[k];
    }
  }
}

Eigen::Matrix<double, 6, 1> translation(const Vector3d& u) {
  Eigen::Matrix<double, 6, 1> out = Eigen::Matrix<double, 6, 1>::Zero();
  out.head<3>() = u;
  return out;
}

/// Beam of length 2 along x.
Described beam() {
  Described m;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 4);
  return m;
}

TEST(BeamSensors, DeflectionIsSeenFromTheChordOrTheFrame) {
  Described m = beam();
  m.sensor_of<model::DeflectionSensor>("chord", "rod/mid");
  m.sensor_of<model::DeflectionSensor>("frame", "rod/mid").from = model::DeflectionBase::frame;
  Recorded run(m);
  const body::Body& body = run.built->model.bodies[0];
  // A sag towards +y on top of a rigid motion: turned by 0.2 about z and moved.
  const Eigen::Matrix3d R = spatial::exp_rotation({0, 0, 0.2}).toRotationMatrix();
  const Vector3d moved(0.3, 0.1, -0.2);
  const auto sag = [](double x) { return Vector3d(0, 0.01 * (1 - x * x), 0); };
  set_nodes(
      body, [&](const Vector3d& s) { return translation(R * (s + sag(s.x())) - s + moved); },
      run.body().d.change());
  run.record();
  // Rigid motion of the mesh does not count from the chord. Rounding only.
  EXPECT_NEAR((run.sensor("chord") - Vector3d(0, 0.01, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((run.sensor("frame") - (R * Vector3d(0, 0.01, 0) + moved)).norm(), 0, 1e-15);
  // Nor does the motion of the frame.
  run.body().frame.X_WB.q = spatial::exp_rotation({1, 2, 3});
  run.record();
  EXPECT_NEAR((run.sensor("chord") - Vector3d(0, 0.01, 0)).norm(), 0, 1e-15);
}

TEST(BeamSensors, ChordsNeedNamedEnds) {
  Described m;
  m.truss("bar", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}}, {{"a", "b"}});
  m.sensor_of<model::DeflectionSensor>("chord", "bar/a");
  EXPECT_THROW(m.build(), InputError);
  std::get<model::DeflectionSensor>(m.d.output.sensors[0].kind).from = model::DeflectionBase::frame;
  EXPECT_NO_THROW(m.build());
}

TEST(BeamSensors, MarkersFollowTheMesh) {
  Described m = beam();
  m.sensor_of<model::PositionSensor>("position", "rod/end");
  m.sensor_of<model::VelocitySensor>("velocity", "rod/end");
  m.sensor_of<model::AccelerationSensor>("acceleration", "rod/end");
  m.sensor_of<model::RotationSensor>("rotation", "rod/end");
  m.sensor_of<model::AngularVelocitySensor>("spin", "rod/end");
  Recorded run(m);
  run.record();
  const body::Body& body = run.built->model.bodies[0];
  // Stretched along x, growing and accelerating, while the frame spins about z with 3 rad/s.
  const auto stretch = [](double rate) {
    return [rate](const Vector3d& s) { return translation({rate * s.x(), 0, 0}); };
  };
  set_nodes(body, stretch(0.5), run.body().d.change());
  set_nodes(body, stretch(0.25), run.body().d_dot.change());
  set_nodes(body, stretch(0.125), run.body().d_ddot.change());
  run.body().frame.w = {0, 0, 3};
  run.record();
  const double r = 1.5;
  const auto near = [&](const char* name, const Vector3d& expected) {
    EXPECT_NEAR((run.sensor(name) - expected).norm(), 0, 1e-14) << name;
  };
  near("position", {1 + r, 0, 0});
  near("velocity", {0.25, 3 * r, 0});
  near("acceleration", {0.125 - 9 * r, 2 * 3 * 0.25, 0});  // centripetal and Coriolis
  near("rotation", {0, 0, 0});
  near("spin", {0, 0, 3});
}

TEST(BeamSensors, EndRotationsTurnTheMarker) {
  Described m = beam();
  m.sensor_of<model::RotationSensor>("rotation", "rod/end");
  m.sensor_of<model::AngularVelocitySensor>("spin", "rod/end");
  Recorded run(m);
  run.record();
  const body::Body& body = run.built->model.bodies[0];
  const auto twist = [](double angle) {
    return [angle](const Vector3d& s) {
      Eigen::Matrix<double, 6, 1> out = Eigen::Matrix<double, 6, 1>::Zero();
      out[3] = angle * s.x();
      return out;
    };
  };
  set_nodes(body, twist(0.2), run.body().d.change());
  set_nodes(body, twist(0.7), run.body().d_dot.change());
  run.record();
  EXPECT_NEAR((run.sensor("rotation") - Vector3d(0.2, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((run.sensor("spin") - Vector3d(0.7, 0, 0)).norm(), 0, 1e-15);
}

/// Section and stress sensors at the middle, the third element and everywhere.
Described sections() {
  Described m = beam();
  m.sensor_of<model::SectionForceSensor>("mid", "rod/mid");
  m.sensor_of<model::SectionForceSensor>("third", "rod").element = 3;
  m.sensor_of<model::StressSensor>("mid_stress", "rod/mid");
  m.sensor_of<model::StressSensor>("any_stress", "rod");
  return m;
}

TEST(BeamSensors, TensionGivesNormalForceAndStress) {
  Recorded run(sections());
  const double strain = 1e-4;
  set_nodes(
      run.built->model.bodies[0],
      [&](const Vector3d& s) {
        return translation({strain * s.x(), 0, 0});
      },
      run.body().d.change());
  run.record();
  const double N = kE * kArea * strain;
  for (const char* name : {"mid", "third"}) {
    const std::string sensor = name;
    // Rounding of K d relative to the stiffest entry: 1e-13 of N.
    EXPECT_NEAR((run.sensor(sensor + ".force") - Vector3d(N, 0, 0)).norm(), 0, 1e-12 * N);
    EXPECT_NEAR(run.sensor(sensor + ".moment").norm(), 0, 1e-12 * N);
  }
  for (const char* name : {"mid_stress", "any_stress"}) {
    EXPECT_NEAR(run.sensor(name)[0], kE * strain, 1e-10 * kE * strain);
    EXPECT_NEAR(run.sensor(name)[1], kE * strain, 1e-10 * kE * strain);
  }
}

TEST(BeamSensors, CurvatureGivesBendingMoment) {
  Recorded run(sections());
  const double curvature = 1e-3;  // v″ in the x-y plane
  set_nodes(
      run.built->model.bodies[0],
      [&](const Vector3d& s) {
        Eigen::Matrix<double, 6, 1> out = translation({0, 0.5 * curvature * s.x() * s.x(), 0});
        out[5] = curvature * s.x();
        return out;
      },
      run.body().d.change());
  run.record();
  const double Mz = kE * kIz * curvature;
  for (const char* name : {"mid", "third"}) {
    const std::string sensor = name;
    EXPECT_NEAR((run.sensor(sensor + ".moment") - Vector3d(0, 0, Mz)).norm(), 0, 1e-10 * Mz);
    EXPECT_NEAR(run.sensor(sensor + ".force").norm(), 0, 1e-9 * Mz);
  }
  // Outer fibre at half the width.
  const double stress = kE * curvature * kWidth / 2;
  EXPECT_NEAR(run.sensor("mid_stress")[0], stress, 1e-10 * stress);
  EXPECT_NEAR(run.sensor("any_stress")[0], stress, 1e-10 * stress);
}

TEST(BeamSensors, LargestStressIsThatOfTheWorstElement) {
  Recorded run(sections());
  // Only the outer half beyond the middle is stretched.
  set_nodes(
      run.built->model.bodies[0],
      [&](const Vector3d& s) {
        return translation({s.x() > 0 ? 1e-4 * s.x() : 0, 0, 0});
      },
      run.body().d.change());
  run.record();
  EXPECT_NEAR(run.sensor("mid.force")[0], 0, 1e-6);
  EXPECT_NEAR(run.sensor("third.force")[0], kE * kArea * 1e-4, 1e-6);
  EXPECT_NEAR(run.sensor("any_stress")[0], kE * 1e-4, 1e-10 * kE * 1e-4);
}

/// Sensors of all that a recorder forms only where it is read.
Described read_in_any_order() {
  Described m = sections();
  m.sensor_of<model::AccelerationSensor>("shaken", "rod/end");
  m.sensor<model::EnergySensor>("strain").kind = model::EnergyKind::strain;
  m.sensor<model::EnergySensor>("balance").kind = model::EnergyKind::balance;
  return m;
}

TEST(BeamSensors, AreReadAsTheyAreRecorded) {
  const auto deform = [](Recorded& run, double factor) {
    const linalg::Vector bent = linalg::Vector::LinSpaced(run.body().d.size(), -1e-3, 2e-3);
    run.body().d = factor * bent;
    run.body().d_ddot = -50.0 * factor * bent;
  };
  Recorded whole(read_in_any_order()), alone(read_in_any_order());
  deform(whole, 1.0);
  whole.record();
  // Balances count from the first reading, of whatever sensor.
  deform(alone, 1.0);
  (void)alone.recorder.read(alone.state, {}, {{0, 0}});
  for (Recorded* run : {&whole, &alone}) deform(*run, 2.0);
  whole.record();
  const std::vector<std::string> values = {"mid.force", "third.force", "mid_stress", "any_stress",
                                           "shaken",    "strain",      "balance"};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double recorded = whole.sensor(values[k])[0];
    EXPECT_NE(recorded, 0.0) << values[k];
    EXPECT_EQ(alone.recorder.read(alone.state, {}, {{k, 0}})[0], recorded) << values[k];
  }
}

TEST(BeamSensors, SectionForcesNeedASection) {
  Described m = beam();
  m.sensor_of<model::SectionForceSensor>("whole", "rod");
  EXPECT_THROW(Recorded{m}, InputError);
}

}  // namespace
}  // namespace buckens::results

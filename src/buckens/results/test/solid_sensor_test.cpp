// SPDX-License-Identifier: Apache-2.0
// What is recorded of solids, against fields of displacement given by hand.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/results/test/recorded.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using model::test::kE;
using test::Recorded;

constexpr double kShear = kE / 2.6;  // G for nu = 0.3

void move_solid_nodes(const body::Body& body, const std::function<Vector3d(const Vector3d&)>& field,
                      linalg::Vector& d) {
  const fem::FeModel& fe = body.flexible->fe;
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Vector3d u = field(fe.nodes[n].position);
    for (int k = 0; k < 3; ++k) d[fe.dofs.node_dofs[n][static_cast<std::size_t>(k)]] = u[k];
  }
}

Described sensed_block() {
  Described m;
  m.block("block", {0.4, 0.2, 0.2}, {4, 2, 2});
  m.sensor_of<model::StressSensor>("all", "block");
  m.sensor_of<model::StressSensor>("first", "block/node_first");
  m.sensor_of<model::StressSensor>("middle", "block/centre");
  return m;
}

TEST(SolidSensors, UniformStrainGivesTheSameStressEverywhere) {
  Recorded run(sensed_block());
  const double strain = 1e-4;
  move_solid_nodes(
      run.built->model.bodies[0], [&](const Vector3d& s) { return Vector3d(strain * s.x(), 0, 0); },
      run.body().d.change());
  run.record();
  // Hindered sideways, the von Mises stress is 2 G ε. Rounding of B d relative to E.
  const double mises = 2 * kShear * strain;
  for (const char* name : {"all", "first", "middle"}) {
    ASSERT_EQ(run.sensor(name).size(), 1) << name;
    EXPECT_NEAR(run.sensor(name)[0], mises, 1e-10 * mises) << name;
  }
  const Eigen::VectorXd elements = run.values("bodies/block/solid_stress");
  ASSERT_EQ(elements.size(), 16);
  EXPECT_NEAR((elements.array() - mises).abs().maxCoeff(), 0, 1e-10 * mises);
}

TEST(SolidSensors, NodesShowTheMeanOfTheElementsAround) {
  Recorded run(sensed_block());
  const double rate = 1e-3;
  // Shear γ_xy = 2 rate (x − 0.2): opposite on both sides of the middle; the trilinear field takes
  // at the centre of an element the mean of its corner planes.
  move_solid_nodes(
      run.built->model.bodies[0],
      [&](const Vector3d& s) { return Vector3d(0, rate * std::pow(s.x() - 0.2, 2), 0); },
      run.body().d.change());
  run.record();
  const double at_end = std::sqrt(3.0) * kShear * 2 * rate * 0.15;
  EXPECT_NEAR(run.sensor("all")[0], at_end, 1e-10 * at_end);
  EXPECT_NEAR(run.sensor("first")[0], at_end, 1e-10 * at_end);
  EXPECT_NEAR(run.sensor("middle")[0], 0, 1e-10 * at_end);
}

TEST(SolidSensors, DividedBlocksRecordElementsInTheOrderOfTheWhole) {
  Described whole = sensed_block();
  Described divided = sensed_block();
  divided.d.bodies[0].frames.count = 3;
  const auto field = [](const Vector3d& s) {
    return Vector3d(1e-3 * s.x() * s.x(), 2e-4 * s.x() * s.y(), 1e-4 * s.z() * s.y());
  };
  Recorded one(whole);
  Recorded three(divided);
  for (Recorded* run : {&one, &three}) {
    for (std::size_t b = 0; b < run->built->model.bodies.size(); ++b) {
      move_solid_nodes(run->built->model.bodies[b], field, run->body(b).d.change());
    }
    run->record();
  }
  const Eigen::VectorXd expected = one.values("bodies/block/solid_stress");
  EXPECT_NEAR((three.values("bodies/block/solid_stress") - expected).cwiseAbs().maxCoeff(), 0,
              1e-10 * expected.maxCoeff());
  EXPECT_NEAR(three.sensor("all")[0], expected.maxCoeff(), 1e-10 * expected.maxCoeff());
}

/// Stresses of all, of one element, around a node and around an interface.
Described read_block() {
  Described m = sensed_block();
  m.sensor_of<model::StressSensor>("fifth", "block").element = 5;
  body::InterfaceSpec interface;
  interface.name = "end";
  interface.where = model::test::at_line(45);
  interface.region = fem::NamedFaceSpec{model::test::at_line(46), "x1"};
  m.d.bodies[0].interfaces.push_back(interface);
  m.sensor_of<model::StressSensor>("end", "block/end");
  return m;
}

/// That each sensor, and all of them together, are read with the bits of a record.
void expect_bits_of_records(const Described& m) {
  Recorded run(m);
  for (std::size_t b = 0; b < run.state.bodies.size(); ++b) {
    linalg::Vector& d = run.body(b).d.change();
    for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = 1e-4 * std::sin(static_cast<double>(7 * k));
  }
  run.record();
  const std::vector<std::string> names = {"all", "first", "middle", "fifth", "end"};
  std::vector<Recorder::SensorValue> every;
  std::vector<double> recorded;
  for (std::size_t k = 0; k < names.size(); ++k) {
    recorded.push_back(run.sensor(names[k])[0]);
    EXPECT_GT(recorded[k], 0.0) << names[k];
    every.push_back({k, 0});
    EXPECT_THAT(run.recorder.read(run.state, {}, {{k, 0}}), testing::ElementsAre(recorded[k]))
        << names[k];
  }
  EXPECT_EQ(run.recorder.read(run.state, {}, every), recorded);
  every.erase(every.begin());
  recorded.erase(recorded.begin());
  EXPECT_EQ(run.recorder.read(run.state, {}, every), recorded) << "without the largest";
}

TEST(SolidSensors, AreReadAsTheyAreRecorded) {
  Described m = read_block();
  expect_bits_of_records(m);
  // Nodes that follow others, parts with frames of their own, and modes.
  m.d.bodies[0].interfaces[0].kind = body::InterfaceKind::rigid;
  expect_bits_of_records(m);
  m.d.bodies[0].frames.count = 2;
  expect_bits_of_records(m);
  m.d.bodies[0].frames.count = 1;
  m.d.bodies[0].reduction.free_free.emplace().modes = 12;
  expect_bits_of_records(m);
}

TEST(SolidSensors, GeometryIsTheSurface) {
  Recorded run(sensed_block());
  const GeometryBody body = run.recorder.geometry().bodies.at(0);
  EXPECT_EQ(body.kind, BodyKind::solid);
  EXPECT_EQ(body.nodes.rows(), 45);
  EXPECT_TRUE(body.elements.empty());
  ASSERT_EQ(body.faces.size(), 2U * (4 * 2 + 4 * 2 + 2 * 2));
  ASSERT_EQ(body.face_elements.size(), body.faces.size());
  // Faces look outwards and enclose the volume: ∮ s·n dA = 3 V.
  double volume = 0;
  for (const auto& face : body.faces) {
    const auto at = [&](std::size_t k) { return Vector3d(body.nodes.row(face[k]).transpose()); };
    const Vector3d area = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
    volume += area.dot(0.25 * (at(0) + at(1) + at(2) + at(3))) / 3;
  }
  EXPECT_NEAR(volume, 0.016, 1e-15);
}

}  // namespace
}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/model_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/model_file/test/sample.h"

namespace buckens::model_file {
namespace {

using model::ModelDescription;

const ModelDescription& sample() {
  static const ModelDescription model = read_model_text(kSampleModel, "sample.yaml");
  return model;
}

template <class T>
const T& entry(const std::vector<T>& list, const std::string& name) {
  const T* found = base::find_named(list, name);
  if (found == nullptr) throw std::out_of_range(name);
  return *found;
}

TEST(ModelFile, HeadParametersAndMaterialsAreInSiUnits) {
  const ModelDescription& m = sample();
  EXPECT_EQ(m.title, "Sample: all keys");
  EXPECT_EQ(m.gravity, Eigen::Vector3d(0, -9.81, 0));
  EXPECT_EQ(m.planar, spatial::Plane::xy);
  EXPECT_DOUBLE_EQ(entry(m.parameters, "L").value, 0.3);
  EXPECT_DOUBLE_EQ(entry(m.parameters, "half").value, 0.15);
  const auto& steel = entry(m.materials, "steel");
  EXPECT_DOUBLE_EQ(steel.E, 200e9);
  EXPECT_DOUBLE_EQ(steel.shear_modulus(), 200e9 / 2.6);
  EXPECT_DOUBLE_EQ(steel.damping->beta(), 1e-7);
  EXPECT_EQ(steel.where.text(), "sample.yaml:8:3");
  const auto& soft = entry(m.materials, "soft");
  EXPECT_DOUBLE_EQ(soft.shear_modulus(), 0.8e9);
  // ζ = (α/ω + βω)/2 at both frequencies.
  for (const double f : {10.0, 200.0}) {
    const double w = 2 * M_PI * f;
    EXPECT_NEAR((soft.damping->alpha() / w + soft.damping->beta() * w) / 2, 0.02, 1e-15);
  }
}

TEST(ModelFile, Bodies) {
  const ModelDescription& m = sample();
  const auto& crank = entry(m.bodies, "crank");
  const auto& rigid = std::get<body::RigidSpec>(crank.kind);
  EXPECT_DOUBLE_EQ(rigid.mass, 0.36);
  EXPECT_DOUBLE_EQ(rigid.com.x(), 0.075);
  EXPECT_DOUBLE_EQ(rigid.inertia_matrix()(2, 2), 2.727e-3);
  EXPECT_NEAR((crank.at.rotation() * Eigen::Vector3d::UnitX()).y(), 0.5, 1e-15);
  const auto& rod = entry(m.bodies, "rod");
  const auto& beam = std::get<fem::BeamSpec>(rod.kind);
  EXPECT_DOUBLE_EQ(beam.to.x(), 0.3);
  EXPECT_EQ(beam.elements, 16);
  EXPECT_EQ(beam.material.name, "steel");
  EXPECT_DOUBLE_EQ(beam.material->E, 200e9);
  EXPECT_DOUBLE_EQ(std::get<fem::CircleSpec>(beam.section->shape).diameter, 6e-3);
  EXPECT_EQ(beam.theory, fem::BeamTheory::timoshenko);
  EXPECT_FALSE(beam.has_rotary_inertia());
  EXPECT_DOUBLE_EQ(beam.masses.at(0).mass, 0.033);
  EXPECT_EQ(rod.coupling.level, body::CouplingLevel::none);
  EXPECT_DOUBLE_EQ(rod.damping->alpha(), 2.0);
  const auto& structure = std::get<fem::StructureSpec>(entry(m.bodies, "frame").kind);
  EXPECT_EQ(structure.nodes.size(), 3u);
  EXPECT_EQ(structure.nodes[2].position, Eigen::Vector3d(1, 1, 0));
  EXPECT_DOUBLE_EQ(*structure.bars.at(0).area, 1e-4);
  EXPECT_DOUBLE_EQ(std::get<fem::TubeSpec>((*structure.bars.at(1).section)->shape).inner(), 0.034);
  const auto& twin = entry(m.bodies, "twin");
  EXPECT_EQ(twin.like, "rod");
  EXPECT_EQ(std::get<fem::BeamSpec>(twin.kind).elements, 16);
  EXPECT_EQ(twin.at.position.y(), 1.0);
  EXPECT_EQ(twin.coupling.level, body::CouplingLevel::full);
}

TEST(ModelFile, Solids) {
  const ModelDescription& m = sample();
  const auto& mesh = std::get<fem::MeshSpec>(entry(m.bodies, "block").kind);
  const auto& box = std::get<fem::BoxMeshSpec>(mesh.shape);
  EXPECT_EQ(box.from, Eigen::Vector3d(2, 2, 0));
  EXPECT_EQ(box.size, Eigen::Vector3d(1, 0.2, 0.2));
  EXPECT_THAT(box.divisions, testing::ElementsAre(4, 2, 2));
  EXPECT_EQ(mesh.material->name, "steel");
  EXPECT_EQ(mesh.masses.at(0).at, "centre");
  const auto& lump = std::get<fem::StructureSpec>(entry(m.bodies, "lump").kind);
  EXPECT_THAT(lump.solids.at(0).nodes,
              testing::ElementsAre("a", "b", "c", "d", "e", "f", "g", "h"));
  EXPECT_DOUBLE_EQ(lump.solids.at(0).material->rho, 7870);
  const auto& local = std::get<model::StressSensor>(entry(m.output.sensors, "local").kind);
  EXPECT_EQ(local.of.marker, "corner_000");
  const ModelDescription finer =
      read_model_text(kSampleModel, "sample.yaml", {"bodies.block.mesh.box.divisions=[8, 2, 2]"});
  EXPECT_EQ(
      std::get<fem::BoxMeshSpec>(std::get<fem::MeshSpec>(entry(finer.bodies, "block").kind).shape)
          .divisions[0],
      8);
}

TEST(ModelFile, OneNameStandsForAListOfNames) {
  const ModelDescription m =
      read_model_text(kSampleModel, "sample.yaml", {"bodies.block.interfaces.edge.set=corner_100"});
  const auto& edge = entry(entry(m.bodies, "block").interfaces, "edge");
  EXPECT_THAT(std::get<fem::NodeSetSpec>(edge.region).nodes, testing::ElementsAre("corner_100"));
}

TEST(ModelFile, Interfaces) {
  const auto& block = entry(sample().bodies, "block");
  ASSERT_EQ(block.interfaces.size(), 6u);
  const body::InterfaceSpec& left = entry(block.interfaces, "left");
  EXPECT_EQ(std::get<fem::NamedFaceSpec>(left.region).name, "x0");
  EXPECT_EQ(left.kind, body::InterfaceKind::rigid);
  EXPECT_EQ(*left.at, Eigen::Vector3d(2, 2.1, 0.05));
  EXPECT_NEAR(left.rotation().z(), std::sin(std::numbers::pi / 12), 1e-15);
  const body::InterfaceSpec& edge = entry(block.interfaces, "edge");
  EXPECT_EQ(edge.kind, body::InterfaceKind::average);
  EXPECT_THAT(std::get<fem::NodeSetSpec>(edge.region).nodes,
              testing::ElementsAre("corner_100", "corner_101"));
  const auto& lump = std::get<fem::SphereSelection>(entry(block.interfaces, "lump").region);
  EXPECT_DOUBLE_EQ(lump.radius, 0.06);
  EXPECT_DOUBLE_EQ(*lump.tolerance, 1e-3);
  EXPECT_EQ(std::get<fem::BoxSelection>(entry(block.interfaces, "top").region).to.z(), 0.2);
  const auto& bore = std::get<fem::CylinderSelection>(entry(block.interfaces, "bore").region);
  EXPECT_EQ(bore.to, Eigen::Vector3d(2.5, 2.2, 0.1));
  EXPECT_FALSE(bore.tolerance);
  EXPECT_EQ(std::get<fem::PlaneSelection>(entry(block.interfaces, "cut").region).normal,
            Eigen::Vector3d::UnitX());
}

TEST(ModelFile, RoundSolidsAndOrthotropicMaterials) {
  const ModelDescription& m = sample();
  const auto& shaft = std::get<fem::MeshSpec>(entry(m.bodies, "shaft").kind);
  const auto& bar = std::get<fem::CylinderMeshSpec>(shaft.shape);
  EXPECT_EQ(bar.form(), fem::SolidForm::usual(fem::SolidKind::tet10));
  EXPECT_EQ(bar.shape().to, Eigen::Vector3d(8, 0, 0));
  EXPECT_DOUBLE_EQ(bar.shape().outer_radius, 0.1);
  const auto& sleeve =
      std::get<fem::TubeMeshSpec>(std::get<fem::MeshSpec>(entry(m.bodies, "sleeve").kind).shape);
  EXPECT_EQ(sleeve.form(),
            (fem::SolidForm{fem::SolidKind::hex8, fem::SolidIntegration::incompatible_modes}));
  EXPECT_DOUBLE_EQ(sleeve.shape().inner_radius, 0.015);
  const auto& wheel =
      std::get<fem::DiscMeshSpec>(std::get<fem::MeshSpec>(entry(m.bodies, "wheel").kind).shape);
  EXPECT_EQ(wheel.shape().from, Eigen::Vector3d(0, -0.05, 0));
  EXPECT_DOUBLE_EQ(wheel.shape().inner_radius, 0.1);
  const fem::Orthotropy ply = (*shaft.material)->orthotropic->constants();
  EXPECT_EQ(ply.E, Eigen::Vector3d(135e9, 10e9, 8e9));
  EXPECT_DOUBLE_EQ(ply.G23, 3e9);
  Eigen::Matrix3d axes;
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  EXPECT_LE((ply.axes - axes).norm(), 1e-15);
}

TEST(ModelFile, JointsAndLoads) {
  const ModelDescription& m = sample();
  const auto& base_joint = std::get<joints::RevoluteSpec>(entry(m.joints, "base").kind);
  EXPECT_TRUE(base_joint.between[0].is_ground());
  EXPECT_EQ(base_joint.between[1].body, "crank");
  EXPECT_EQ(base_joint.between[1].marker, "origin");
  EXPECT_FALSE(base_joint.axis);
  const auto& weld = std::get<joints::FixedSpec>(entry(m.joints, "weld").kind);
  EXPECT_EQ(*weld.between[0].point, Eigen::Vector3d(0, 2, 0));
  const auto& bushing = std::get<joints::BushingSpec>(entry(m.joints, "soft").kind);
  EXPECT_EQ(bushing.stiffness, Eigen::Vector3d(1e6, 1e6, 0));
  const auto& motor = std::get<joints::PrescribedRotationSpec>(entry(m.joints, "motor").kind);
  EXPECT_DOUBLE_EQ(motor.angle->law.value(2.0), 300);
  const auto& shift = std::get<joints::PrescribedTranslationSpec>(entry(m.joints, "shift").kind);
  EXPECT_DOUBLE_EQ(shift.displacement->law.value(0.1), 2e-3);
  const auto& push = std::get<loads::ForceSpec>(entry(m.loads, "push").kind);
  EXPECT_DOUBLE_EQ(push.value[1].value(0.1), 10 * std::sin(2.0));
  EXPECT_TRUE(push.value[0].is_constant());
  EXPECT_EQ(push.axes, loads::LoadAxes::following);
  const auto& spring = std::get<loads::SpringDamperSpec>(entry(m.loads, "spring").kind);
  EXPECT_EQ(spring.stiffness.number(), 2000);
  EXPECT_DOUBLE_EQ(spring.length->number().value(), 0.12);
  EXPECT_DOUBLE_EQ(spring.force->law.value(2), 6);
}

TEST(ModelFile, InitialSimulationOutput) {
  const ModelDescription& m = sample();
  const auto& crank = entry(m.initial.bodies, "crank");
  EXPECT_NEAR(crank.angular_velocity.z(), 2 * M_PI, 1e-14);
  const auto& field = *entry(m.initial.bodies, "rod").nodal_velocity;
  EXPECT_NEAR(field.y({0.15, 0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(field.rz({0.15, 0, 0}), 0.3, 1e-15);
  EXPECT_EQ(field.x({0.15, 0, 0}), 0.0);
  EXPECT_EQ(m.initial.start, model::StartKind::static_equilibrium);
  EXPECT_TRUE(m.initial.preload);
  ASSERT_TRUE(m.simulation);
  EXPECT_DOUBLE_EQ(m.simulation->step.value(), 1e-4);
  EXPECT_EQ(m.simulation->method, model::IntegrationMethod::newmark);
  EXPECT_FALSE(m.simulation->projection);
  EXPECT_DOUBLE_EQ(m.simulation->outer_tolerance, 1e-6);
  EXPECT_DOUBLE_EQ(*m.output.every, 1e-3);
  const auto& tip = std::get<model::PositionSensor>(entry(m.output.sensors, "tip").kind);
  EXPECT_EQ(tip.of.text, "rod/end");
  const auto& way = std::get<model::DisplacementSensor>(entry(m.output.sensors, "way").kind);
  EXPECT_EQ(way.in->body, "crank");
  EXPECT_EQ(std::get<model::EnergySensor>(entry(m.output.sensors, "sum").kind).kind,
            model::EnergyKind::balance);
  EXPECT_EQ(std::get<model::SectionForceSensor>(entry(m.output.sensors, "cut").kind).element, 3);
}

TEST(ModelFile, JsonIsReadToo) {
  const ModelDescription m = read_model_text(
      "{\n\t\"buckens\": 1, \"title\": \"a\\u00e4\",\n\t\"bodies\": {\"b\": {\"rigid\": "
      "{\"mass\": \"3 kg\"}}}\n}\n",
      "a.json");
  EXPECT_EQ(m.title, "aä");
  EXPECT_DOUBLE_EQ(std::get<body::RigidSpec>(m.bodies[0].kind).mass, 3);
}

TEST(ModelFile, OverridesChangeTheTree) {
  const ModelDescription m =
      read_model_text(kSampleModel, "sample.yaml",
                      {"bodies.rod.beam.elements=8", "parameters.L=2 m", "gravity.1=0",
                       "bodies.frame.frames=1", "output.sensors.tip={velocity: rod/end}",
                       "bodies.frame.structure.nodes.b.0=1.5", "simulation.rho-inf=0.5"});
  const auto& beam = std::get<fem::BeamSpec>(entry(m.bodies, "rod").kind);
  EXPECT_EQ(beam.elements, 8);
  EXPECT_DOUBLE_EQ(beam.to.x(), 2.0);
  EXPECT_EQ(m.gravity.y(), 0.0);
  EXPECT_TRUE(std::holds_alternative<model::VelocitySensor>(entry(m.output.sensors, "tip").kind));
  EXPECT_THAT(m.source, testing::StartsWith("# sample.yaml was read with these changes:\n#   --set "
                                            "bodies.rod.beam.elements=8\n"));
  // What was run can be read again.
  const ModelDescription copy = read_model_text(m.source, "copy.yaml");
  EXPECT_EQ(std::get<fem::BeamSpec>(entry(copy.bodies, "rod").kind).elements, 8);
  EXPECT_EQ(copy.gravity, m.gravity);
  EXPECT_EQ(copy.source, m.source);
  EXPECT_EQ(sample().source, kSampleModel);
}

TEST(ModelFile, ParametersMayHaveAnyFreeName) {
  const ModelDescription m = read_model_text(
      "buckens: 1\nparameters: {n: 3, no: n + 1, m: 2 kg, N: 7}\n"
      "bodies: {a: {rigid: {mass: no}}, b: {rigid: {mass: n}}, c: {rigid: {mass: m*N g}}}\n",
      "p.yaml");
  EXPECT_EQ(std::get<body::RigidSpec>(m.bodies[0].kind).mass, 4);
  EXPECT_EQ(std::get<body::RigidSpec>(m.bodies[1].kind).mass, 3);
  EXPECT_EQ(std::get<body::RigidSpec>(m.bodies[2].kind).mass, 0.014);
}

class ModelFileOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 ("buckens_model_file_" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }

  std::filesystem::path directory_;
};

TEST_F(ModelFileOnDisk, TablesLieBesideTheModel) {
  write("law.csv", "time, a, b\r\n# comment\r\n0, 1, 2\r\n1, 3, 4\r\n");
  const auto path = write("m.yaml",
                          "buckens: 1\nbodies: {b: {rigid: {mass: 1}}}\nloads: {f: {force: {on: b, "
                          "value: [{file: law.csv, column: 3, unit: kN}, 0, 0]}}}\n");
  const ModelDescription m = read_model_file(path);
  EXPECT_DOUBLE_EQ(std::get<loads::ForceSpec>(m.loads[0].kind).value[0].value(0.5), 3000);
}

TEST_F(ModelFileOnDisk, WhatCannotBeReadIsAnIoError) {
  const auto message = [](const std::filesystem::path& path) {
    try {
      read_model_file(path);
    } catch (const IoError& error) {
      return std::string(error.what());
    }
    return std::string("no IoError");
  };
  EXPECT_THAT(message(directory_ / "none.yaml"), testing::HasSubstr("there is no such file"));
  EXPECT_THAT(message(directory_), testing::HasSubstr("it is a directory"));
  EXPECT_THAT(message(write("a", "") / "b"), testing::HasSubstr("cannot read the model file"));
  if (::geteuid() != 0) {
    const auto path = write("secret.yaml", "buckens: 1");
    std::filesystem::permissions(path, std::filesystem::perms::none);
    EXPECT_THAT(message(path), testing::HasSubstr("Permission denied"));
  }
}

}  // namespace
}  // namespace buckens::model_file

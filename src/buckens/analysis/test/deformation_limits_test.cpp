// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/deformation_limits.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/fem/assembly/assemble.h"

namespace buckens::analysis {
namespace {

/// Displaces every node of a straight beam along x by a function of its position.
template <class Law>
linalg::Vector displaced(const fem::FeModel& fe, Law law) {
  linalg::Vector d = linalg::Vector::Zero(fe.dofs.num_dofs);
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Eigen::Matrix<double, 6, 1> u = law(fe.nodes[node].position.x());
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = fe.dofs.node_dofs[node][k];
      if (dof >= 0) d[dof] = u[static_cast<Eigen::Index>(k)];
    }
  }
  return d;
}

using Vector6 = Eigen::Matrix<double, 6, 1>;

TEST(DeformationLimits, StretchedBeam) {
  test::BeamConstants beam;  // EA = 1e6, EI = 100, four elements of one member
  beam.L = 2;
  const model::Model model = test::spatial_beam_pendulum(beam);
  const DeformationLimits limits(model.bodies[0]);
  const auto d = displaced(model.bodies[0].flexible->fe, [](double x) {
    return (Vector6() << 1e-3 * x, 0, 0, 0, 0, 0).finished();
  });
  const DeformationMeasure found = limits.measure(d);
  EXPECT_NEAR(found.strain, 1e-3, 1e-12);  // of section forces, rounding of 1e6 × displacements
  EXPECT_NEAR(found.rotation, 0.0, 1e-15);
  const double buckling = M_PI * M_PI * 100.0 / 4.0;
  EXPECT_NEAR(found.tension, 1e6 * 1e-3 / buckling, 1e-9);
  EXPECT_EQ(found.compression, 0.0);
  EXPECT_EQ(found.axial_load(), found.tension);
  const DeformationMeasure pushed = limits.measure(-d);
  EXPECT_NEAR(pushed.compression, found.tension, 1e-9);
  EXPECT_EQ(pushed.tension, 0.0);
}

TEST(DeformationLimits, TurnedAndBentBeam) {
  const model::Model model = test::spatial_beam_pendulum(test::BeamConstants{});
  const DeformationLimits limits(model.bodies[0]);
  const auto d = displaced(model.bodies[0].flexible->fe, [](double x) {
    return (Vector6() << 0, 0.1 * x * x, 0, 0, 0, 0.2 * x).finished();
  });
  const DeformationMeasure found = limits.measure(d);
  EXPECT_NEAR(found.rotation, 0.2, 1e-15);  // at the end; slopes of elements are 0.175 at most
  // A curvature of 0.2 and an outer fibre at √(3 I/A) = √(3·100/1e6): the section is a rectangle.
  EXPECT_NEAR(found.strain, 0.2 * std::sqrt(3e-4), 1e-12);
  EXPECT_NEAR(found.axial_load(), 0.0, 1e-12);
}

TEST(DeformationLimits, StretchedAndTurnedShells) {
  fem::Structure plate;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 2.5, 1),
        Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 4, 0)}) {
    fem::add_node(plate, "", p);
  }
  const int section = plate.shells.add_section(
      fem::ShellSection::homogeneous(fem::Material::isotropic(1e9, 0.3, 1000), 0.01));
  plate.shells.add(std::vector<int>{0, 1, 2, 3}, section);
  plate.shells.add(std::vector<int>{1, 4, 2}, section);
  body::Body body;
  body.name = "plate";
  body.flexible = std::make_unique<body::FlexiblePart>("plate", fem::assemble(plate),
                                                       body::CouplingLevel::full);
  const DeformationLimits limits(body);
  // Strains 2e-3 along y and −1e-3 along z with a shear of 4e-3, and a slope of 5e-3 out of the
  // plane: the principal strains are 5e-4 ± √(1.5e-3² + 2e-3²).
  const fem::FeModel& fe = body.flexible->fe;
  linalg::Vector d = linalg::Vector::Zero(fe.dofs.num_dofs);
  for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
    const Eigen::Vector3d& x = fe.nodes[node].position;
    const Eigen::Vector3d u(5e-3 * x.z(), 2e-3 * x.y() + 4e-3 * x.z(), -1e-3 * x.z());
    const Eigen::Vector3d turn(-2e-3, 5e-3,
                               0.0);  // normals stay normal, corners turn as their mean
    for (std::size_t k = 0; k < 3; ++k) {
      d[fe.dofs.node_dofs[node][k]] = u[static_cast<int>(k)];
      d[fe.dofs.node_dofs[node][k + 3]] = turn[static_cast<int>(k)];
    }
  }
  const DeformationMeasure found = limits.measure(d);
  EXPECT_NEAR(found.strain, 3e-3, 1e-15);
  EXPECT_NEAR(found.rotation, std::hypot(2e-3, 5e-3), 1e-15);  // of the nodes
}

DeformationMeasure measured(double rotation, double strain, double tension, double compression) {
  DeformationMeasure out;
  out.rotation = rotation;
  out.strain = strain;
  out.tension = tension;
  out.compression = compression;
  return out;
}

TEST(DeformationLimits, SaysWhatToDo) {
  const DeformedBody rod{"rod", "rod[2]", 2, false};
  const auto fine = judge_deformation(rod, measured(0.05, 0.04, 0.04, 0.04));
  EXPECT_TRUE(fine.warnings.empty() && fine.trust.empty());
  const auto strained = judge_deformation(rod, measured(0.05, 0.06, 0, 0));
  ASSERT_EQ(strained.warnings.size(), 1U);
  EXPECT_THAT(strained.warnings[0], testing::HasSubstr("body \"rod\" is strained by up to 0.06"));
  EXPECT_TRUE(strained.trust.empty());
  const auto bad = judge_deformation(rod, measured(0.2, 0.11, 0.5, 0.2));
  EXPECT_TRUE(bad.warnings.empty());
  ASSERT_EQ(bad.trust.size(), 3U);
  EXPECT_THAT(bad.trust[0], testing::HasSubstr("body \"rod[2]\" bends by up to 0.2 rad"));
  EXPECT_THAT(bad.trust[1], testing::HasSubstr("strained by up to 0.11"));
  // 0.5/1.5 in tension is more than 0.2/0.8 in compression; 0.5/16 are less than 5 %.
  EXPECT_THAT(bad.trust[2], testing::HasSubstr("0.5 of its buckling load pi^2 EI/L^2 in tension"));
  EXPECT_THAT(bad.trust[2], testing::HasSubstr("by up to about 33 %; use `frames: 8`"));
}

TEST(DeformationLimits, CompressionBendsMoreThanTensionStiffens) {
  const DeformedBody rod{"rod", "rod", 1, false};
  const auto found = judge_deformation(rod, measured(0.01, 0, 0.2, 0.2));
  ASSERT_EQ(found.trust.size(), 1U);
  EXPECT_THAT(found.trust[0], testing::HasSubstr("in compression"));
  EXPECT_THAT(found.trust[0], testing::HasSubstr("25 %"));
  EXPECT_THAT(judge_deformation(rod, measured(0, 0, 0, 1.5)).trust.at(0),
              testing::HasSubstr("without bound"));
  // A load included in the equations, or a body that does not bend, causes no error.
  EXPECT_TRUE(
      judge_deformation({"rod", "rod", 1, true}, measured(0.01, 0, 0.2, 0.2)).trust.empty());
  EXPECT_TRUE(judge_deformation(rod, measured(0, 0, 5.0, 0)).trust.empty());
}

}  // namespace
}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/stiffness_assembly.h"

#include <gtest/gtest.h>

#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/test/shell_fixture.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

using linalg::SparseMatrix;
using linalg::Triplet;

SparseMatrix from_list(const FeModel& fe, const std::vector<Triplet>& entries) {
  SparseMatrix out(fe.dofs.num_dofs, fe.dofs.num_dofs);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

void expect_same(const SparseMatrix& found, const SparseMatrix& expected) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.nonZeros(), expected.nonZeros());
  ASSERT_TRUE(found.isCompressed());
  for (Eigen::Index k = 0; k <= found.cols(); ++k) {
    ASSERT_EQ(found.outerIndexPtr()[k], expected.outerIndexPtr()[k]) << k;
  }
  for (Eigen::Index k = 0; k < found.nonZeros(); ++k) {
    ASSERT_EQ(found.innerIndexPtr()[k], expected.innerIndexPtr()[k]) << k;
    ASSERT_EQ(found.valuePtr()[k], expected.valuePtr()[k]) << k;
  }
}

/// All elements in one list give the same bits, since they are summed in the same order.
void expect_stiffness_of_list(const Structure& structure) {
  const FeModel fe = assemble(structure);
  StiffnessSum all;
  for (const auto& block : fe.blocks) block->add_stiffness({fe.nodes, fe.dofs}, all);
  expect_same(fe.K, from_list(fe, all.K));
  expect_same(fe.K_damping, from_list(fe, all.K_damping));
}

Material damped_steel() {
  Material material = steel();
  material.damping_stiffness = 1e-4;
  return material;
}

TEST(StiffnessAssemblyTest, SolidsInPiecesGiveTheBitsOfOneList) {
  // 1331 elements are more than one piece; unless they are distorted, many entries are exact zeros.
  for (const double reach : {0.0, 0.002}) {
    Structure s;
    add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {11, 11, 11}}, damped_steel(),
            SolidForm::usual(SolidKind::hex8));
    distort(s, reach);
    expect_stiffness_of_list(s);
  }
}

TEST(StiffnessAssemblyTest, SoDoShellsWithTheirDirectors) {
  expect_stiffness_of_list(twisted_shells(damped_steel()));
}

TEST(StiffnessAssemblyTest, KindsOfElementsMayShareNodes) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {11, 10, 10}}, steel(),
          SolidForm::usual(SolidKind::hex8));
  const int tip = add_node(s, "tip", {0.9, 0.1, 0.3});
  const int foot = add_node(s, "foot", {0.5, 0.1, 0.3});
  add_beam(s, foot, tip, 3, beam_properties(BeamTheory::timoshenko, true));
  for (const int node : {0, 5, 40}) s.bars.add(node, foot, damped_steel(), Section::circle(0.01));
  s.masses.add(tip, 0.4);
  SpringBlock::Stiffness stiffness = SpringBlock::Stiffness::Zero();
  stiffness.diagonal().setConstant(1e5);
  s.springs.add(foot, tip, stiffness);
  expect_stiffness_of_list(s);
}

/// Stresses from one list of the rows of all elements, solids or shells.
void expect_stresses_of_list(const Structure& structure) {
  const FeModel fe = assemble(structure);
  std::vector<Triplet> entries;
  int rows_per_element = 6;
  for (const auto& block : fe.blocks) {
    if (block->is_shell() && block->num_elements() > 0) rows_per_element = 12;
    block->add_stress_rows({fe.nodes, fe.dofs}, 0, entries);
  }
  const SolidRecovery recovery(fe);
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows(rows_per_element * recovery.num_elements(),
                                                    fe.dofs.num_dofs);
  rows.setFromTriplets(entries.begin(), entries.end());
  const linalg::Vector d = linalg::Vector::LinSpaced(fe.dofs.num_dofs, -1.0, 2.0).array().sin();
  const linalg::Vector expected = rows * d;
  const linalg::Matrix found = recovery.stresses(d);
  for (int e = 0; e < recovery.num_elements(); ++e) {
    // The same numbers in the same order.
    EXPECT_EQ(found.col(e).head<6>(), expected.segment<6>(rows_per_element * e)) << e;
  }
}

TEST(StiffnessAssemblyTest, StressRowsInPiecesAreThoseOfOneList) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {11, 11, 11}}, steel(),
          SolidForm::usual(SolidKind::hex8));
  distort(s, 0.002);
  expect_stresses_of_list(s);
  const ShellSection section = ShellSection::homogeneous(steel(), 0.002);
  const ShellGrid grid(ShellKind::quad4, 36, 30, section, [](double x, double y) {
    return Eigen::Vector3d(0.6 * x, 0.4 * y, 0.1 * x * y);
  });
  expect_stresses_of_list(grid.structure);
}

}  // namespace
}  // namespace buckens::fem::test

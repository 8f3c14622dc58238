// SPDX-License-Identifier: Apache-2.0
// Section forces and stresses of some elements against those of all, bit for bit.
#include "buckens/fem/assembly/element_recovery.h"

#include <gtest/gtest.h>

#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/test/shell_fixture.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

using linalg::Matrix;
using linalg::Vector;

/// Every third number from the first one on.
std::vector<int> thirds(int first, int count) {
  std::vector<int> out;
  for (int k = first; k < count; k += 3) out.push_back(k);
  return out;
}

Matrix columns_of(const Matrix& all, const std::vector<int>& columns) {
  return all(Eigen::all, columns);
}

void expect_bits_of_all(const Structure& s, bool has_lines, bool has_solids) {
  const FeModel fe = assemble(s);
  const Recovery lines(fe);
  const SolidRecovery solids(fe);
  Vector d(fe.dofs.num_dofs);
  for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = std::sin(static_cast<double>(7 * k));
  const Matrix forces = lines.section_forces(d), stresses = lines.stresses(forces);
  const Matrix solid_stresses = solids.stresses(d);
  for (const int first : {0, 1, 2}) {
    const std::vector<int> of_lines = thirds(first, lines.num_elements());
    const std::vector<int> of_solids = thirds(first, solids.num_elements());
    EXPECT_EQ(of_lines.empty(), !has_lines) << first;
    EXPECT_EQ(of_solids.empty(), !has_solids) << first;
    const ElementRecovery some(fe, lines, of_lines, of_solids);
    const Vector own = d(some.variables());
    const Matrix found = some.section_forces(own);
    EXPECT_EQ(found, columns_of(forces, of_lines)) << first;
    EXPECT_EQ(some.stresses(found), columns_of(stresses, of_lines)) << first;
    EXPECT_EQ(some.solid_stresses(own), columns_of(solid_stresses, of_solids)) << first;
  }
}

TEST(ElementRecovery, OfBeamsAndBars) {
  expect_bits_of_all(
      frame_structure(beam_properties(BeamTheory::timoshenko, true), some_rotation()), true, false);
}

class RecoveryOfSomeSolids : public ::testing::TestWithParam<SolidForm> {};

TEST_P(RecoveryOfSomeSolids, HasTheBitsOfAll) {
  expect_bits_of_all(distorted_block(GetParam()), false, true);
}

INSTANTIATE_TEST_SUITE_P(AllForms, RecoveryOfSomeSolids, ::testing::ValuesIn(all_forms()),
                         [](const auto& form) { return form_name(form.param); });

ShellGrid curved_shells(ShellKind kind) {
  return {kind, 5, 4, ShellSection::homogeneous(steel(), 0.002, 0.0007), [](double x, double y) {
            return Eigen::Vector3d(0.6 * x, 0.4 * y, 0.1 * x * y + 0.02 * std::sin(9 * x));
          }};
}

class RecoveryOfSomeShells : public ::testing::TestWithParam<ShellKind> {};

TEST_P(RecoveryOfSomeShells, HasTheBitsOfAll) {
  expect_bits_of_all(curved_shells(GetParam()).structure, false, true);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, RecoveryOfSomeShells,
                         ::testing::Values(ShellKind::quad4, ShellKind::tri3, ShellKind::quad8,
                                           ShellKind::tri6),
                         [](const auto& kind) { return shell_name(kind.param); });

TEST(ElementRecovery, OfElementsOfAllKinds) {
  Structure s = curved_shells(ShellKind::quad4).structure;
  const int material = s.solids.add_material(steel());
  const int corner = static_cast<int>(s.nodes.size());
  for (const double height : {1.0, 1.1, 1.2, 1.4}) add_node(s, "", {0.1, 0.2, height});
  s.nodes.back().position.x() = 0.5;
  for (const int k : {0, 1, 2, 3, 4, 6, 7}) {
    s.solids.add(SolidForm::usual(SolidKind::tet4),
                 std::array<int, 4>{k, k + 1, k + 7, corner + k % 4}, material);
  }
  for (int k = 0; k < 5; ++k) s.bars.add(k, corner + k % 4, steel(), Section::circle(0.01));
  add_beam(s, corner, corner + 1, 2, beam_properties(BeamTheory::euler_bernoulli, false));
  expect_bits_of_all(s, true, true);
}

TEST(ElementRecovery, TheFactorOfVonMisesStressesGivesThem) {
  const Eigen::Matrix<double, 6, 1> stress(3e6, -2e6, 7e6, 1e6, 4e6, -5e6);
  // A dozen roundings.
  EXPECT_NEAR((mises_factor() * stress).norm(), mises_stress(stress), 1e-14 * mises_stress(stress));
}

TEST(ElementRecovery, ReadsTheVariablesOfItsElementsOnly) {
  const FeModel fe = assemble(distorted_block(SolidForm::usual(SolidKind::hex8)));
  const Recovery lines(fe);
  const ElementRecovery one(fe, lines, {}, {5});
  const auto is_solid = [](const auto& block) { return block->is_solid(); };
  const auto solids = *std::find_if(fe.blocks.begin(), fe.blocks.end(), is_solid);
  std::vector<int> expected;
  for (const int node : solids->nodes(5)) {
    for (int k = 0; k < 3; ++k)
      expected.push_back(fe.dofs.node_dofs[std::size_t(node)][std::size_t(k)]);
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(one.variables(), expected);
}

}  // namespace
}  // namespace buckens::fem::test

// SPDX-License-Identifier: Apache-2.0
// In one process; over several: tests/test_mpi.py.
#include "buckens/fem/assembly/made_columns.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/fem/assembly/stress_rows.h"
#include "buckens/fem/assembly/structure_parts.h"
#include "buckens/fem/constraint/elimination.h"
#include "buckens/fem/test/shell_fixture.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

using linalg::SparseMatrix;

/// That columns have the entries of A from the diagonal on, with their bits.
void expect_columns(const SparseMatrix& found, const SparseMatrix& A, int first) {
  ASSERT_EQ(found.rows(), A.rows());
  for (int k = 0; k < found.cols(); ++k) {
    SparseMatrix::InnerIterator it(found, k);
    for (SparseMatrix::InnerIterator whole(A, first + k); whole; ++whole) {
      if (whole.row() < first + k) continue;
      ASSERT_TRUE(it) << k;
      ASSERT_EQ(it.row(), whole.row()) << k;
      ASSERT_EQ(it.value(), whole.value()) << k;
      ++it;
    }
    ASSERT_FALSE(it) << k;
  }
}

/// Three parts in which neighbours are far apart.
std::vector<int> scattered_parts(int count) {
  std::vector<int> part;
  for (int k = 0; k < count; ++k) part.push_back(k * k % 7 % 3);
  return part;
}

linalg::RowOrder scattered(int variables) { return {scattered_parts(variables), 3}; }

/// That columns of a process are those of A in this order of rows, with the bits of its lower
/// triangle.
void expect_columns_in_order(const SparseMatrix& found, const SparseMatrix& A,
                             const linalg::RowOrder& order, std::size_t process) {
  const SparseMatrix kept = A.triangularView<Eigen::Lower>();
  const SparseMatrix symmetric = kept.selfadjointView<Eigen::Lower>();
  const SparseMatrix lower =
      linalg::renumbered(symmetric, order.rows()).triangularView<Eigen::Lower>();
  const int first = order.first_rows()[process];
  const SparseMatrix expected = lower.middleCols(first, order.first_rows()[process + 1] - first);
  ASSERT_EQ(found.cols(), expected.cols());
  ASSERT_EQ(found.nonZeros(), expected.nonZeros());
  for (int k = 0; k < found.cols(); ++k) {
    SparseMatrix::InnerIterator it(found, k);
    for (SparseMatrix::InnerIterator whole(expected, k); whole; ++whole, ++it) {
      ASSERT_EQ(it.row(), whole.row()) << k;
      ASSERT_EQ(it.value(), whole.value()) << k;
    }
  }
}

void expect_same_matrices(const Structure& s, std::optional<spatial::Plane> planar = std::nullopt) {
  const FeModel fe = assemble(s, planar);
  const MeshView mesh{fe.nodes, fe.dofs};
  const int n = fe.dofs.num_dofs;
  const std::array<const SparseMatrix*, 3> matrices = {&fe.M.whole(), &fe.K.whole(),
                                                       &fe.K_damping.whole()};
  // Runs that begin and end within a node; one of them is empty.
  const std::array<int, 5> runs = {0, n / 3 + 1, n / 3 + 1, n - 4, n};
  for (const MeshMatrix which : {MeshMatrix::mass, MeshMatrix::stiffness, MeshMatrix::damping}) {
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
      const std::vector<std::byte> description =
          description_of_columns(which, fe.blocks, mesh, runs[k], runs[k + 1]);
      const SparseMatrix found = made_columns(description, runs[k], runs[k + 1]);
      ASSERT_EQ(found.cols(), runs[k + 1] - runs[k]);
      expect_columns(found, *matrices[static_cast<std::size_t>(which)], runs[k]);
    }
    const linalg::RowOrder order = scattered(n);
    for (std::size_t k = 0; k + 1 < order.first_rows().size(); ++k) {
      const int first = order.first_rows()[k];
      const int end = order.first_rows()[k + 1];
      const auto description = description_of_columns(which, fe.blocks, mesh, first, end, &order);
      expect_columns_in_order(made_columns(description, first, end),
                              *matrices[static_cast<std::size_t>(which)], order, k);
    }
  }
}

/// That a process makes some rows of stresses with the bits of one process.
/// @param order of the rows, or null @param expected all stresses of d
void expect_stress_rows(const FeModel& fe, const linalg::SharedRowOrder& order, int first, int end,
                        const linalg::Vector& d, const linalg::Vector& expected) {
  const std::vector<std::byte> description =
      description_of_stress_rows(fe.blocks, {fe.nodes, fe.dofs}, order, first, end);
  const SparseMatrix made = made_columns(description, first, end);
  ASSERT_EQ(made.rows(), d.size());
  ASSERT_EQ(made.cols(), end - first);
  const linalg::SparseRows::RowMajor own = made.transpose();
  const linalg::Vector found = own * d;
  for (int k = 0; k < end - first; ++k) {
    ASSERT_EQ(found[k], expected[order ? order->variable(first + k) : first + k]) << k;
  }
}

/// What other processes make of stresses has the bits of what one has.
void expect_same_stresses(const Structure& s) {
  const FeModel fe = assemble(s);
  const linalg::SparseRows rows = stress_rows(fe.blocks, {fe.nodes, fe.dofs}, {});
  const auto n = static_cast<int>(rows.rows());
  linalg::Vector d(fe.dofs.num_dofs);
  for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = std::sin(static_cast<double>(7 * k));
  const linalg::Vector expected = rows * d;
  // Runs that begin and end within an element; one of them is empty.
  const std::array<int, 5> runs = {0, n / 3 + 1, n / 3 + 1, n - 4, n};
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    expect_stress_rows(fe, nullptr, runs[k], runs[k + 1], d, expected);
  }
  // By place, that is by parts of the nodes, of which one has none.
  const NodeParts parts{4, scattered_parts(static_cast<int>(fe.nodes.size())), 0};
  const linalg::SharedRowOrder order = stress_row_order(fe.blocks, parts);
  for (std::size_t k = 0; k < 4; ++k) {
    expect_stress_rows(fe, order, order->first_rows()[k], order->first_rows()[k + 1], d, expected);
  }
}

Material crossed() {
  Material material = steel();
  material.damping_stiffness = 1e-4;
  Orthotropy& of = material.orthotropy.emplace();
  of.E = {140e9, 10e9, 9e9};
  of.nu12 = 0.3;
  of.nu13 = 0.25;
  of.nu23 = 0.4;
  of.G12 = 5e9;
  of.G13 = 4e9;
  of.G23 = 3e9;
  of.axes = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return material;
}

class MadeColumnsTest : public ::testing::TestWithParam<SolidForm> {};

TEST_P(MadeColumnsTest, HaveTheBitsOfAnAssemblyInOneProcess) {
  expect_same_matrices(distorted_block(GetParam(), crossed()));
  expect_same_stresses(distorted_block(GetParam(), crossed()));
}

INSTANTIATE_TEST_SUITE_P(AllForms, MadeColumnsTest, ::testing::ValuesIn(all_forms()),
                         [](const auto& form) { return form_name(form.param); });

/// Two layers of different materials, off the nodes.
ShellSection layered() {
  ShellSection section = ShellSection::homogeneous(crossed(), 0.002, 0.0007);
  section.layers.push_back({crossed(), 0.001, 0.4});
  section.layers.back().material.rho = 2700;
  section.direction = Eigen::Vector3d(1, 0.2, 0.1);
  return section;
}

ShellGrid shells_with_waves(ShellKind kind) {
  // Directors of neighbours are means of normals that differ.
  return {kind, 9, 7, layered(), [](double x, double y) {
            return Eigen::Vector3d(0.6 * x, 0.4 * y, 0.1 * x * y + 0.02 * std::sin(9 * x));
          }};
}

class MadeColumnsOfShellsTest : public ::testing::TestWithParam<ShellKind> {};

TEST_P(MadeColumnsOfShellsTest, HaveTheBitsOfAnAssemblyInOneProcess) {
  expect_same_matrices(shells_with_waves(GetParam()).structure);
  expect_same_stresses(shells_with_waves(GetParam()).structure);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, MadeColumnsOfShellsTest,
                         ::testing::Values(ShellKind::quad4, ShellKind::tri3, ShellKind::quad8,
                                           ShellKind::tri6),
                         [](const auto& kind) { return shell_name(kind.param); });

TEST(MadeColumnsOfBodyTest, KeepDirectorsOfADividedMesh) {
  // Those at the cut are means with normals of the other part.
  const Structure whole = shells_with_waves(ShellKind::quad4).structure;
  for (const Structure& part : divide(whole, choose_parts(whole, 2)).parts) {
    expect_same_matrices(part);
  }
}

/// A skew chain of beams, uniform, then tapered.
Structure chain_of_beams(BeamTheory theory, bool rotary) {
  Structure s;
  BeamProperties uniform = beam_properties(theory, rotary);
  uniform.material.damping_stiffness = 2e-5;
  BeamProperties tapered = beam_properties(theory, rotary);
  tapered.up = Eigen::Vector3d(0.2, -0.3, 1.0);
  tapered.taper = [](double x) { return Section::rectangle(0.03 - 0.01 * x, 0.05 + 0.02 * x); };
  const int a = add_node(s, "a", {0.1, 0.2, -0.1});
  const int b = add_node(s, "b", {0.7, 0.5, 0.3});
  const int c = add_node(s, "c", {0.9, -0.2, 0.5});
  add_beam(s, a, b, 5, uniform);
  add_beam(s, b, c, 5, tapered);
  s.beams.add(a, c, 0, {0, 1, Eigen::Vector3d(0, 1, 0.3)});
  return s;
}

TEST(MadeColumnsOfBodyTest, OfBeams) {
  for (const BeamTheory theory : {BeamTheory::euler_bernoulli, BeamTheory::timoshenko}) {
    for (const bool rotary : {false, true}) expect_same_matrices(chain_of_beams(theory, rotary));
  }
}

TEST(MadeColumnsOfBodyTest, OfBeamsInAPlane) {
  Structure s;
  const int a = add_node(s, "a", {0.1, 0.2, 0});
  const int b = add_node(s, "b", {0.7, 0.5, 0});
  add_beam(s, a, b, 9, beam_properties(BeamTheory::timoshenko, true));
  expect_same_matrices(s, spatial::Plane::xy);
}

TEST(MadeColumnsOfBodyTest, OfBarsMassesAndSpringsAmongSolidsAndShells) {
  Structure s = frame_structure(beam_properties(BeamTheory::timoshenko, true), some_rotation());
  const int foot = add_node(s, "foot", {0.5, 0.1, 0.3});
  SpringBlock::Stiffness stiffness = SpringBlock::Stiffness::Zero();
  stiffness.diagonal() << 1e5, 2e5, 3e5, 10, 20, 30;
  stiffness(0, 4) = stiffness(4, 0) = 40;
  s.springs.add(foot, 0, stiffness);
  const int shell = s.shells.add_section(layered());
  s.shells.add(std::array<int, 3>{foot, 0, 1}, shell);
  const int top = add_node(s, "top", {0.4, 0.2, 1.3});
  const int material = s.solids.add_material(crossed());
  s.solids.add(SolidForm::usual(SolidKind::tet4), std::array<int, 4>{foot, 1, 0, top}, material);
  s.masses.add(top, 0.3);
  expect_same_matrices(s);
  expect_same_stresses(s);
}

/// T of a mesh with nodes that follow one more node as a rigid body.
SparseMatrix with_rigid_nodes(const FeModel& fe, const std::vector<int>& nodes) {
  std::vector<Node> all = fe.nodes;
  DofMap dofs = fe.dofs;
  NodeLinks links;
  links.rigid.push_back({"rigid nodes", static_cast<int>(all.size()), nodes});
  all.push_back({"", {0.1, 0.2, 0.1}});
  for (int& dof : dofs.node_dofs.emplace_back()) dof = dofs.num_dofs++;
  SparseMatrix T = eliminate(all, dofs, links).T.topRows(fe.dofs.num_dofs);
  T.makeCompressed();
  return T;
}

void expect_same_matrices_of_those_that_follow(const FeModel& fe, const SparseMatrix& T) {
  const MeshView mesh{fe.nodes, fe.dofs};
  const Following rows = T;
  const auto n = static_cast<int>(T.cols());
  const std::array<int, 5> runs = {0, n / 3 + 1, n / 2, n - 4, n};
  const std::array<const SparseMatrix*, 3> matrices = {&fe.M.whole(), &fe.K.whole(),
                                                       &fe.K_damping.whole()};
  for (const MeshMatrix which : {MeshMatrix::mass, MeshMatrix::stiffness, MeshMatrix::damping}) {
    const SparseMatrix expected = condensed(*matrices[static_cast<std::size_t>(which)], T);
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
      const auto description =
          description_of_columns(which, fe.blocks, mesh, runs[k], runs[k + 1], nullptr, &rows);
      expect_columns(made_columns(description, runs[k], runs[k + 1]), expected, runs[k]);
    }
    const linalg::RowOrder order = scattered(n);
    for (std::size_t k = 0; k + 1 < order.first_rows().size(); ++k) {
      const int first = order.first_rows()[k];
      const int end = order.first_rows()[k + 1];
      const auto description =
          description_of_columns(which, fe.blocks, mesh, first, end, &order, &rows);
      expect_columns_in_order(made_columns(description, first, end), expected, order, k);
    }
  }
}

Structure distorted_box() {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {12, 10, 10}}, crossed(),
          SolidForm::usual(SolidKind::hex8));
  distort(s, 0.002);
  s.masses.add(5, 0.3);
  return s;
}

TEST(MadeColumnsOfBodyTest, OfVariablesThatFollowOthers) {
  const FeModel fe = assemble(distorted_box());
  // Nodes of distant elements, and one between two that stay.
  expect_same_matrices_of_those_that_follow(fe, with_rigid_nodes(fe, {0, 1, 2, 40, 700, 1000}));
}

TEST(MadeColumnsOfBodyTest, OfVariablesThatFollowMeansAndEquations) {
  Structure s = distorted_box();
  const int hub = add_node(s, "hub", {0.5, 0.1, 0.1});
  const int twin = add_node(s, "twin", s.nodes[30].position);
  const int arm = add_node(s, "arm", {0.1, 0.1, 0.7});
  s.masses.add(hub, 0.7, Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal());
  s.masses.add(twin, 0.2);
  s.masses.add(arm, 0.1, Eigen::Vector3d(0.3, 0.2, 0.1).asDiagonal());
  s.links.averages.push_back({"mean", hub, {0, 12, 400, 1200, 1500}, {1, 2, 1, 3, 1}, {}, {}});
  s.links.averages.back().variables.fill(true);
  s.links.rigid.push_back({"arm", hub, {arm}});
  for (int k = 0; k < 3; ++k) s.links.equations.push_back({"tie", {{twin, k, 1}, {30, k, -1}}});
  const FeModel fe = assemble(s);
  expect_same_matrices_of_those_that_follow(fe, eliminate(fe.nodes, fe.dofs, s.links).T);
}

TEST(MadeColumnsOfBodyTest, KeepEachElementsMaterial) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {6, 3, 3}}, steel(), SolidForm::usual(SolidKind::hex8));
  SolidBlock mixed;
  Material weightless = steel();
  weightless.rho = 0;
  Material damped = crossed();
  const std::array<int, 3> materials = {mixed.add_material(damped), mixed.add_material(steel()),
                                        mixed.add_material(weightless)};
  for (int e = 0; e < s.solids.num_elements(); ++e) {
    mixed.add(s.solids.form(e), s.solids.nodes(e), materials[static_cast<std::size_t>(e % 3)]);
  }
  s.solids = mixed;
  expect_same_matrices(s);
}

TEST(MadeColumnsOfBodyTest, OfMoreElementsThanOnePiece) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {12, 12, 12}}, crossed(),
          SolidForm::usual(SolidKind::hex8));
  expect_same_matrices(s);
  expect_same_stresses(s);
}

TEST(MadeColumnsOfBodyTest, NeedAFewElementsMoreThanTheirShare) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.4, 0.4}, {16, 16, 16}}, steel(),
          SolidForm::usual(SolidKind::hex8));
  const FeModel fe = assemble(s);
  const MeshView mesh{fe.nodes, fe.dofs};
  const int n = fe.dofs.num_dofs;
  const auto bytes = [&](int first, int end) {
    return static_cast<double>(
        description_of_columns(MeshMatrix::stiffness, fe.blocks, mesh, first, end).size());
  };
  // A layer of nodes more on each side, of seventeen.
  EXPECT_LT(bytes(n / 4, n / 2), (0.25 + 2.5 / 17) * bytes(0, n));
}

}  // namespace
}  // namespace buckens::fem::test

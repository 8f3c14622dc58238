// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/nodal_motion.h"

#include <array>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/rigid_modes.h"
#include "buckens/body/rigid_regions.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/inverse_iteration.h"

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::Vector;

fem::Structure structure(fem::SolidKind kind, double rho = 7850) {
  fem::Structure s;
  fem::Box box;
  box.from = {0.1, -0.2, 0.05};
  box.size = {0.5, 0.2, 0.1};
  box.divisions = {4, 3, 2};
  fem::add_box(s, box, fem::Material::isotropic(2.1e11, 0.3, rho), fem::SolidForm::usual(kind));
  return s;
}

fem::FeModel mesh(fem::SolidKind kind, double rho = 7850) {
  return fem::assemble(structure(kind, rho));
}

std::unique_ptr<FlexiblePart> block(fem::SolidKind kind, double rho = 7850) {
  return std::make_unique<FlexiblePart>("block", mesh(kind, rho), CouplingLevel::full);
}

/// Sieve and integrals with all their columns.
struct Columns {
  explicit Columns(fem::SolidKind kind)
      : fe(mesh(kind)), sieve(motions(fe), fe.M), invariants(fe.shape) {}
  static Matrix motions(const fem::FeModel& fe) {
    std::vector<Eigen::Vector3d> positions;
    for (const fem::Node& node : fe.nodes) positions.push_back(node.position);
    return rigid_modes(positions, fe.dofs, fe.shape.com);
  }

  fem::FeModel fe;
  Sieve sieve;
  InertiaInvariants invariants;
};

constexpr std::array<fem::SolidKind, 2> kKinds = {fem::SolidKind::hex8, fem::SolidKind::tet10};
// Sums of some hundred numbers in another order.
constexpr double kRounding = 1e-13;

void expect_close(const Matrix& found, const Matrix& expected) {
  EXPECT_LE((found - expected).norm(), kRounding * expected.norm());
}

TEST(NodalMotion, EqualsTheColumnsOfSieveAndIntegrals) {
  for (const fem::SolidKind kind : kKinds) {
    const Columns columns(kind);
    const auto part = block(kind);
    ASSERT_NE(part->nodal_motion, nullptr);
    EXPECT_EQ(part->sieve.stored_Phi().size() + part->sieve.stored_P().size() +
                  part->invariants.stored_patterns().size() + part->fe.shape.c.size(),
              0);
    EXPECT_EQ(part->sieve.rank(), 6);
    expect_close(part->sieve.Phi(), columns.sieve.Phi());
    expect_close(part->sieve.P(), columns.sieve.P());
    expect_close(part->invariants.centrifugal_patterns(),
                 columns.invariants.centrifugal_patterns());
    expect_close(part->invariants.first_moments(), columns.fe.shape.c);
  }
}

TEST(NodalMotion, SievesAndCouplesAsColumnsDo) {
  for (const fem::SolidKind kind : kKinds) {
    const Columns columns(kind);
    const auto part = block(kind);
    const Matrix X = linalg::scattered_block(part->num_dofs(), 3, 3);
    const auto both = [&](auto&& action) {
      expect_close(action(part->sieve), action(columns.sieve));
    };
    both([&](const Sieve& sieve) {
      Vector x = X.col(0);
      sieve.apply(x);
      return x;
    });
    both([&](const Sieve& sieve) {
      Matrix x = X;
      sieve.apply(x);
      return x;
    });
    both([&](const Sieve& sieve) {
      Vector f = X.col(1);
      sieve.apply_transposed(f);
      return f;
    });
    both([&](const Sieve& sieve) {
      Matrix f = X;
      sieve.apply_transposed(f);
      return f;
    });
    both([&](const Sieve& sieve) { return sieve.rigid_part(X.col(2)); });
    const auto weights = InertiaInvariants::centrifugal_weights({3.0, -2.0, 5.0});
    expect_close(part->invariants.pattern_values(X.col(0)),
                 columns.invariants.pattern_values(X.col(0)));
    Vector load = X.col(1), expected = load;
    part->invariants.add_centrifugal_load(weights, load);
    columns.invariants.add_centrifugal_load(weights, expected);
    expect_close(load, expected);
    expect_close(part->invariants.rotary_inertia(1e-3 * X.col(0)),
                 columns.invariants.rotary_inertia(1e-3 * X.col(0)));
  }
}

TEST(NodalMotion, EntriesOfMThatWereFormedBeforeChangeNoBitOfTheSieve) {
  const fem::FeModel fe = mesh(fem::SolidKind::hex8);
  const Sieve before(Columns::motions(fe), fe.M);
  fe.M.whole();
  const Sieve after(Columns::motions(fe), fe.M);
  EXPECT_EQ(before.Phi(), after.Phi());
  EXPECT_EQ(before.P(), after.P());
}

TEST(NodalMotion, WorksInPieces) {
  for (const fem::SolidKind kind : kKinds) {
    const Columns columns(kind);
    const auto motion = block(kind)->nodal_motion;
    const Eigen::Index n = columns.fe.M.rows();
    const Vector x = linalg::scattered_block(n, 1, 3);
    linalg::NodeSums sums;
    motion->add_moments(0, 9, x, sums);
    motion->add_moments(9, n - 9, x, sums);
    const Matrix P = columns.sieve.P();
    EXPECT_LE((motion->rigid(sums) - P.transpose() * x).norm(), kRounding * P.norm() * x.norm());
    const Matrix c = columns.invariants.centrifugal_patterns();
    EXPECT_LE((NodalMotion::patterns(sums) - c.transpose() * x).norm(),
              kRounding * c.norm() * x.norm());
    const NodalMotion::Vector6 amplitudes = NodalMotion::Vector6::LinSpaced(-1.0, 2.0);
    Vector y = x, Mx(n);
    motion->subtract(0, 30, motion->motion(amplitudes), y);
    motion->subtract(30, n - 30, motion->motion(amplitudes), y);
    expect_close(y, x - columns.sieve.Phi() * amplitudes);
    motion->multiply_mass(0, n, x, Mx);
    expect_close(Mx, columns.fe.M * x);
  }
}

TEST(NodalMotion, TellsBodiesApart) {
  const auto steel = block(fem::SolidKind::hex8)->nodal_motion;
  const auto same = block(fem::SolidKind::hex8)->nodal_motion;
  const auto lighter = block(fem::SolidKind::hex8, 2700)->nodal_motion;
  EXPECT_TRUE(*steel == *same);
  EXPECT_FALSE(*steel == *lighter);
}

TEST(NodalMotion, IsNotForSolidsWithRigidFaces) {
  const fem::Structure s = structure(fem::SolidKind::hex8);
  const auto face = fem::face_region(s, *fem::find_face_set(s, "x0"));
  const auto part = block(fem::SolidKind::hex8);
  const auto held = with_links("block", *part, {{"x0", face.nodes, face.centre}}).part;
  EXPECT_EQ(held->nodal_motion, nullptr);
  EXPECT_EQ(held->sieve.stored_Phi().cols(), 6);
  EXPECT_EQ(held->fe.shape.c.rows(), held->num_dofs());
  EXPECT_EQ(held->full_mesh->shape.c.size(), 0);
}

TEST(NodalMotion, IsForSolidsOnly) {
  fem::Structure s;
  fem::add_node(s, "start", {0, 0, 0});
  fem::add_node(s, "end", {1, 0, 0});
  fem::add_beam(s, 0, 1, 4,
                fem::BeamProperties::of(fem::Material::isotropic(2.1e11, 0.3, 7850.0),
                                        fem::Section::rectangle(0.02, 0.01),
                                        fem::BeamTheory::euler_bernoulli));
  const FlexiblePart part("rod", fem::assemble(s), CouplingLevel::full);
  EXPECT_EQ(part.nodal_motion, nullptr);
  EXPECT_EQ(part.sieve.stored_Phi().cols(), part.sieve.rank());
}

}  // namespace
}  // namespace buckens::body

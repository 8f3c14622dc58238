// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/structure_from_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"

namespace buckens::model {
namespace {

using Eigen::Vector3d;
using test::Described;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

fem::PointMassSpec point_mass(const std::string& at, double mass) {
  fem::PointMassSpec out;
  out.where = test::at_line(41);
  out.at = at;
  out.mass = mass;
  return out;
}

TEST(StructureFromSpec, NamesThePlacesOfABeam) {
  Described m;
  const NamedStructure even = structure_from_spec(m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4));
  EXPECT_THAT(even.names, ElementsAre("start", "end", "mid"));
  EXPECT_EQ(even.find("start")->node, 0);
  EXPECT_EQ(even.find("end")->node, 1);
  EXPECT_GE(even.find("mid")->node, 2);
  EXPECT_FALSE(even.find("middle"));
  const NamedStructure odd = structure_from_spec(m.beam("rod", {0, 0, 0}, {1, 0, 0}, 5));
  EXPECT_EQ(odd.find("mid")->node, -1);
  EXPECT_EQ(odd.find("mid")->element, 2);
  EXPECT_EQ(odd.find("mid")->xi, 0.5);
}

TEST(StructureFromSpec, MassesNeedANode) {
  Described m;
  body::BodySpec& spec = m.beam("rod", {0, 0, 0}, {1, 0, 0}, 3);
  auto& beam = std::get<fem::BeamSpec>(spec.kind);
  beam.masses = {point_mass("mid", 1)};
  EXPECT_THAT([&] { structure_from_spec(spec); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.yaml:41:1"), HasSubstr("\"mid\""),
                                              HasSubstr("even number"))));
  beam.masses = {point_mass("tip", 1)};
  EXPECT_THAT([&] { structure_from_spec(spec); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("\"tip\""), HasSubstr("start, end, mid"))));
}

TEST(StructureFromSpec, PointMassesShiftTheMassCentre) {
  Described m;
  body::BodySpec& spec = m.beam("rod", {0, 0, 0}, {2, 0, 0}, 2);
  const double beam_mass = test::kRho * test::kArea * 2;
  std::get<fem::BeamSpec>(spec.kind).masses = {point_mass("end", beam_mass)};
  const auto built = m.build();
  // Rounding of a sum of a few products.
  EXPECT_NEAR(built->model.bodies[0].mass, 2 * beam_mass, 1e-13 * beam_mass);
  EXPECT_NEAR((built->model.bodies[0].com - Vector3d(1.5, 0, 0)).norm(), 0, 1e-14);
}

TEST(StructureFromSpec, UnknownNodesOfMembersAreRefused) {
  Described m;
  const body::BodySpec& spec =
      m.truss("truss", {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}}, {{"a", "B2"}});
  EXPECT_THAT([&] { structure_from_spec(spec); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.yaml:30:1"), HasSubstr("\"B2\""),
                                              HasSubstr("nodes there: a, b"))));
}

TEST(StructureFromSpec, FramesJoinBeamsAtNodes) {
  Described m;
  fem::StructureSpec kind;
  kind.nodes = {{"a", {}, {0, 0, 0}}, {"b", {}, {1, 0, 0}}, {"c", {}, {1, 1, 0}}};
  for (const auto& between : {std::array<std::string, 2>{"a", "b"}, {"b", "c"}}) {
    fem::BeamMemberSpec member;
    Described::make_steel(member);
    member.between = between;
    member.elements = 3;
    kind.beams.push_back(member);
  }
  m.body("frame").kind = kind;
  const auto built = m.build();
  const body::Body& body = built->model.bodies[0];
  EXPECT_EQ(body.flexible->fe.nodes.size(), 3U + 2U * 2U);
  EXPECT_EQ(body.num_dofs(), 7 * 6);
  // Both legs have the same mass: the centre is the mean of (1/2, 0) and (1, 1/2).
  EXPECT_NEAR((body.com - Vector3d(0.75, 0.25, 0)).norm(), 0, 1e-14);
}

TEST(StructureFromSpec, DampingOfTheBodyReplacesThatOfTheMaterial) {
  Described m;
  body::BodySpec& spec = m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2);
  fem::DampingSpec damping;
  damping.mass = 3;
  damping.stiffness = 1e-4;
  std::get<fem::BeamSpec>(spec.kind).material.value.damping = damping;
  const auto expect_damping = [&](double alpha, double beta) {
    const auto built = m.build();
    const body::FlexiblePart& part = *built->model.bodies[0].flexible;
    const linalg::SparseMatrix expected = alpha * part.fe.M.whole() + beta * part.fe.K.whole();
    // Products are summed in another order.
    EXPECT_LT((part.C.whole() - expected).norm(), 1e-14 * expected.norm());
  };
  expect_damping(3, 1e-4);
  damping.mass = 1;
  damping.stiffness = 2e-3;
  spec.damping = damping;
  expect_damping(1, 2e-3);
}

}  // namespace
}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
// Generated meshes: nodes, names, named faces, volumes and inertia against closed forms.
#include "buckens/fem/mesh/cell_mesh.h"

#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/cylinder_mesh.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(BoxMesh, NamesItsNodes) {
  const Box box{{0, 0, 0}, {1, 1, 1}, {4, 2, 1}};
  Structure s;
  add_box(s, box, test::steel());
  EXPECT_EQ(s.nodes.size(), 30u);
  EXPECT_EQ(s.solids.num_elements(), 8);
  const auto places = named_places(box);
  const auto node = [&](const std::string& name) {
    for (const auto& place : places) {
      if (place.name == name) return box.node(place.place);
    }
    return -1;
  };
  EXPECT_EQ(node("node_first"), 0);
  EXPECT_EQ(node("node_last"), 29);
  EXPECT_EQ(node("corner_100"), 4);
  EXPECT_EQ(node("corner_010"), 10);
  EXPECT_EQ(node("corner_001"), 15);
  EXPECT_EQ(node("face_z0"), 7);  // (2, 1, 0)
  EXPECT_EQ(node("face_x0"), -1) << "one element across z: no node at the centre of that face";
  EXPECT_THROW(add_box(s, {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}, test::steel()), ModelError);
  // The same by the general route, in a structure that has nodes already.
  const GeneratedMesh mesh = add_box(s, box, test::steel(), SolidForm::usual(SolidKind::hex8));
  EXPECT_EQ(mesh.first_node, 30);
  EXPECT_EQ(mesh.names.size(), places.size());
  for (const auto& [name, number] : mesh.names) EXPECT_EQ(number, 30 + node(name)) << name;
}

class Generated : public testing::TestWithParam<SolidForm> {};

struct FaceSums {
  double area = 0, shares = 0;
  Vector3d normal = Vector3d::Zero();
};

FaceSums sums_of(const Structure& s, const std::string& name) {
  FaceSums out;
  for (const ElementFace& face : find_face_set(s, name)->faces) {
    const FaceIntegrals own = face_integrals(s.solids, s.nodes, face);
    EXPECT_EQ(own.nodes, face_nodes(s.solids, face));
    EXPECT_GT(own.positive_area.minCoeff(), 0.0);
    EXPECT_LE((own.products.rowwise().sum() - own.area).norm(), 1e-14 * own.area.norm());
    out.area += own.area.sum();
    out.shares += own.positive_area.sum();
    out.normal += own.normal.rowwise().sum();
  }
  return out;
}

/// Volume by the divergence theorem from the named faces, which close the surface.
double volume_within(const Structure& s) {
  double volume = 0;
  for (const FaceSet& set : s.face_sets) {
    for (const ElementFace& face : set.faces) {
      const FaceIntegrals own = face_integrals(s.solids, s.nodes, face);
      for (std::size_t k = 0; k < own.nodes.size(); ++k) {
        volume += s.nodes[static_cast<std::size_t>(own.nodes[k])].position.dot(
                      own.normal.col(static_cast<Eigen::Index>(k))) /
                  3.0;
      }
    }
  }
  return volume;
}

TEST_P(Generated, BoxesAreExact) {
  Structure s;
  const Vector3d size(0.6, 0.4, 0.3);
  add_box(s, {{0.1, 0.2, 0.3}, size, {3, 2, 2}}, test::steel(), GetParam());
  const FeModel fe = assemble(s);
  const double mass = test::steel().rho * size.prod();
  EXPECT_NEAR(fe.shape.mass, mass, 1e-13 * mass);
  EXPECT_LE((fe.shape.com - Vector3d(0.4, 0.4, 0.45)).norm(), 1e-14);
  const Vector3d squares = size.cwiseAbs2();
  const Matrix3d J =
      (mass / 12.0 * (Vector3d::Constant(squares.sum()) - squares)).asDiagonal().toDenseMatrix();
  EXPECT_LE((fe.shape.J0 - J).norm(), 1e-13 * J.norm());
  EXPECT_TRUE(solids_join_by_faces(fe));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const int end : {0, 1}) {
      const std::string name{"xyz"[axis], "01"[end]};
      const FaceSums sums = sums_of(s, name);
      const double area = size.prod() / size[axis];
      EXPECT_NEAR(sums.area, area, 1e-13) << name;
      EXPECT_NEAR(sums.shares, area, 1e-13) << name;
      EXPECT_LE((sums.normal - (2 * end - 1) * area * Vector3d::Unit(axis)).norm(), 1e-13) << name;
      for (const int node : face_set_nodes(s.solids, find_face_set(s, name)->faces)) {
        EXPECT_NEAR(s.nodes[static_cast<std::size_t>(node)].position[axis],
                    0.1 * static_cast<double>(axis + 1) + end * size[axis], 1e-15);
      }
    }
  }
  EXPECT_NEAR(volume_within(s), size.prod(), 1e-13);
}

TEST_P(Generated, SurfacesAreDrawnByTheirNodes) {
  Structure s;
  add_box(s, {{0, 0, 0}, {3, 2, 1}, {3, 2, 1}}, test::steel(), GetParam());
  const FeModel fe = assemble(s);
  Vector3d area = Vector3d::Zero();
  double volume = 0;
  for (const SurfaceFace& face : surface_faces(fe)) {
    const auto at = [&](std::size_t k) {
      return fe.nodes[static_cast<std::size_t>(face.nodes[k])].position;
    };
    const bool triangle = face.nodes[3] < 0;
    const Vector3d normal = triangle ? Vector3d(0.5 * (at(1) - at(0)).cross(at(2) - at(0)))
                                     : Vector3d(0.5 * (at(2) - at(0)).cross(at(3) - at(1)));
    area += normal;
    volume += normal.dot(at(0)) / 3.0;  // plane pieces: any of their points serves
  }
  EXPECT_LE(area.norm(), 1e-14);
  EXPECT_NEAR(volume, 6.0, 1e-13);
}

Cylinder round_bar(double bore, int refinement) {
  const Vector3d axis = Vector3d(0.2, -0.5, 0.7).normalized();
  const Vector3d from(0.1, 0.2, -0.3);
  return {from, from + 0.8 * axis, 0.25, bore, {refinement, 8 * refinement, 2 * refinement}};
}

struct RoundErrors {
  double mass, inertia, side;
};

/// Relative errors of mass, inertia tensor and outer surface.
RoundErrors round_errors(double bore, int refinement, const SolidForm& form) {
  const Cylinder c = round_bar(bore, refinement);
  Structure s;
  add_cells(s, cylinder_cells(c), form, test::steel());
  const FeModel fe = assemble(s);
  EXPECT_TRUE(solids_join_by_faces(fe));
  EXPECT_LE((fe.shape.com - 0.5 * (c.from + c.to)).norm(), 1e-12);
  EXPECT_NEAR(volume_within(s), fe.shape.mass / test::steel().rho, 1e-13);
  const double R2 = c.outer_radius * c.outer_radius, r2 = bore * bore, L = 0.8;
  const double mass = test::steel().rho * M_PI * (R2 - r2) * L;
  const Vector3d axis = (c.to - c.from) / L;
  const double along = 0.5 * mass * (R2 + r2);
  const double across = mass * (3 * (R2 + r2) + L * L) / 12;
  const Matrix3d J = across * Matrix3d::Identity() + (along - across) * axis * axis.transpose();
  const double side = 2 * M_PI * c.outer_radius * L;
  const double found = sums_of(s, bore > 0 ? "outer" : "side").area;
  return {std::abs(fe.shape.mass - mass) / mass, (fe.shape.J0 - J).norm() / J.norm(),
          std::abs(found - side) / side};
}

// Chords lose area with h², parabolas with h⁴.
TEST_P(Generated, RoundSolidsConvergeToTheCircle) {
  for (const double bore : {0.0, 0.15}) {
    const RoundErrors coarse = round_errors(bore, 1, GetParam());
    const RoundErrors fine = round_errors(bore, 2, GetParam());
    const double order = test::is_quadratic(GetParam()) ? 4.0 : 2.0;
    EXPECT_NEAR(std::log2(coarse.mass / fine.mass), order, 0.15) << "bore " << bore;
    EXPECT_NEAR(std::log2(coarse.inertia / fine.inertia), order, 0.25) << "bore " << bore;
    EXPECT_NEAR(std::log2(coarse.side / fine.side), order, 0.15) << "bore " << bore;
  }
}

TEST_P(Generated, RoundSolidsNameTheirFaces) {
  for (const double bore : {0.0, 0.15}) {
    const Cylinder c = round_bar(bore, 2);
    Structure s;
    const GeneratedMesh mesh = add_cells(s, cylinder_cells(c), GetParam(), test::steel());
    const Vector3d axis = (c.to - c.from) / 0.8;
    const auto expect = [&](const std::string& name, auto&& measure, double expected) {
      ASSERT_NE(find_face_set(s, name), nullptr) << name;
      for (const int node : face_set_nodes(s.solids, find_face_set(s, name)->faces)) {
        const Vector3d x = s.nodes[static_cast<std::size_t>(node)].position - c.from;
        EXPECT_NEAR(measure(x), expected, 1e-14) << name;
      }
    };
    const auto height = [&](const Vector3d& x) { return x.dot(axis); };
    const auto radius = [&](const Vector3d& x) { return (x - x.dot(axis) * axis).norm(); };
    expect("bottom", height, 0.0);
    expect("top", height, 0.8);
    expect(bore > 0 ? "outer" : "side", radius, 0.25);
    if (bore > 0) expect("inner", radius, 0.15);
    EXPECT_LE(sums_of(s, "top").normal.cross(axis).norm(), 1e-13);
    EXPECT_LT(sums_of(s, "bottom").normal.dot(axis), 0.0);
    for (const auto& [name, node] : mesh.names) {
      const double place = name == "bottom_centre" ? 0.0 : name == "centre" ? 0.5 : 1.0;
      const Vector3d x = s.nodes[static_cast<std::size_t>(node)].position;
      EXPECT_LE((x - c.from - place * (c.to - c.from)).norm(), 1e-14) << name;
    }
    EXPECT_EQ(mesh.names.size(), bore > 0 ? 0u : 3u);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Generated, testing::ValuesIn(test::all_forms()),
                         [](const auto& form) { return test::form_name(form.param); });

TEST(CylinderMesh, RefusesWhatIsNotRound) {
  const auto refused = [](auto&& change, const char* words) {
    Cylinder c;
    change(c);
    EXPECT_THAT([&] { cylinder_cells(c); }, ThrowsMessage<ModelError>(HasSubstr(words)));
  };
  refused([](Cylinder& c) { c.inner_radius = 1.0; }, "0 <= inner < outer");
  refused([](Cylinder& c) { c.to = c.from; }, "two ends must differ");
  refused([](Cylinder& c) { c.divisions = {0, 8, 1}; }, "at least 1, 4 and 1");
  refused([](Cylinder& c) { c.divisions = {1, 10, 1}; }, "divisible by 4, for example 12");
}

TEST(SolidRecovery, FindsTheElementsAtNodes) {
  Structure s;
  add_box(s, {{0, 0, 0}, {3, 2, 1}, {3, 2, 1}}, test::steel());
  const FeModel fe = assemble(s);
  EXPECT_EQ(surface_faces(fe).size(), 2u * (3 * 2 + 2 * 1 + 3 * 1));
  EXPECT_EQ(solids_at_nodes(fe)[5].size(), 4u);  // (1, 1, 0)
}

}  // namespace
}  // namespace buckens::fem

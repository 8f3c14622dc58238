// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <random>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/base/test/temporary_directory.h"
#include "buckens/mesh_io/abaqus/deck.h"
#include "buckens/mesh_io/abaqus/face_point.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// A warped face with all its nodes off the straight shape.
Matrix3Xd face(int nodes) {
  Matrix3Xd out(3, nodes);
  if (nodes == 3 || nodes == 6) {
    out.leftCols(3) << 0, 2, 0.3, 0, 0.1, 1.5, 0, 0.2, 0.1;
  } else {
    out.leftCols(4) << 0, 2, 2.2, -0.1, 0, 0.1, 1.5, 1.2, 0, 0.2, 0.1, 0.3;
  }
  const int corners = nodes == 3 || nodes == 6 ? 3 : 4;
  for (int k = corners; k < nodes; ++k) {
    out.col(k) = 0.5 * (out.col(k - corners) + out.col((k - corners + 1) % corners)) +
                 Vector3d(0.01, 0.02, 0.05);
  }
  return out;
}

TEST(AbaqusFacePoint, WeightsAreThoseOfTheNodesThere) {
  for (const int nodes : {3, 4, 6, 8}) {
    const Matrix3Xd x = face(nodes);
    for (int k = 0; k < nodes; ++k) {
      const FacePoint at = nearest_on_face(x, false, x.col(k));
      // A node is found where it is, and there its own weight is one.
      EXPECT_LT(at.distance, 1e-10) << nodes;
      EXPECT_NEAR(at.weights[k], 1.0, 1e-8) << nodes;
      EXPECT_NEAR(at.weights.sum(), 1.0, 1e-12);
    }
  }
}

TEST(AbaqusFacePoint, NoPointOfAFineGridIsNearer) {
  const Matrix3Xd x = face(4);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> random(-1.0, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d p(random(engine), random(engine), random(engine));
    double least = 1e9;
    for (int i = 0; i <= 100; ++i) {
      for (int j = 0; j <= 100; ++j) {
        const double r = i / 100.0, s = j / 100.0;
        const Vector3d at = (1 - r) * (1 - s) * x.col(0) + r * (1 - s) * x.col(1) +
                            r * s * x.col(2) + (1 - r) * s * x.col(3);
        least = std::min(least, (p - at).norm());
      }
    }
    // The grid is coarser than the search.
    EXPECT_LE(nearest_on_face(x, false, p).distance, least + 1e-9);
  }
}

TEST(AbaqusFacePoint, EdgesAreLinesAndParabolas) {
  Matrix3Xd line(3, 3);
  line << 0, 2, 1, 0, 0, 0.5, 0, 0, 0;
  const FacePoint at = nearest_on_face(line, true, Vector3d(1, 2, 0));
  EXPECT_LT((at.place - Vector3d(1, 0.5, 0)).norm(), 1e-10);
  EXPECT_LT(
      (nearest_on_face(line.leftCols(2), true, Vector3d(3, 1, 0)).place - Vector3d(2, 0, 0)).norm(),
      1e-12);
}

TEST(AbaqusFacePoint, RigidRotationsOfFacesAreFoundExactly) {
  const Vector3d omega(0.3, -0.7, 0.4), shift(1, 2, 3);
  for (const int nodes : {3, 4, 6, 8}) {
    const Matrix3Xd x = face(nodes);
    const FacePoint at = nearest_on_face(x, false, Vector3d(0.7, 0.4, 0.6));
    const Matrix3Xd turn = face_rotation(x, at.slopes);
    Vector3d found = Vector3d::Zero();
    for (int k = 0; k < nodes; ++k) {
      found += turn.middleCols(3 * k, 3) * (shift + omega.cross(x.col(k)));
    }
    EXPECT_LT((found - omega).norm(), 1e-12) << nodes;
  }
}

/// A cube and a smaller one above it, with a gap and turned against it.
fem::ImportedMesh tied_cubes(const char* type, const char* tie) {
  std::string text = "*NODE\n";
  const Eigen::AngleAxisd turn(0.3, Vector3d::UnitZ());
  const bool is_quadratic = std::string(type) == "C3D20";
  const double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                           {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::string elements;
  for (int cube = 0; cube < 2; ++cube) {
    elements += fmt::format("{}", cube + 1);
    const auto add = [&](int k, const Vector3d& at) {
      const Vector3d x = cube == 0 ? at : Vector3d(turn * (0.6 * at) + Vector3d(0, 0, 1.61));
      text += fmt::format("{},{},{},{}\n", 100 * cube + k + 1, x[0], x[1], x[2]);
      elements += fmt::format(",{}{}", k == 10 ? "\n" : "", 100 * cube + k + 1);
    };
    for (int k = 0; k < 8; ++k) add(k, Vector3d(corner[k][0], corner[k][1], corner[k][2]));
    for (int k = 0; is_quadratic && k < 12; ++k) {
      const auto* a = corner[edge[k][0]];
      const auto* b = corner[edge[k][1]];
      add(8 + k, 0.5 * (Vector3d(a[0], a[1], a[2]) + Vector3d(b[0], b[1], b[2])));
    }
    elements += '\n';
  }
  text += fmt::format("*ELEMENT, TYPE={}, ELSET=E\n{}", type, elements);
  text += "*SURFACE, NAME=M\n1, S2\n*SURFACE, NAME=S\n2, S1\n";
  const buckens::test::TemporaryDirectory folder;
  std::ofstream(folder / "deck.inp") << text << tie;
  return read_abaqus_deck(folder / "deck.inp");
}

/// Sums up the equations for displacements of the nodes.
double largest_residual(const fem::ImportedMesh& mesh, const Eigen::Matrix3d& F,
                        const Vector3d& shift) {
  double out = 0;
  for (const auto& equation : mesh.equations) {
    double sum = 0;
    for (const auto& term : equation.terms) {
      const Vector3d u = shift + F * mesh.positions[static_cast<std::size_t>(term.node)];
      sum += term.coefficient * u[term.variable];
    }
    out = std::max(out, std::abs(sum));
  }
  return out;
}

TEST(AbaqusTie, RigidMotionStrainsNothingOverAGap) {
  Eigen::Matrix3d spin;
  spin << 0, -3, 2, 3, 0, -1, -2, 1, 0;
  for (const char* type : {"C3D8", "C3D20"}) {
    const auto mesh = tied_cubes(type, "*TIE, NAME=T, POSITION TOLERANCE=0.02\nS, M\n");
    EXPECT_EQ(mesh.equations.size(), std::string(type) == "C3D8" ? 12u : 24u);
    EXPECT_LT(largest_residual(mesh, spin, Vector3d(1, 2, 3)), 1e-12) << type;
    // Stretching in the face is followed; along the gap the slave moves with the face.
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero();
    stretch(0, 0) = 0.1;
    stretch(0, 1) = stretch(1, 0) = 0.05;
    EXPECT_LT(largest_residual(mesh, stretch, Vector3d::Zero()), 1e-12) << type;
  }
}

TEST(AbaqusTie, NodesBeyondTheToleranceStayFree) {
  const auto mesh = tied_cubes("C3D8", "*TIE, NAME=T, POSITION TOLERANCE=0.005\nS, M\n");
  EXPECT_TRUE(mesh.equations.empty());
  const auto usual = tied_cubes("C3D8", "*TIE, NAME=T\nS, M\n");
  EXPECT_EQ(usual.equations.size(), 12u);  // 5 % of a face that is 2.8 wide from corner to corner
}

}  // namespace
}  // namespace buckens::mesh_io

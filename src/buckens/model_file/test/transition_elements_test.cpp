// SPDX-License-Identifier: Apache-2.0
// Elements of Nastran that lack some of their mid-side nodes: patch tests. A field that is linear
// in space, and in plates one of constant curvature, must be reproduced with the energy of Hooke's
// law.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/constraint/elimination.h"
#include "buckens/mesh_io/nastran/deck.h"
#include "buckens/model/build/imported_structure.h"

namespace buckens::model_file {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Sums over some hundred products; nodes have four digits, which are exact in the deck.
constexpr double kRounding = 1e-11;
constexpr double kYoung = 200.0, kPoisson = 0.3, kThickness = 0.02;
const std::string kMaterial = "MAT1,1,200.,,.3,1.\nPSOLID,1,1\nPSHELL,2,1,.02,1\n";

struct Motion {
  Vector3d u = Vector3d::Zero(), theta = Vector3d::Zero();
};
using Field = std::function<Motion(const Vector3d&)>;

/// A deck after its links are solved.
class Solved {
 public:
  explicit Solved(const std::string& deck)
      : fe_(fem::assemble(structure(deck).structure)),
        elimination_(fem::eliminate(fe_.nodes, fe_.dofs, structure(deck).structure.links)) {}

  /// The independent variables of a field.
  linalg::Vector independent(const Field& field) const {
    return values(elimination_.dofs, elimination_.T.cols(), field);
  }
  /// Deviation of the dependent variables from the field of the independent ones.
  double error(const Field& field) const {
    const linalg::Vector all = values(fe_.dofs, fe_.dofs.num_dofs, field);
    return (elimination_.T * independent(field) - all).cwiseAbs().maxCoeff();
  }
  linalg::Vector forces(const Field& field) const {
    return elimination_.T.transpose() * (fe_.K * (elimination_.T * independent(field)));
  }
  double energy(const Field& field) const { return 0.5 * independent(field).dot(forces(field)); }
  /// The largest force at a place.
  double force_at(const Vector3d& place, const Field& field) const {
    const linalg::Vector all = forces(field);
    double out = -1;
    for (std::size_t n = 0; n < fe_.nodes.size(); ++n) {
      if (!fe_.nodes[n].position.isApprox(place, 1e-12)) continue;
      for (const int dof : elimination_.dofs.node_dofs[n]) {
        if (dof >= 0) out = std::max(out, std::abs(all[dof]));
      }
    }
    return out;
  }
  int num_independent() const { return static_cast<int>(elimination_.T.cols()); }

 private:
  static model::ImportedStructure structure(const std::string& deck) {
    return model::imported_structure(mesh_io::read_nastran_text(deck, "deck.bdf"), {}, std::nullopt,
                                     {"model.yaml", 1, 1});
  }
  linalg::Vector values(const fem::DofMap& dofs, Eigen::Index count, const Field& field) const {
    linalg::Vector out = linalg::Vector::Zero(count);
    for (std::size_t n = 0; n < fe_.nodes.size(); ++n) {
      const Motion motion = field(fe_.nodes[n].position);
      for (std::size_t k = 0; k < 6; ++k) {
        const int dof = dofs.node_dofs[n][k];
        const auto axis = static_cast<Eigen::Index>(k % 3);
        if (dof >= 0) out[dof] = k < 3 ? motion.u[axis] : motion.theta[axis];
      }
    }
    return out;
  }

  fem::FeModel fe_;
  fem::Elimination elimination_;
};

/// A gradient of displacements, and half of ε:C:ε.
const Matrix3d kGradient = (Matrix3d() << 3, 1, -2, 4, -1, 5, 0, 2, 2).finished() * 1e-3;

Motion linear(const Vector3d& x) { return {kGradient * x, Vector3d::Zero()}; }

double energy_density() {
  const Matrix3d strain = 0.5 * (kGradient + kGradient.transpose());
  const double mu = kYoung / (2 * (1 + kPoisson));
  const double lambda = kYoung * kPoisson / ((1 + kPoisson) * (1 - 2 * kPoisson));
  return mu * strain.squaredNorm() + 0.5 * lambda * strain.trace() * strain.trace();
}

void expect_linear(const std::string& deck, double volume, int num_independent) {
  const Solved solved(kMaterial + deck);
  EXPECT_EQ(solved.num_independent(), num_independent);
  EXPECT_LT(solved.error(linear), kRounding * kGradient.norm());
  const double expected = volume * energy_density();
  EXPECT_NEAR(solved.energy(linear), expected, kRounding * expected);
}

TEST(TransitionElements, solids_with_some_mid_side_nodes_reproduce_linear_fields) {
  // Straight edges; nodes 11 to 13 lie in their middles.
  const std::string tetra =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,.5,1.5,0.\nGRID,4,,.25,.5,1.\n"
      "GRID,11,,1.,0.,0.\nGRID,12,,1.125,.25,.5\nGRID,13,,.25,.75,0.\n";
  expect_linear(tetra + "CTETRA,1,1,1,2,3,4,11,,+\n+,13,,12\n", 0.5, 3 * 7);
  expect_linear(tetra + "CTETRA,1,1,1,2,3,4,11,0,+\n+,13,0,12,0\n", 0.5, 3 * 7);
  const std::string prism =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nGRID,5,,2.,0.,1.\n"
      "GRID,6,,0.,1.,1.\nGRID,11,,1.,.5,0.\nGRID,12,,2.,0.,.5\nGRID,13,,0.,.5,1.\n";
  expect_linear(prism + "CPENTA,1,1,1,2,3,4,5,6,+\n+,,11,,,12,,,,+\n+,13\n", 1.0, 3 * 9);
  const std::string brick =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,2.,0.\nGRID,4,,0.,2.,0.\n"
      "GRID,5,,.5,0.,1.\nGRID,6,,1.5,0.,1.\nGRID,7,,1.5,2.,1.\nGRID,8,,.5,2.,1.\n"
      "GRID,11,,1.,1.,0.\nGRID,12,,.25,0.,.5\nGRID,13,,1.,2.,1.\n";
  expect_linear(brick + "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8,,11,,,12,,+\n+,,,,,13\n", 2.0, 3 * 11);
}

TEST(TransitionElements, pyramids_of_thirteen_nodes_have_straight_edges) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\nGRID,5,,1.,.5,1.5\n"
      "GRID,6,,1.,0.,0.\nGRID,7,,2.,1.,0.\nGRID,8,,1.,2.,0.\nGRID,9,,0.,1.,0.\n"
      "GRID,10,,.5,.25,.75\nGRID,11,,1.5,.25,.75\nGRID,12,,1.5,1.25,.75\nGRID,13,,.5,1.25,.75\n";
  expect_linear(nodes + "CPYRAM,1,1,1,2,3,4,5,6,+\n+,7,8,9,10,11,12,13\n", 2.0, 3 * 5);
}

/// Eight hexahedra: the lower four with mid-side nodes but on their upper faces, where they meet
/// the upper four of eight nodes. The node in the middle of all lies off the centre.
TEST(TransitionElements, quadratic_and_linear_hexahedra_join_without_a_gap) {
  std::string nodes, elements;
  const auto number = [](int i, int j, int k) { return 1 + i + 5 * (j + 5 * k); };
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) {
        const auto end = [&](int a, int n) { return a == 2 && n == 2; };
        // Corners are even; the one in the middle is moved, and its edges with it.
        const bool odd_i = i % 2 != 0, odd_j = j % 2 != 0, odd_k = k % 2 != 0;
        if (odd_i + odd_j + odd_k > 1) continue;
        const bool near_i = end(i, 2) || (odd_i && j == 2 && k == 2);
        const bool near_j = end(j, 2) || (odd_j && i == 2 && k == 2);
        const bool near_k = end(k, 2) || (odd_k && i == 2 && j == 2);
        const double share = !(near_i && near_j && near_k) ? 0.0
                             : odd_i + odd_j + odd_k > 0   ? 0.5
                                                           : 1.0;
        nodes += fmt::format("GRID,{},,{},{},{}\n", number(i, j, k), i / 2.0 + 0.25 * share,
                             j / 2.0 - 0.125 * share, k / 2.0 + 0.125 * share);
      }
    }
  }
  int id = 0;
  for (int k = 0; k < 4; k += 2) {
    for (int j = 0; j < 4; j += 2) {
      for (int i = 0; i < 4; i += 2) {
        const auto n = [&](int a, int b, int c) { return number(i + a, j + b, k + c); };
        elements +=
            fmt::format("CHEXA,{},1,{},{},{},{},{},{},+\n+,{},{}", ++id, n(0, 0, 0), n(2, 0, 0),
                        n(2, 2, 0), n(0, 2, 0), n(0, 0, 2), n(2, 0, 2), n(2, 2, 2), n(0, 2, 2));
        if (k == 0) {
          elements +=
              fmt::format(",{},{},{},{},{},{},+\n+,{},{}", n(1, 0, 0), n(2, 1, 0), n(1, 2, 0),
                          n(0, 1, 0), n(0, 0, 1), n(2, 0, 1), n(2, 2, 1), n(0, 2, 1));
        }
        elements += '\n';
      }
    }
  }
  const Solved solved(kMaterial + nodes + elements);
  // 27 corners, 12 edges below, 9 upright ones.
  EXPECT_EQ(solved.num_independent(), 3 * (27 + 12 + 9));
  EXPECT_LT(solved.error(linear), kRounding * kGradient.norm());
  EXPECT_NEAR(solved.energy(linear), 8 * energy_density(), kRounding * 8 * energy_density());
  const double scale = kYoung * kGradient.norm();
  EXPECT_LT(solved.force_at({1.25, 0.875, 1.125}, linear), kRounding * scale);
  EXPECT_GE(solved.force_at({1.125, 0.9375, 0.5625}, linear), 0.0);
  EXPECT_LT(solved.force_at({1.125, 0.9375, 0.5625}, linear), kRounding * scale);
}

TEST(TransitionElements, shells_with_some_mid_side_nodes_pass_in_plane_and_bend) {
  const Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto grid = [&](int id, double x, double y) {
    const Vector3d p = R * Vector3d(x, y, 0);
    return fmt::format("GRID*,{},,{:.16g},{:.16g}\n*,{:.16g}\n", id, p.x(), p.y(), p.z());
  };
  // Two fields of one area each, skewed; the edge between them has no node in its middle.
  const std::string deck = kMaterial + grid(1, 0, 0) + grid(2, 1, 0) + grid(3, 1.25, 1) +
                           grid(4, 0.25, 1) + grid(5, 2, 0) + grid(6, 2.25, 1) + grid(7, 0.5, 0) +
                           grid(8, 0.125, 0.5) + grid(9, 1.5, 0) +
                           "CQUAD8,1,2,1,2,3,4,7,,+\n+,,8\nCTRIA6,2,2,2,5,3,9,,\n"
                           "CQUAD4,3,2,1,2,3,4\nCTRIA3,4,2,5,6,3\n";
  const Solved solved(deck);
  const double area = 1 + 0.5 + 1 + 0.5;
  const Matrix3d plane = (Matrix3d() << 3, 1, 0, 4, -1, 0, 0, 0, 0).finished() * 1e-3;
  const Field stretch = [&](const Vector3d& p) -> Motion {
    const Vector3d x = R.transpose() * p;
    const Vector3d spin(0, 0, 0.5 * (plane(1, 0) - plane(0, 1)));
    return {R * (plane * x), R * spin};
  };
  const double a = plane(0, 0), b = plane(1, 1), g = plane(0, 1) + plane(1, 0);
  const double stiffness = kYoung / (1 - kPoisson * kPoisson);
  const double in_plane = 0.5 * stiffness * kThickness * area *
                          (a * a + b * b + 2 * kPoisson * a * b + 0.5 * (1 - kPoisson) * g * g);
  EXPECT_LT(solved.error(stretch), kRounding);
  EXPECT_NEAR(solved.energy(stretch), in_plane, kRounding * in_plane);

  // w = ½ kx x² + ½ ky y² + kxy x y, turned by its slopes: no shear.
  const double kx = 2e-3, ky = -1e-3, kxy = 3e-3;
  const Field bend = [&](const Vector3d& p) -> Motion {
    const Vector3d x = R.transpose() * p;
    const double w = 0.5 * kx * x.x() * x.x() + 0.5 * ky * x.y() * x.y() + kxy * x.x() * x.y();
    const Vector3d turn(ky * x.y() + kxy * x.x(), -(kx * x.x() + kxy * x.y()), 0);
    return {R * Vector3d(0, 0, w), R * turn};
  };
  const double bending =
      0.5 * stiffness * std::pow(kThickness, 3) / 12 * area *
      (kx * kx + ky * ky + 2 * kPoisson * kx * ky + 2 * (1 - kPoisson) * kxy * kxy);
  EXPECT_LT(solved.error(bend), kRounding);
  // A plate of a fiftieth: the terms that cancel in shear are 1e4 times larger.
  EXPECT_NEAR(solved.energy(bend), bending, 1e4 * kRounding * bending);
}

}  // namespace
}  // namespace buckens::model_file

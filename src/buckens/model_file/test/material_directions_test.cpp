// SPDX-License-Identifier: Apache-2.0
// Directions of orthotropic materials and of layers, as each format counts them, against Hooke's
// law turned by hand: the strain of a pull σ_x = 1 must have the energy of that pull.
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/mesh_io/abaqus/deck.h"
#include "buckens/mesh_io/nastran/deck.h"
#include "buckens/model/build/imported_structure.h"

namespace buckens::model_file {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegrees = std::numbers::pi / 180.0;
// Sums over some hundred products of numbers written with seventeen digits.
constexpr double kSumRounding = 1e-11;

// The plate is 3 by 2, of 2 by 2 elements; direction 1 of the material lies at 30 degrees from its
// x axis.
constexpr double kLong = 3, kWide = 2, kThick = 0.1;
constexpr double E1 = 120, E2 = 10, E3 = 8, nu12 = 0.3, nu13 = 0.25, nu23 = 0.4;
constexpr double G12 = 6, G13 = 5, G23 = 3;

struct Strain {
  double x = 0, y = 0, z = 0, xy = 0;
};

/// Of σ_x = 1, with direction 1 at an angle from x about z.
Strain pulled(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double sigma1 = c * c, sigma2 = s * s, tau = -c * s;
  const double e1 = sigma1 / E1 - nu12 / E1 * sigma2;
  const double e2 = sigma2 / E2 - nu12 / E1 * sigma1;
  const double g = tau / G12;
  return {c * c * e1 + s * s * e2 - c * s * g, s * s * e1 + c * c * e2 + c * s * g,
          -nu13 / E1 * sigma1 - nu23 / E2 * sigma2, 2 * c * s * (e1 - e2) + (c * c - s * s) * g};
}

/// Energy of a uniform strain of the plate, which stands turned by R.
double energy(const fem::ImportedMesh& mesh, const Matrix3d& R, const Strain& e) {
  const fem::FeModel fe = fem::assemble(
      model::imported_structure(mesh, {}, std::nullopt, {"model.yaml", 1, 1}).structure);
  linalg::Vector u = linalg::Vector::Zero(fe.dofs.num_dofs);
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Vector3d p = R.transpose() * fe.nodes[n].position;
    const Vector3d own = R * Vector3d(e.x * p.x() + 0.5 * e.xy * p.y(),
                                      0.5 * e.xy * p.x() + e.y * p.y(), e.z * p.z());
    for (int k = 0; k < 3; ++k) u[fe.dofs.node_dofs[n][static_cast<std::size_t>(k)]] = own[k];
  }
  return 0.5 * u.dot(fe.K * u);
}

void expect_at_30_degrees(const fem::ImportedMesh& mesh, const Matrix3d& R, double thickness) {
  const double volume = kLong * kWide * thickness;
  const Strain right = pulled(30 * kDegrees), wrong = pulled(-30 * kDegrees);
  EXPECT_NEAR(energy(mesh, R, right), 0.5 * right.x * volume, kSumRounding * right.x * volume);
  // The other sign of the angle is far off.
  EXPECT_GT(energy(mesh, R, wrong), 1.1 * 0.5 * wrong.x * volume);
}

Matrix3d anywhere() {
  return Eigen::AngleAxisd(50 * kDegrees, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

/// About y, so that the projection of x onto the plate is its own x axis.
Matrix3d inclined() {
  return Eigen::AngleAxisd(40 * kDegrees, Vector3d::UnitY()).toRotationMatrix();
}

std::string numbers_of(const Vector3d& v) {
  return fmt::format("{:.17g}, {:.17g}, {:.17g}", v.x(), v.y(), v.z());
}

/// Calls add(number, place) for the nodes of 3 by 3, in `layers` planes one above the other.
void visit_nodes(const Matrix3d& R, int layers, const std::function<void(int, Vector3d)>& add) {
  constexpr std::array<double, 3> x = {0, 1.4, kLong}, y = {0, 0.9, kWide};
  int number = 0;
  for (int k = 0; k < layers; ++k) {
    for (const double v : y) {
      for (const double u : x) add(++number, R * Vector3d(u, v, k));
    }
  }
}

constexpr std::array<std::array<int, 4>, 4> kQuads = {
    {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 5, 8, 7}, {5, 6, 9, 8}}};

// ---- Nastran ----

std::string grids(const Matrix3d& R, int layers) {
  std::string out;
  visit_nodes(R, layers, [&](int number, const Vector3d& at) {
    out += fmt::format("GRID,{},,{}\n", number, numbers_of(at));
  });
  return out;
}

const std::string kMat8 =
    fmt::format("MAT8,1,{}.,{}.,{},{}.,{}.,{}.,1.\n", E1, E2, nu12, G12, G13, G23);

/// @param first which corner of each element stands first
fem::ImportedMesh nastran_plate(const Matrix3d& R, const std::string& property,
                                const std::string& theta, std::size_t first = 0) {
  std::string deck = grids(R, 1) + kMat8 + property;
  for (std::size_t e = 0; e < 4; ++e) {
    const auto corner = [&](std::size_t k) { return kQuads[e][(first + k) % 4]; };
    deck += fmt::format("CQUAD4,{},1,{},{},{},{},{}\n", e + 1, corner(0), corner(1), corner(2),
                        corner(3), theta);
  }
  return mesh_io::read_nastran_text(deck, "deck.bdf");
}

/// System 7: its z axis is the normal of the plate, its x axis at an angle from that of the plate.
std::string system_7(const Matrix3d& R, double angle) {
  return fmt::format(
      "CORD2R,7,,0.,0.,0.,{}\n,{}\n", numbers_of(R * Vector3d::UnitZ()),
      numbers_of(R * Vector3d(std::cos(angle * kDegrees), std::sin(angle * kDegrees), 0)));
}

TEST(NastranDirections, ThetaCountsFromTheFirstSide) {
  const Matrix3d R = anywhere();
  const std::string shell = "PSHELL,1,1,.1,1\n";
  expect_at_30_degrees(nastran_plate(R, shell, "30."), R, kThick);
  // Sides that begin at the second corner lie along y.
  expect_at_30_degrees(nastran_plate(R, shell, "-60.", 1), R, kThick);
  std::string triangles = grids(R, 1) + kMat8 + shell;
  int number = 0;
  for (const auto& q : kQuads) {
    triangles += fmt::format("CTRIA3,{},1,{},{},{},30.\n", ++number, q[0], q[1], q[2]);
    triangles += fmt::format("CTRIA3,{},1,{},{},{},30.\n", ++number, q[2], q[3], q[0]);
  }
  expect_at_30_degrees(mesh_io::read_nastran_text(triangles, "deck.bdf"), R, kThick);
}

TEST(NastranDirections, McidIsProjected) {
  const Matrix3d R = anywhere();
  const std::string shell = "PSHELL,1,1,.1,1\n";
  expect_at_30_degrees(nastran_plate(R, shell + system_7(R, 30), "7"), R, kThick);
  expect_at_30_degrees(nastran_plate(R, shell + system_7(R, 30), "7", 2), R, kThick);
}

TEST(NastranDirections, AnglesOfLayersCountFromTheDirectionOfTheElement) {
  const Matrix3d R = anywhere();
  expect_at_30_degrees(nastran_plate(R, "PCOMP,1\n,1,.1,30.\n", ""), R, kThick);
  expect_at_30_degrees(nastran_plate(R, "PCOMP,1\n,1,.1,10.\n", "20."), R, kThick);
  expect_at_30_degrees(nastran_plate(R, "PCOMP,1\n,1,.1,10.\n" + system_7(R, 20), "7"), R, kThick);
  expect_at_30_degrees(nastran_plate(R, "PCOMP,1,,,,,,,SYM\n,1,.02,30.,,1,.03,30.\n", ""), R,
                       kThick);
}

TEST(NastranDirections, CordmTurnsSolids) {
  const Matrix3d R = anywhere();
  Matrix3d S;
  S << 1 / E1, -nu12 / E1, -nu13 / E1, -nu12 / E1, 1 / E2, -nu23 / E2, -nu13 / E1, -nu23 / E2,
      1 / E3;
  const Matrix3d C = S.inverse();
  std::string deck = grids(R, 2) + system_7(R, 30) + "PSOLID,1,1,7\n";
  deck += fmt::format("MAT9,1,{:.17g},{:.17g},{:.17g},,,,{:.17g}\n", C(0, 0), C(0, 1), C(0, 2),
                      C(1, 1));
  deck += fmt::format(",{:.17g},,,,{:.17g}\n,{}.,,,{}.,,{}.,1.\n", C(1, 2), C(2, 2), G12, G23, G13);
  for (int e = 0; e < 4; ++e) {
    const auto& q = kQuads[static_cast<std::size_t>(e)];
    deck += fmt::format("CHEXA,{},1,{},{},{},{},{},{}\n,{},{}\n", e + 1, q[0], q[1], q[2], q[3],
                        q[0] + 9, q[1] + 9, q[2] + 9, q[3] + 9);
  }
  expect_at_30_degrees(mesh_io::read_nastran_text(deck, "deck.bdf"), R, 1.0);
}

// ---- Abaqus ----

std::string abaqus_nodes(const Matrix3d& R, int layers) {
  std::string out = "*NODE\n";
  visit_nodes(R, layers, [&](int number, const Vector3d& at) {
    out += fmt::format("{}, {}\n", number, numbers_of(at));
  });
  return out;
}

std::string abaqus_quads() {
  std::string out = "*ELEMENT, TYPE=S4, ELSET=E\n";
  for (std::size_t e = 0; e < 4; ++e) {
    out += fmt::format("{}, {}\n", e + 1, fmt::join(kQuads[e], ", "));
  }
  return out;
}

const std::string kLamina =
    fmt::format("*MATERIAL, NAME=P\n*ELASTIC, TYPE=LAMINA\n{}, {}, {}, {}, {}, {}\n*DENSITY\n1\n",
                E1, E2, nu12, G12, G13, G23);
const std::string kShell = "*SHELL SECTION, ELSET=E, MATERIAL=P, ORIENTATION=O\n0.1\n";

fem::ImportedMesh read_abaqus(const std::string& deck) {
  const buckens::test::TemporaryDirectory folder;
  std::ofstream(folder / "deck.inp") << deck;
  return mesh_io::read_abaqus_deck(folder / "deck.inp");
}

fem::ImportedMesh abaqus_plate(const Matrix3d& R, const std::string& rest) {
  return read_abaqus(abaqus_nodes(R, 1) + abaqus_quads() + kLamina + rest);
}

std::string orientation(const Vector3d& a, const Vector3d& b, const std::string& second,
                        const std::string& system = "RECTANGULAR") {
  return fmt::format("*ORIENTATION, NAME=O, SYSTEM={}\n{}, {}\n{}\n", system, numbers_of(a),
                     numbers_of(b), second);
}

TEST(AbaqusDirections, TheAxisAfterTheOneNearTheNormalIsDirection1) {
  const Matrix3d R = anywhere();
  const Vector3d x = R.col(0), y = R.col(1), z = R.col(2);
  expect_at_30_degrees(abaqus_plate(R, kShell + orientation(x, y, "3, 30.")), R, kThick);
  expect_at_30_degrees(abaqus_plate(R, kShell + orientation(z, x, "1, 30.")), R, kThick);
  expect_at_30_degrees(abaqus_plate(R, kShell + orientation(z, x, ", 30.")), R, kThick);
  expect_at_30_degrees(abaqus_plate(R, kShell + orientation(y, z, "2, 30.")), R, kThick);
  expect_at_30_degrees(abaqus_plate(R, kShell + orientation(z, x, "3, 30.", "Z RECTANGULAR")), R,
                       kThick);
}

TEST(AbaqusDirections, WithoutOrientationXIsProjected) {
  const Matrix3d R = inclined();
  const std::string one = "*SHELL SECTION, ELSET=E, COMPOSITE\n0.1, 3, P, 30.\n";
  expect_at_30_degrees(abaqus_plate(R, one), R, kThick);
  // Where x is the normal, z is projected in its place.
  Matrix3d upright;
  upright.col(0) = Vector3d::UnitZ();
  upright.col(1) = -Vector3d::UnitY();
  upright.col(2) = Vector3d::UnitX();
  expect_at_30_degrees(abaqus_plate(upright, one), upright, kThick);
}

TEST(AbaqusDirections, AnglesOfLayersCountFromTheOrientation) {
  const Matrix3d R = anywhere();
  const std::string along = orientation(R.col(0), R.col(1), "3, 20.");
  expect_at_30_degrees(
      abaqus_plate(R,
                   "*SHELL SECTION, ELSET=E, COMPOSITE, ORIENTATION=O\n0.1, 3, P, 10.\n" + along),
      R, kThick);
  expect_at_30_degrees(abaqus_plate(R,
                                    "*SHELL SECTION, ELSET=E, COMPOSITE, SYMMETRIC, ORIENTATION=O\n"
                                    "0.02, 3, P, 10.\n0.03, 3, P, 10.\n" +
                                        along),
                       R, kThick);
}

TEST(AbaqusDirections, OrientationsTurnWithTheirInstance) {
  const Matrix3d one = Matrix3d::Identity();
  const std::string deck = "*PART, NAME=Q\n" + abaqus_nodes(one, 1) + abaqus_quads() + kShell +
                           orientation(one.col(0), one.col(1), "3, 30.") +
                           "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Q-1, PART=Q\n0, 0, 0\n"
                           "0, 0, 0, 1, 2, 3, 50.\n*END INSTANCE\n*END ASSEMBLY\n" +
                           kLamina;
  expect_at_30_degrees(read_abaqus(deck), anywhere(), kThick);
}

/// Directions by angles from x of the plate; the last for all elements that have no entry.
std::string distribution(const Matrix3d& R, const std::string& written, double otherwise,
                         const std::vector<double>& angles, const std::string& second) {
  const auto points = [&R](double angle) {
    const Vector3d a(std::cos(angle * kDegrees), std::sin(angle * kDegrees), 0);
    // Any point in the plane of axes 1 and 2 will do for b.
    return numbers_of(R * a) + ", " + numbers_of(R * (0.3 * a + Vector3d::UnitZ().cross(a)));
  };
  std::string out = "*DISTRIBUTION TABLE, NAME=T\nCOORD3D, COORD3D\n" +
                    fmt::format("*DISTRIBUTION, NAME={}, LOCATION=ELEMENT, TABLE=T\n, {}\n",
                                written, points(otherwise));
  for (std::size_t e = 0; e < angles.size(); ++e) {
    out += fmt::format("{}, {}\n", e + 1, points(angles[e]));
  }
  return out + fmt::format("*ORIENTATION, NAME=O\n{}\n{}\n", written, second);
}

std::string abaqus_solids(const Matrix3d& R) {
  std::string deck = abaqus_nodes(R, 2) + "*ELEMENT, TYPE=C3D8I, ELSET=E\n";
  for (int e = 0; e < 4; ++e) {
    const auto& q = kQuads[static_cast<std::size_t>(e)];
    deck += fmt::format("{}, {}, {}, {}, {}, {}\n", e + 1, fmt::join(q, ", "), q[0] + 9, q[1] + 9,
                        q[2] + 9, q[3] + 9);
  }
  deck += fmt::format(
      "*SOLID SECTION, ELSET=E, MATERIAL=P, ORIENTATION=O\n"
      "*MATERIAL, NAME=P\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
      "{}, {}, {}, {}, {}, {}, {}, {}\n{}\n*DENSITY\n1\n",
      E1, E2, E3, nu12, nu13, nu23, G12, G13, G23);
  return deck;
}

TEST(AbaqusDirections, OrientationTurnsSolids) {
  const Matrix3d R = anywhere();
  expect_at_30_degrees(read_abaqus(abaqus_solids(R) + orientation(R.col(0), R.col(1), "3, 30.")), R,
                       1.0);
}

TEST(AbaqusDirections, EachElementHasItsOwnByDistribution) {
  const Matrix3d R = anywhere();
  const std::string solids = abaqus_solids(R);
  expect_at_30_degrees(read_abaqus(solids + distribution(R, "D", -30, {30, 30, 30, 30}, "3, 0.")),
                       R, 1.0);
  expect_at_30_degrees(read_abaqus(solids + distribution(R, "D", 30, {}, "3, 0.")), R, 1.0);
  // The second line turns all of them.
  expect_at_30_degrees(read_abaqus(solids + distribution(R, "D", 20, {20, 20}, "3, 10.")), R, 1.0);
  const auto shells = [&R](const std::string& rest) { return abaqus_plate(R, kShell + rest); };
  expect_at_30_degrees(shells(distribution(R, "D", 30, {30, 30}, "3, 0.")), R, kThick);
  expect_at_30_degrees(shells(distribution(R, "D", 10, {}, "3, 20.")), R, kThick);
  // Two of four elements are told otherwise: two properties.
  EXPECT_EQ(shells(distribution(R, "D", 30, {15, 15}, "3, 0.")).properties.size(), 2u);
  const auto refusal = [&](const std::string& rest) -> std::string {
    try {
      read_abaqus(solids + rest);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_NE(refusal("*ORIENTATION, NAME=O\nX\n").find("no *DISTRIBUTION \"X\""), std::string::npos);
  const std::string short_row =
      refusal("*DISTRIBUTION, NAME=D, LOCATION=ELEMENT\n, 1, 0, 0\n*ORIENTATION, NAME=O\nD\n");
  EXPECT_NE(short_row.find("gives an element 3 values; 6 are needed"), std::string::npos)
      << short_row;
  const std::string on_line = refusal(
      "*DISTRIBUTION, NAME=D, LOCATION=ELEMENT\n, 1, 0, 0, 2, 0, 0\n*ORIENTATION, NAME=O\nD\n");
  EXPECT_NE(on_line.find("lie on one line"), std::string::npos) << on_line;
  const std::string of_nodes = refusal(
      "*DISTRIBUTION, NAME=D, LOCATION=NODE\n, 1, 0, 0, 0, 1, 0\n*ORIENTATION, NAME=O\nD\n");
  EXPECT_NE(of_nodes.find("LOCATION=ELEMENT"), std::string::npos) << of_nodes;
}

TEST(AbaqusDirections, AShellMustBeToldWhichAxisIsItsNormalUnlessItIsTheThird) {
  const Matrix3d R = anywhere();
  const std::string one_line =
      fmt::format("*ORIENTATION, NAME=O\n{}, {}\n", numbers_of(R.col(2)), numbers_of(R.col(0)));
  try {
    abaqus_plate(R, kShell + one_line);
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("its second line must say which of its axes"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace buckens::model_file

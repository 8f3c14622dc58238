// SPDX-License-Identifier: Apache-2.0
// Shapes of PBARL and PBEAML against closed forms that take holes out of rectangles.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/mesh_io/nastran/section_shapes.h"
#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using test::expect_words;
using test::has_note;
using test::kTetra;
using test::read_deck;

constexpr double kSumRounding = 1e-12;  // sums of ten terms of the size of the result

double cubed(double t) { return t * t * t; }

/// ∫y² of a rectangle, b wide and h high, about its centre.
double second_moment(double b, double h) { return b * cubed(h) / 12; }

TEST(NastranShapes, i_section_of_equal_flanges) {
  const double h = 10, b = 6, tw = 0.5, tf = 0.75, hw = h - 2 * tf;
  const auto c = nastran_shape("I", {h, b, b, tw, tf, tf});
  EXPECT_NEAR(c.A, b * h - (b - tw) * hw, kSumRounding * c.A);
  EXPECT_NEAR(c.I1, second_moment(b, h) - second_moment(b - tw, hw), kSumRounding * c.I1);
  EXPECT_NEAR(c.I2, 2 * second_moment(tf, b) + second_moment(hw, tw), kSumRounding * c.I2);
  EXPECT_EQ(c.I12, 0.0);
  EXPECT_NEAR(c.J, (2 * b * cubed(tf) + (h - tf) * cubed(tw)) / 3, kSumRounding * c.J);
  EXPECT_NEAR(c.y, 0.0, kSumRounding * h);  // the shear centre is the centroid
  const auto same = nastran_shape("I1", {b - tw, tw, hw, h});
  EXPECT_NEAR(same.I1, c.I1, kSumRounding * c.I1);
  EXPECT_NEAR(same.J, c.J, kSumRounding * c.J);
}

TEST(NastranShapes, t_sections_stand_and_hang) {
  const double b = 8, h = 6, tf = 1, tw = 0.5;
  const auto c = nastran_shape("T", {b, h, tf, tw});
  const double A = b * h - (b - tw) * (h - tf);
  // From the top: the rectangle less what is missing beside the web.
  const double y = (b * h * h / 2 - (b - tw) * (h - tf) * (tf + (h - tf) / 2)) / A;
  const double about_top = b * cubed(h) / 3 - (b - tw) * (cubed(h) - cubed(tf)) / 3;
  EXPECT_NEAR(c.A, A, kSumRounding * A);
  EXPECT_NEAR(c.I1, about_top - A * y * y, 1e-11 * c.I1);
  EXPECT_NEAR(c.I2, second_moment(tf, b) + second_moment(h - tf, tw), kSumRounding * c.I2);
  EXPECT_NEAR(c.J, (b * cubed(tf) + (h - tf / 2) * cubed(tw)) / 3, kSumRounding * c.J);
  // The shear centre lies in the flange, the centroid below it.
  EXPECT_NEAR(c.y, tf / 2 - y, 1e-11 * h);
  EXPECT_NEAR(nastran_shape("T2", {b, h, tf, tw}).y, -c.y, 1e-11 * h);
  const auto lying = nastran_shape("T1", {b, h - tf, tf, tw});
  EXPECT_NEAR(lying.I2, c.I1, 1e-11 * c.I1);
  EXPECT_NEAR(lying.I1, c.I2, 1e-11 * c.I2);
}

TEST(NastranShapes, channels_lie_and_stand) {
  const double b = 4, h = 10, tw = 0.5, tf = 0.75;
  const auto c = nastran_shape("CHAN", {b, h, tw, tf});
  const double hole = h - 2 * tf, A = b * h - (b - tw) * hole;
  const double z = (b * h * b / 2 - (b - tw) * hole * (tw + (b - tw) / 2)) / A;
  const double about_back = h * cubed(b) / 3 - hole * (cubed(b) - cubed(tw)) / 3;
  EXPECT_NEAR(c.A, A, kSumRounding * A);
  EXPECT_NEAR(c.I1, second_moment(b, h) - second_moment(b - tw, hole), kSumRounding * c.I1);
  EXPECT_NEAR(c.I2, about_back - A * z * z, 1e-11 * c.I2);
  // Thin walls: e = b² h² t / (4 I1) behind the middle of the web, here with I1 of middle lines.
  const double bm = b - tw / 2, hm = h - tf;
  const double thin = 2 * bm * tf * hm * hm / 4 + tw * cubed(hm) / 12;
  EXPECT_NEAR(c.z - z + tw / 2, bm * bm * hm * hm * tf / (4 * thin), 1e-11 * b);
  const auto same = nastran_shape("CHAN1", {b - tw, tw, hole, h});
  EXPECT_NEAR(same.I2, c.I2, kSumRounding * c.I2);
  const auto trough = nastran_shape("CHAN2", {tf, tw, b, h});
  EXPECT_NEAR(trough.I1, c.I2, 1e-11 * c.I2);
  EXPECT_NEAR(trough.I2, c.I1, 1e-11 * c.I1);
}

TEST(NastranShapes, angle_and_zed_have_a_product_of_inertia) {
  const double b = 6, h = 8, t1 = 0.75, t2 = 0.5;
  const auto c = nastran_shape("L", {b, h, t1, t2});
  const double A = b * h - (b - t2) * (h - t1);
  const double y = (b * h * h / 2 - (b - t2) * (h - t1) * (h + t1) / 2) / A;
  const double z = (b * h * b / 2 - (b - t2) * (h - t1) * (b + t2) / 2) / A;
  const double yz = b * b * h * h / 4 - (b * b - t2 * t2) * (h * h - t1 * t1) / 4;
  EXPECT_NEAR(c.A, A, kSumRounding * A);
  EXPECT_NEAR(c.I12, yz - A * y * z, 1e-11 * c.I1);
  EXPECT_LT(c.I12, 0.0);
  EXPECT_NEAR(c.y, y - t1 / 2, 1e-11 * h);
  EXPECT_NEAR(c.z, z - t2 / 2, 1e-11 * h);
  const double flange = 3, tw = 0.5, tf = 0.75;
  const auto zed = nastran_shape("Z", {flange, tw, h - 2 * tf, h});
  const double width = 2 * flange + tw;
  EXPECT_NEAR(zed.I1,
              second_moment(width, h) - 2 * second_moment(flange, h - 2 * tf) -
                  2 * flange * tf * std::pow((h - tf) / 2, 2) - 2 * second_moment(flange, tf),
              1e-11 * zed.I1);
  EXPECT_NEAR(zed.I12, -2 * flange * tf * (h - tf) / 2 * (tw + flange) / 2, 1e-11 * zed.I1);
}

TEST(NastranShapes, other_shapes) {
  const auto cross = nastran_shape("CROSS", {6, 1, 8, 0.5});
  EXPECT_NEAR(cross.I1, second_moment(1, 8) + second_moment(6, 0.5), kSumRounding * cross.I1);
  EXPECT_NEAR(cross.I2, second_moment(8, 1) + second_moment(0.5, 7) - second_moment(0.5, 1),
              1e-11 * cross.I2);
  const auto h = nastran_shape("H", {5, 2, 8, 0.5});
  EXPECT_NEAR(h.I2, second_moment(8, 7) - second_moment(7.5, 5), 1e-11 * h.I2);
  const auto box = nastran_shape("BOX1", {6, 8, 0.5, 0.5, 0.25, 0.25});
  EXPECT_NEAR(box.I1, second_moment(6, 8) - second_moment(5.5, 7), 1e-11 * box.I1);
  EXPECT_NEAR(box.J, 4 * std::pow(5.75 * 7.5, 2) / (2 * 5.75 / 0.5 + 2 * 7.5 / 0.25),
              1e-11 * box.J);
  const auto hat = nastran_shape("HAT", {5, 0.5, 6, 2});
  EXPECT_NEAR(hat.A, 0.5 * (6 + 2 * (2 + 0.5) + 2 * 4), kSumRounding * hat.A);
  EXPECT_NEAR(hat.I2,
              second_moment(0.5, 6) + second_moment(4, 6) - second_moment(4, 5) +
                  second_moment(0.5, 10) - second_moment(0.5, 5),
              1e-11 * hat.I2);
  // A regular hexagon of side 1: every axis through its centre has 5√3/16.
  const double root = std::sqrt(3.0);
  const auto hexagon = nastran_shape("HEXA", {0.5, 2, root});
  EXPECT_NEAR(hexagon.A, 1.5 * root, kSumRounding);
  EXPECT_NEAR(hexagon.I1, 5 * root / 16, kSumRounding);
  EXPECT_NEAR(hexagon.I2, 5 * root / 16, kSumRounding);
  // Its torsion constant is 1.0355 (Young and Budynas, Roark's Formulas, table 10.7: 0.1154 d⁴ with
  // d = √3); Saint-Venant's approximation is within 2 %.
  EXPECT_NEAR(hexagon.J, 0.1154 * 9, 0.02 * 0.1154 * 9);
}

TEST(NastranShapes, plates_must_fit) {
  EXPECT_EQ(nastran_shape("I", {1, 1, 1, 0.1, 0.5, 0.5}).A, 0.0);
  EXPECT_EQ(nastran_shape("HEXA", {1, 2, 1}).A, 0.0);
  EXPECT_EQ(nastran_shape("CHAN", {1, 1, 0.1, 0.5}).A, 0.0);
  EXPECT_EQ(nastran_shape("BOX1", {1, 1, 0.1, 0.1, 0.5, 0.5}).A, 0.0);
}

const std::string kBeam = "GRID,1\nGRID,2,,2.\nMAT1,1,1.,,.3\nMAT1,2,1.,1.,.3,5.\n";

TEST(NastranSections, shapes_reach_the_section) {
  const auto mesh =
      read_deck(kBeam + "CBAR,1,1,1,2,0.,1.,0.\nPBARL,1,1,,I\n,10.,6.,6.,.5,.75,.75\n");
  const auto section = std::get<fem::GeneralSectionSpec>(mesh.properties.at(0).section->shape);
  // Plane 1 holds the height: I1 is Iz.
  EXPECT_NEAR(section.Iz, second_moment(6, 10) - second_moment(5.5, 8.5), 1e-11 * section.Iz);
  EXPECT_TRUE(mesh.rigid_links.empty());
}

TEST(NastranSections, beams_lie_in_the_neutral_axis) {
  const auto mesh = read_deck(kBeam + "CBEAM,1,1,1,2,0.,1.,0.\nPBEAML,1,1,,T\n,8.,6.,1.,.5\n");
  ASSERT_EQ(mesh.rigid_links.size(), 2u);
  const double A = 8 + 2.5, below = 2.5 * 3 / A;  // web centre from the middle of the flange
  EXPECT_LT((mesh.positions.at(2) - Eigen::Vector3d(0, -below, 0)).norm(), 1e-14);
  EXPECT_TRUE(has_note(mesh, "neutral axis"));
  // N1(A) on the third line behind the stations; PBEAM: A, I1, I2, I12, J.
  const auto given = read_deck(kBeam +
                               "CBEAM,1,1,1,2,0.,1.,0.\n"
                               "PBEAM,1,1,1.,1.,1.,,1.\n,,,,,,,,,\n"
                               ",,,,,,,,,\n,,,,,.25,.5\n");
  EXPECT_LT((given.positions.at(2) - Eigen::Vector3d(0, 0.25, 0.5)).norm(), 1e-14);
}

TEST(NastranSections, what_is_missing_is_left_to_the_model_file) {
  const auto mesh = read_deck(kTetra +
                              "CTETRA,2,7,1,2,3,4\nCTRIA3,3,8,1,2,3\n"
                              "PSOLID,9,5\nCTETRA,4,9,1,2,3,4\n"
                              "CBAR,5,6,1,2,0.,0.,1.\nPBAR,6,1,1.,1.,1.\n"
                              "CBAR,6,7,1,2,0.,0.,1.\nPBARL,7,1,,DBOX\n,1.\n");
  const std::vector<std::string> lacking = {"",      "no PSOLID 7", "no PSHELL 8", "no material 5",
                                            "J = 0", "\"DBOX\""};
  ASSERT_EQ(mesh.properties.size(), lacking.size());
  EXPECT_EQ(mesh.properties[0].lacking, "");
  for (std::size_t i = 1; i < lacking.size(); ++i) {
    expect_words(mesh.properties[i].lacking, {lacking[i]});
    EXPECT_FALSE(mesh.properties[i].section.has_value());
    EXPECT_TRUE(has_note(mesh, lacking[i]));
  }
}

TEST(NastranSections, an_area_alone_is_a_bar) {
  const auto mesh = read_deck(kBeam +
                              "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,3.\n"
                              "CTUBE,2,2,1,2\nPTUBE,2,1,4.,.5\n");
  for (const std::size_t i : {0, 1}) EXPECT_EQ(mesh.properties.at(i).kind, fem::PropertyKind::bar);
  EXPECT_EQ(std::get<fem::TubeSpec>(mesh.properties[1].section->shape).inner(), 3.0);
}

TEST(NastranMaterials, a_rounded_modulus_is_that_of_beams_alone) {
  const auto mesh = read_deck(kTetra +
                              "MAT1,2,1.+7,3.8462+6,.3,.1\nPSOLID,2,2\nCTETRA,2,2,1,2,3,4\n"
                              "PBAR,3,2,1.,1.,1.,1.\nCBAR,3,3,1,2,0.,0.,1.\n");
  EXPECT_FALSE(mesh.materials.at(1).G.has_value());
  EXPECT_EQ(mesh.materials.at(2).G.value_or(0), 3.8462e6);
  EXPECT_EQ(mesh.materials[2].rho, 0.1);
  EXPECT_NE(mesh.materials[1].name, mesh.materials[2].name);
  EXPECT_EQ(mesh.properties.at(2).material, mesh.materials[2].name);
  EXPECT_FALSE(has_note(mesh, "a G that does not follow"));
  const auto other = read_deck(kTetra + "MAT1,2,1.+7,3.+6,.3\nPSHELL,2,2,1.\nCTRIA3,2,2,1,2,3\n");
  EXPECT_TRUE(has_note(other, "a G that does not follow"));
}

TEST(NastranMaterials, ratios_that_bars_do_not_need) {
  const auto mesh = read_deck(kTetra +
                              "MAT1,2,2.,,3.\nCONROD,2,1,2,2,1.\nMAT1,3,2.\n"
                              "PSOLID,3,3\nCTETRA,3,3,1,2,3,4\n");
  EXPECT_EQ(mesh.materials.at(1).E, 2.0);
  EXPECT_TRUE(has_note(mesh, "Poisson's ratios"));
  EXPECT_EQ(mesh.materials.at(2).nu, 0.0);  // of E alone, as Nastran has it
}

TEST(NastranMaterials, a_plane_stiffness_is_orthotropic) {
  // E1 = 4, E2 = 1, nu12 = 0.5: C = E/(1 - nu12 nu21), nu21 = 0.125.
  const double factor = 1 / (1 - 0.5 * 0.125);
  const auto mesh = read_deck(
      kTetra +
      fmt::format("MAT2,2,{:.9g},{:.9g},,{:.9g},,.25,3.\n", 4 * factor, 0.5 * factor, factor) +
      "PSHELL,2,2,.1,2\nCTRIA3,2,2,1,2,3\n");
  const auto& o = mesh.materials.at(1).orthotropic.value();
  EXPECT_NEAR(o.E1, 4, 1e-7);  // nine digits of the card
  EXPECT_NEAR(o.E2, 1, 1e-7);
  EXPECT_NEAR(o.nu12, 0.5, 1e-7);
  EXPECT_EQ(o.G12, 0.25);
  EXPECT_EQ(mesh.materials[1].rho, 3.0);
}

}  // namespace
}  // namespace buckens::mesh_io

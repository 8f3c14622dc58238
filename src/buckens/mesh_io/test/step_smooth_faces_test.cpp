// SPDX-License-Identifier: Apache-2.0
// Smooth faces in place of folded ones. The library works in a process of its own.
#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/files/isolated_work.h"
#include "buckens/files/output_file.h"
#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/shapes.h"
#include "buckens/mesh_io/step/smooth_faces.h"

namespace buckens::mesh_io {
namespace {

/// For each face of a box of the test assembly whether, with a smooth one in its place, numbers,
/// areas and volumes are the same and elements fill it.
std::string replaced_one_by_one(const std::string& solid) {
  const std::string file =
      std::string(buckens::test::kSourceDirectory) + "/tests/parts/assembly.step";
  std::string out;
  std::size_t count = 0;
  for (std::size_t k = 0; k == 0 || k < count; ++k) {
    const files::IsolatedResult result = files::do_isolated([&] {
      GmshLibrary gmsh;
      gmsh.set_text("Geometry.OCCTargetUnit", "MM");
      load_part(gmsh, "part", file, {solid, {}});
      const auto faces = gmsh.entities(2);
      const double volume = gmsh.size(gmsh.entities(3).at(0));
      const double area = gmsh.size(faces[k]);
      const std::string head = fmt::format("{} ", faces.size());
      if (smooth_folded_faces(gmsh, {faces[k].second}, 1000).empty()) return head + "kept ";
      const bool is_same = gmsh.entities(2) == faces && gmsh.entities(3).size() == 1 &&
                           std::abs(gmsh.size(faces[k]) / area - 1) < 1e-6 &&
                           std::abs(gmsh.size(gmsh.entities(3)[0]) / volume - 1) < 1e-6;
      gmsh.mesh(3);
      const bool has_mesh = !gmsh.element_nodes(4, -1).empty() && gmsh.messages().empty();
      return head + (is_same && has_mesh ? "new " : "wrong ");
    });
    EXPECT_TRUE(result.is_complete) << k;
    count = std::stoul("0" + result.output);
    out += result.output.substr(result.output.find(' ') + 1);
  }
  return out;
}

TEST(StepSmoothFaces, plane_faces_stay_where_they_are) {
  EXPECT_EQ(replaced_one_by_one("plate"), "new new new new new new ");
}

/// What comes of the box whose top folds at an edge: its inner points at this height in the file,
/// which is 40 where the top is plane.
std::string replaced_top(const std::string& height) {
  std::string text = files::read_text_file(std::string(buckens::test::kSourceDirectory) +
                                           "/tests/parts/folded.step");
  for (const char* y : {"20", "40"}) {
    const std::string point = fmt::format("(66.666666666667,{}.,", y);
    const std::size_t at = text.find(point + "40.)");
    text.replace(at + point.size(), 3, height);
  }
  const buckens::test::TemporaryDirectory directory;
  const std::string file = directory.path() / "folded.step";
  std::ofstream(file) << text;
  const files::IsolatedResult result = files::do_isolated([&]() -> std::string {
    GmshLibrary gmsh;
    gmsh.set_text("Geometry.OCCTargetUnit", "MM");
    load_part(gmsh, "part", file, {});
    gmsh.set_number("Mesh.Algorithm", 1);
    gmsh.set_number("Mesh.MeshSizeMax", 10);
    gmsh.mesh(2);
    const auto folded = folded_faces(gmsh);
    if (folded.empty()) return "no face folds";
    try {
      const std::string note = smooth_folded_faces(gmsh, folded, 1000);
      gmsh.mesh(3);
      if (!folded_faces(gmsh).empty()) return "folds again";
      return fmt::format("{:.0f} mm3, {}", gmsh.size(gmsh.entities(3).at(0)), note);
    } catch (const IoError& error) {
      return error.what();
    }
  });
  EXPECT_TRUE(result.is_complete);
  return result.output;
}

TEST(StepSmoothFaces, a_fold_is_found_and_replaced) {
  EXPECT_EQ(
      replaced_top("40."),
      "240000 mm3, note the surface of face 1 folds at an edge and was replaced by a smooth one "
      "through the same edges\n");
}

TEST(StepSmoothFaces, a_bulge_is_followed_through_points_of_the_face) {
  // Below the surface of Bézier: 240000 mm³ and 894 for each millimetre of the two points.
  const std::string told = replaced_top("44.");
  EXPECT_NE(told.find("the same edges and some of its points"), std::string::npos) << told;
  EXPECT_NEAR(std::strtod(told.c_str(), nullptr), 240000 + 894 * 4, 1e-3 * 243576) << told;
}

TEST(StepSmoothFaces, a_bulge_is_not_cut_off) {
  const std::string told = replaced_top("60.");
  EXPECT_NE(told.find("face 1 around (0.05"), std::string::npos) << told;
  EXPECT_NE(told.find("9 of its points changes the volume by -0.2"), std::string::npos) << told;
  EXPECT_NE(told.find("rebuild it from its edges by a fill or loft"), std::string::npos) << told;
  const std::string far = replaced_top("70.");
  EXPECT_NE(far.find("face 1 around (0.05"), std::string::npos) << far;
  EXPECT_NE(far.find("rebuild it from its edges by a fill or loft"), std::string::npos) << far;
}

TEST(StepSmoothFaces, nothing_to_replace) {
  const files::IsolatedResult result = files::do_isolated([] {
    GmshLibrary gmsh;
    return fmt::format("[{}{}]", smooth_folded_faces(gmsh, {}, 1000), folded_faces(gmsh).size());
  });
  EXPECT_EQ(result.output, "[0]");
}

}  // namespace
}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
// Smooth faces in place of folded ones. The library works in a process of its own.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/base/test/source_directory.h"
#include "buckens/files/isolated_work.h"
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
      if (smooth_folded_faces(gmsh, {faces[k].second}).empty()) return head + "kept ";
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

TEST(StepSmoothFaces, nothing_to_replace) {
  const files::IsolatedResult result = files::do_isolated([] {
    GmshLibrary gmsh;
    return fmt::format("[{}{}]", smooth_folded_faces(gmsh, {}), folded_faces(gmsh).size());
  });
  EXPECT_EQ(result.output, "[0]");
}

}  // namespace
}  // namespace buckens::mesh_io

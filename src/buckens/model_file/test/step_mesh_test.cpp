// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/fem/mesh/report.h"
#include "buckens/files/isolated_work.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/step/mesh.h"
#include "buckens/mesh_io/step/text.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/step_mesh_cache.h"

namespace buckens::model_file {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kRod =
    std::filesystem::path(buckens::test::kSourceDirectory) / "examples/connecting_rod/rod.step";

fem::GeometryFaceSpec face(const std::string& name, decltype(fem::GeometryFaceSpec::selection) by) {
  fem::GeometryFaceSpec out;
  out.name = name;
  out.selection = std::move(by);
  return out;
}

template <class Spec>
std::string refusal(const fem::GeometrySpec& part, Spec spec) {
  fem::GeometrySpec with = part;
  with.size = 0.03;
  spec.where = {"rod.yaml", 7, 3};
  with.faces = {face("wrong", spec)};
  try {
    StepMeshCache().mesh(kRod, with);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

int count_of(const fem::MeshReport& report, const std::string& name) {
  for (const auto& set : report.face_sets) {
    if (set.name == name) return set.count;
  }
  return -1;
}

TEST(StepMesh, MeshesInMetresAndNamesFaces) {
  fem::GeometrySpec part;
  part.size = 0.012;
  fem::SphereSelection ball;
  ball.center = {0.3, 0, 0};
  ball.radius = 0.013;
  part.faces = {face("red", fem::FaceColorSpec{{}, {255, 0, 0}}),
                face("end", fem::FaceLabelSpec{{}, "small bore"}), face("ball", ball)};
  const fem::ImportedMesh mesh = *StepMeshCache().mesh(kRod, part);
  const fem::MeshReport report = fem::report_mesh(mesh, true);
  EXPECT_EQ(report.inverted.size(), 0u);
  EXPECT_EQ(report.pieces, 1);
  EXPECT_NEAR(report.box.sizes().x(), 0.337, 1e-4);
  EXPECT_EQ(mesh.properties[0].name, "rod");
  EXPECT_GT(count_of(report, "red"), 0);
  EXPECT_EQ(count_of(report, "red"), count_of(report, "big bore"));
  EXPECT_EQ(count_of(report, "red"), count_of(report, "color_255_0_0"));
  EXPECT_EQ(count_of(report, "end"), count_of(report, "color_0_0_255"));
  EXPECT_EQ(count_of(report, "ball"), count_of(report, "end"));

  EXPECT_THAT(refusal(part, fem::FaceColorSpec{{}, {0, 255, 0}}),
              HasSubstr("there are [0, 0, 255], [255, 0, 0]"));
  EXPECT_THAT(refusal(part, fem::FaceLabelSpec{{}, "big bor"}),
              HasSubstr("Did you mean \"big bore\"?"));
  EXPECT_THAT(refusal(part, fem::FaceNumbersSpec{{}, {99}}), HasSubstr("rod.yaml:7:3: the part has "
                                                                       "no face 99"));
  ball.radius = 0.001;
  EXPECT_THAT(refusal(part, ball), HasSubstr("no face of the part lies wholly here"));
}

/// A plate, a pin that stands on it, and a block that touches neither; see tests/parts.
TEST(StepMesh, GluesSolidsThatTouchAndKeepsNamesOfFacesThatAreCut) {
  const std::filesystem::path file =
      std::filesystem::path(buckens::test::kSourceDirectory) / "tests/parts/assembly.step";
  const fem::ImportedMesh mesh = mesh_io::mesh_step(file, {0.006, 1, ""});
  const fem::MeshReport report = fem::report_mesh(mesh, true);
  EXPECT_EQ(report.pieces, 2);
  EXPECT_THAT(report.duplicate_nodes, testing::IsEmpty());
  EXPECT_NEAR(report.volume, 11e-6, 1e-15);
  std::vector<std::string> solids;
  for (const auto& property : report.properties) solids.push_back(property.name);
  EXPECT_THAT(solids, testing::UnorderedElementsAre("plate", "pin", "block"));
  std::map<std::string, double> areas;
  for (const auto& set : report.face_sets) areas[set.name] = set.area;
  EXPECT_NEAR(areas.at("wall"), 200e-6, 1e-15);
  EXPECT_NEAR(areas.at("color_255_0_0"), 200e-6, 1e-15);
  EXPECT_NEAR(areas.at("seat"), 200e-6, 1e-15) << "cut into three by the pin";
  EXPECT_NEAR(areas.at("Stirnfl\u00e4che"), 100e-6, 1e-15);
  EXPECT_NEAR(areas.at("it's below"), 100e-6, 1e-15);
  EXPECT_NEAR(areas.at("color_0_255_0"), 200e-6, 1e-15);
  EXPECT_NEAR(areas.at("color_0_0_255"), 100e-6, 1e-15);
  EXPECT_THAT(mesh.notes, testing::IsEmpty());
}

TEST(StepMesh, IsMadeOnceForVariantsAndBodiesOfOnePart) {
  StepMeshCache cache;
  const std::filesystem::path model = kRod.parent_path() / "connecting_rod.yaml";
  const auto read = [&](const std::string& change) {
    return read_model_file(model, {"parameters.size=30 mm", change}, cache);
  };
  read("parameters.speed=100");
  EXPECT_EQ(cache.num_meshed(), 1);
  const auto other = read("parameters.speed=120");
  EXPECT_EQ(cache.num_meshed(), 1);
  const auto& rod = std::get<fem::GeometrySpec>(other.bodies.at(1).kind);
  EXPECT_EQ(rod.imported->face_sets.back().name, "small")
      << "faces of the model are named each time";
  read("bodies.rod.geometry.size=40 mm");
  EXPECT_EQ(cache.num_meshed(), 2);
  read("bodies.rod.geometry.order=1");
  EXPECT_EQ(cache.num_meshed(), 3);
  read("parameters.r=100 mm");
  EXPECT_EQ(cache.num_meshed(), 3);
}

std::string message_of(const std::string& step, double size = 0.01) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("buckens_step_test_" + std::to_string(::getpid()) + ".step");
  std::ofstream(path) << step;
  std::string out;
  try {
    mesh_io::mesh_step(path, {size, 2, ""});
  } catch (const InputError& error) {
    out = error.what();
  }
  std::filesystem::remove(path);
  return out;
}

TEST(StepMesh, SaysWhatIsWrong) {
  const std::string step = files::read_text_file(kRod, "part");
  EXPECT_THAT(message_of(""), HasSubstr("not a STEP file"));
  EXPECT_THAT(message_of("solid ascii\nfacet"), HasSubstr("not a STEP file"));
  EXPECT_THAT(message_of(step.substr(0, step.size() / 2)), HasSubstr("is truncated"));
  EXPECT_THAT(message_of("ISO-10303-21;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"),
              HasSubstr("cannot be meshed: Could not read file 'buckens_step_test"));
  EXPECT_THAT(message_of(step, 1e-6), HasSubstr("give a larger size"));
  // Data are missing in the middle: whatever OpenCASCADE does with it, this process continues.
  std::string hole = step;
  hole.erase(step.size() / 3, step.size() / 3);
  message_of(hole, 0.03);
}

TEST(StepText, ColoursStandForNames) {
  const std::string step =
      "ISO-10303-21;\nDATA;\n#1=ADVANCED_FACE('a ''b''',(#5),#6,.T.);\n"
      "#2 = ADVANCED_FACE ( 'NONE',(#7),#6,.T.);\n#3=ADVANCED_FACE('c;d',(#8),#6,.T.);\n"
      "#4=STYLED_ITEM('',(#9),#1);\n#10=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#1),#12);\n"
      "ENDSEC;\nEND-ISO-10303-21;\n";
  const mesh_io::ColoredStep copy = mesh_io::color_named_faces(step);
  EXPECT_THAT(copy.names, ElementsAre("a 'b'", "c;d"));
  EXPECT_THAT(copy.text, HasSubstr("#4=IGNORED_ONE('',(#9),#1)"));
  EXPECT_THAT(copy.text, HasSubstr("STYLED_ITEM('',(#17),#1)"));
  EXPECT_THAT(copy.text, HasSubstr("(#18,#26),#12)"));
  EXPECT_TRUE(mesh_io::color_named_faces("ISO-10303-21;\nDATA;\nENDSEC;\n").names.empty());
  EXPECT_EQ(mesh_io::name_of_color({4, 4, 4}, 10), 0);
  EXPECT_EQ(mesh_io::name_of_color({12, 4, 4}, 10), 1);
  EXPECT_EQ(mesh_io::name_of_color({4, 12, 4}, 10), -1);
  for (int shown = 40; shown < 256; ++shown) {
    const int linear = static_cast<int>(std::lround(mesh_io::linear_color(shown)));
    EXPECT_NEAR(mesh_io::shown_color(linear), shown, 2)
        << shown;  // steps of the linear scale are coarser
  }
}

TEST(StepText, LooksNoFurtherThanEachEntity) {
  // Two million invalid entities: searching the rest of the file for each would take hours.
  const std::string empty(2'000'000, ';');
  EXPECT_TRUE(mesh_io::color_named_faces("ISO-10303-21;\nDATA;\n" + empty).names.empty());
  std::string wrong;
  for (int k = 0; k < 400'000; ++k) wrong += "#1;";
  EXPECT_TRUE(mesh_io::color_named_faces("ISO-10303-21;\nDATA;\n" + wrong).names.empty());
}

TEST(IsolatedWork, OutlivesWhateverHappens) {
  EXPECT_EQ(files::do_isolated([] { return std::string(300000, 'x'); }).output.size(), 300000u);
  const files::IsolatedResult crashed = files::do_isolated([]() -> std::string {
    std::raise(SIGSEGV);
    return "never";
  });
  EXPECT_FALSE(crashed.is_complete);
  EXPECT_EQ(crashed.signal, SIGSEGV);
  EXPECT_TRUE(crashed.output.empty());
  EXPECT_FALSE(
      files::do_isolated([]() -> std::string { throw std::runtime_error("no"); }).is_complete);
  EXPECT_FALSE(files::do_isolated([]() -> std::string { ::_exit(0); }).is_complete);
}

}  // namespace
}  // namespace buckens::model_file

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/glued_part.h"

#include <fmt/format.h>

#include "buckens/base/stopwatch.h"
#include "buckens/mesh_io/step/progress.h"
#include "buckens/mesh_io/step/text.h"

namespace buckens::mesh_io {

namespace {

constexpr const char kModel[] = "part";

std::string lost(const GluedShapes& shapes, const char* what) {
  if (shapes.lost == 0) return {};
  return fmt::format(
      "note {} of {} faces are lost where solids cut them; choose these faces by "
      "numbers or place\n",
      what, shapes.lost);
}

}  // namespace

GluedPart::GluedPart(const StepTask& task, bool in_millimetres) : in_millimetres_(in_millimetres) {
  base::Stopwatch watch;
  gmsh_.be_heard();
  gmsh_.set_text("Geometry.OCCTargetUnit", in_millimetres ? "MM" : "M");
  problem_ = load_part(gmsh_, kModel, task.step, task.request.solid);
  if (!problem_.empty()) return;
  times_ = time_line("read", watch.lap());
  const std::size_t num_solids = gmsh_.entities(3).size();
  if (num_solids > 1) say_gluing(num_solids);
  const GluedShapes shapes = glue_solids(gmsh_);
  if (num_solids > 1) times_ += time_line("gluing", watch.lap());
  faces_ = lost(shapes, "colours");
  if (!shapes.overlaps.empty()) {
    const auto& [first, second] = shapes.overlaps.front();
    overlap_ = fmt::format("(\"{}\" and \"{}\"{})", first, second,
                           shapes.overlaps.size() > 1
                               ? fmt::format(", {} places in all", shapes.overlaps.size())
                               : "");
    faces_ += fmt::format(
        "note solids overlap {}: what they have in common is counted once and is a solid of its "
        "own, named after one of them or volume_<number>\n",
        overlap_);
  }
  for (const auto& [face, color] : shapes.colors) {
    faces_ += fmt::format("color {} {} {} {}\n", face, color.red, color.green, color.blue);
  }
  if (task.num_names > 0) faces_ += labels(task, shapes);
  times_ += time_line("names", watch.lap());
}

/// Colours of the copy in which they stand for names.
std::string GluedPart::labels(const StepTask& task, const GluedShapes& shapes) {
  const GluedShapes copy =
      colors_of_copy(gmsh_, kModel, shapes, task.named_copy, task.request.solid);
  std::string out;
  for (const ColoredShape& face : copy.colors) {
    const auto& color = face.color;
    const int name = name_of_color({color.red, color.green, color.blue}, task.num_names);
    if (name >= 0) out += fmt::format("label {} {}\n", face.face, name);
  }
  return out + lost(copy, "names");
}

}  // namespace buckens::mesh_io

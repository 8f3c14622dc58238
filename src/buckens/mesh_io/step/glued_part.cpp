// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/glued_part.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/stopwatch.h"
#include "buckens/mesh_io/step/progress.h"
#include "buckens/mesh_io/step/text.h"

namespace buckens::mesh_io {

namespace {

constexpr const char kModel[] = "part";

std::string lost(const GluedShapes& shapes, const char* what) {
  if (shapes.lost == 0) return {};
  return fmt::format(
      "note {} of {} faces were lost where solids cut them; choose these faces by numbers or "
      "place\n",
      what, shapes.lost);
}

}  // namespace

GluedPart::GluedPart(const StepTask& task, bool in_millimetres,
                     const std::vector<std::size_t>& without)
    : in_millimetres_(in_millimetres), choice_{task.request.solid, without} {
  base::Stopwatch watch;
  gmsh_.be_heard();
  gmsh_.set_text("Geometry.OCCTargetUnit", in_millimetres ? "MM" : "M");
  problem_ = load_part(gmsh_, kModel, task.step, {task.request.solid, {}});
  if (!problem_.empty()) return;
  if (!without.empty()) leave_out();
  times_ = time_line("read", watch.lap());
  const std::size_t num_solids = gmsh_.entities(3).size();
  if (num_solids > 1) say_gluing(num_solids);
  const GluedShapes shapes = glue_solids(gmsh_);
  if (num_solids > 1) times_ += time_line("gluing", watch.lap());
  faces_ += lost(shapes, "colours");
  tell_overlaps(shapes);
  for (const auto& [face, color] : shapes.colors) {
    faces_ += fmt::format("color {} {} {} {}\n", face, color.red, color.green, color.blue);
  }
  if (task.num_names > 0) faces_ += labels(task, shapes);
  times_ += time_line("names", watch.lap());
}

void GluedPart::leave_out() {
  const auto solids = gmsh_.entities(3);
  double all = 0, left_out = 0;
  for (const GmshEntity& solid : solids) all += std::abs(gmsh_.size(solid));
  std::vector<std::string> names;
  std::vector<GmshEntity> others;
  for (const std::size_t place : choice_.without) {
    others.push_back(solids.at(place));
    names.push_back(fmt::format("\"{}\"", label_of_solid(gmsh_, others.back())));
    left_out += std::abs(gmsh_.size(others.back()));
  }
  gmsh_.remove(others);
  faces_ += fmt::format(
      "note solids that overlap larger ones and cannot be meshed with them were left out: {}, "
      "{:.2g} % of the volume. This body lacks their mass: give it as `masses`, or make them "
      "separate bodies by `solid`\n",
      fmt::join(names, ", "), 100 * left_out / all);
}

void GluedPart::tell_overlaps(const GluedShapes& shapes) {
  if (shapes.overlaps.empty()) return;
  const auto& [first, second] = shapes.overlaps.front();
  overlap_ = fmt::format(
      "(\"{}\" and \"{}\"{})", shapes.labels[first], shapes.labels[second],
      shapes.overlaps.size() > 1 ? fmt::format(", {} places in all", shapes.overlaps.size()) : "");
  double all = 0, smaller = 0;
  for (const double volume : shapes.volumes) all += volume;
  smaller_ = smaller_of_overlapping(shapes);
  for (const std::size_t place : smaller_) smaller += shapes.volumes[place];
  smaller_share_ = smaller / all;
  faces_ += fmt::format(
      "note solids overlap {}: their common volume is counted once and becomes a separate solid, "
      "named after one of them or volume_<number>\n",
      overlap_);
}

/// Colours of the copy in which they stand for names.
std::string GluedPart::labels(const StepTask& task, const GluedShapes& shapes) {
  const GluedShapes copy = colors_of_copy(gmsh_, kModel, shapes, task.named_copy, choice_);
  std::string out;
  for (const ColoredShape& face : copy.colors) {
    const auto& color = face.color;
    const int name = name_of_color({color.red, color.green, color.blue}, task.num_names);
    if (name >= 0) out += fmt::format("label {} {}\n", face.face, name);
  }
  return out + lost(copy, "names");
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_sections.h"

#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

void write_sections(const Hdf5File& file, const std::string& path,
                    const results::GeometryBody& body) {
  if (body.sections.empty()) return;
  std::vector<int> loops, numbers;
  std::vector<double> points, axes;
  for (std::size_t s = 0; s < body.sections.size(); ++s) {
    if (body.sections[s].empty()) loops.insert(loops.end(), {static_cast<int>(s), 0});
    for (const fem::SectionLoop& loop : body.sections[s]) {
      loops.insert(loops.end(), {static_cast<int>(s), static_cast<int>(loop.size())});
      for (const Eigen::Vector2d& p : loop) points.insert(points.end(), {p.x(), p.y()});
    }
  }
  for (const auto& ends : body.element_sections) {
    numbers.insert(numbers.end(), ends.begin(), ends.end());
  }
  for (const Eigen::Vector3d& y : body.element_y) axes.insert(axes.end(), {y.x(), y.y(), y.z()});
  write_dataset(file, path + "/section_loops", {loops.size() / 2, 2}, loops);
  write_dataset(file, path + "/section_points", {points.size() / 2, 2}, points);
  write_attribute(file, path + "/section_points", "unit", std::string("m"));
  write_dataset(file, path + "/element_sections", {numbers.size() / 2, 2}, numbers);
  write_dataset(file, path + "/element_y", {axes.size() / 3, 3}, axes);
}

void read_sections(const Hdf5File& file, const std::string& path, results::GeometryBody& body) {
  if (!has_object(file, path + "/section_loops")) return;
  const auto expect = [&](bool holds) {
    if (holds) return;
    throw IoError(fmt::format("{}: the cross-sections of {} do not fit together.",
                              file.path().string(), path));
  };
  const std::vector<int> loops = read_int_dataset(file, path + "/section_loops", 2);
  const std::vector<double> points = read_double_dataset(file, path + "/section_points", 2);
  const std::vector<int> numbers = read_int_dataset(file, path + "/element_sections", 2);
  const std::vector<double> axes = read_double_dataset(file, path + "/element_y", 3);
  expect(loops.size() % 2 == 0 && points.size() % 2 == 0);
  expect(numbers.size() == 2 * body.elements.size() && axes.size() == 3 * body.elements.size());
  std::size_t next = 0;
  for (std::size_t l = 0; l < loops.size(); l += 2) {
    // Loops stand in the order of their sections, so that no number can be far off.
    const int section = loops[l], count = loops[l + 1];
    const auto known = static_cast<int>(body.sections.size());
    expect(section == known || (section == known - 1 && known > 0));
    expect(count >= 0 && static_cast<std::size_t>(count) <= points.size() / 2 - next);
    if (section == known) body.sections.emplace_back();
    if (count == 0) continue;  // a section without outline
    fem::SectionLoop& loop = body.sections.back().emplace_back();
    for (int k = 0; k < count; ++k, ++next)
      loop.emplace_back(points[2 * next], points[2 * next + 1]);
  }
  for (std::size_t e = 0; e < body.elements.size(); ++e) {
    body.element_sections.push_back({numbers[2 * e], numbers[2 * e + 1]});
    for (const int number : body.element_sections.back()) {
      expect(number >= 0 && number < static_cast<int>(body.sections.size()));
    }
    body.element_y.emplace_back(axes[3 * e], axes[3 * e + 1], axes[3 * e + 2]);
  }
}

}  // namespace buckens::run_store

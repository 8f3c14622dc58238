// SPDX-License-Identifier: Apache-2.0
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/summary_text.h"
#include "cli/text_table.h"

namespace buckens::cli {

namespace {

std::string critical_points_text(const results::StaticPathSummary& path) {
  std::string out;
  for (const results::CriticalPoint& point : path.critical_points) {
    out += fmt::format("{} at load factor {:.10g} (t = {:.6g}):", point.kind, point.load_factor,
                       point.position);
    std::string values;
    for (const auto& [name, value] : point.sensors) {
      if (name == "load-factor") continue;
      values += fmt::format("{} {} = {:.8g}", values.empty() ? "" : ",", name, value);
    }
    out += values + '\n';
  }
  return out;
}

}  // namespace

std::string static_path_text(const results::RunSummary& summary) {
  std::string out = fmt::format("{}{} to load factor {:.6g} in {:.3g} s\n",
                                summary.title.empty() ? "" : summary.title + ": static path, ",
                                counted(summary.steps, "step"), summary.static_path->load_factor,
                                summary.wall_seconds.total);
  if (!summary.finished) out += fmt::format("NOT FINISHED: {}\n", summary.interrupted);
  out += critical_points_text(*summary.static_path);
  std::string trust;
  for (const std::string& text : summary.trust) trust += (trust.empty() ? "" : "; ") + text;
  std::vector<std::pair<std::string, std::string>> entries = {
      {"Newton iterations",
       fmt::format("{:.2f} per step, most {}", summary.newton_iterations.per_step_mean,
                   summary.newton_iterations.max)},
      {"constraint residual", fmt::format("{:.2g} at most", summary.residuals.position)},
      {"energy balance", fmt::format("off by {:.2g} of its scale", summary.energy_error)},
      {"trust", trust.empty() ? "ok" : trust}};
  return out + text_list(entries);
}

}  // namespace buckens::cli

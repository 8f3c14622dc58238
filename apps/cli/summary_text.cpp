// SPDX-License-Identifier: Apache-2.0
#include "cli/summary_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/error_text.h"
#include "cli/text_table.h"

namespace buckens::cli {

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

// Of rigid bodies there is nothing to tell but their names.
constexpr std::size_t kMostRigidRows = 20;

std::string headline(const results::RunSummary& summary) {
  const double stepping = summary.wall_seconds.stepping;
  const std::string rate =
      stepping > 0 && summary.steps > 0
          ? fmt::format(", {:.4g} steps/s", static_cast<double>(summary.steps) / stepping)
          : "";
  const std::string line = fmt::format(
      "{}{} to t = {:.6g} s in {:.3g} s{}\n", summary.title.empty() ? "" : summary.title + ": ",
      counted(summary.steps, "step"), summary.end_time, summary.wall_seconds.total, rate);
  if (summary.finished) return line;
  return line + fmt::format("NOT FINISHED: {}\n", summary.interrupted);
}

std::optional<double> measure(const results::BodyEffort& body, const char* name) {
  for (const auto& [known, value] : body.measures) {
    if (known == name) return value;
  }
  return std::nullopt;
}

bool iterates(const results::BodyEffort& body) {
  return measure(body, "iterations_per_solve").has_value();
}

std::string bodies_table(const results::RunSummary& summary) {
  std::vector<std::vector<std::string>> rows = {
      {"body", "nodal DOF", "coupling", "factorisations", "solves", "solves/step"}};
  const bool any_recycled =
      std::any_of(summary.bodies.begin(), summary.bodies.end(),
                  [](const results::BodyEffort& body) { return body.recycled > 0; });
  if (any_recycled) rows.front().emplace_back("recycled");
  if (std::any_of(summary.bodies.begin(), summary.bodies.end(), iterates)) {
    for (const char* title : {"iterations/solve", "s/solve", "solver GB"}) {
      rows.front().emplace_back(title);
    }
  }
  std::size_t rigid = 0;
  for (const results::BodyEffort& body : summary.bodies) {
    if (body.dof == 0) {
      if (++rigid <= kMostRigidRows) rows.push_back({body.name, "rigid"});
      continue;
    }
    const std::string per_step = summary.steps > 0
                                     ? fmt::format("{:.2f}", static_cast<double>(body.solves) /
                                                                 static_cast<double>(summary.steps))
                                     : "-";
    rows.push_back({body.name, fmt::to_string(body.dof), body.coupling,
                    fmt::to_string(body.factorisations), fmt::to_string(body.solves), per_step});
    if (any_recycled) rows.back().push_back(fmt::to_string(body.recycled));
    if (!iterates(body)) continue;
    rows.back().push_back(fmt::format("{:.1f}", *measure(body, "iterations_per_solve")));
    rows.back().push_back(fmt::format("{:.3g}", measure(body, "seconds_per_solve").value_or(0.0)));
    rows.back().push_back(fmt::format("{:.3g}", measure(body, "solver_bytes").value_or(0.0) / 1e9));
  }
  if (rigid > kMostRigidRows) {
    rows.push_back({fmt::format("{} more", rigid - kMostRigidRows), "rigid"});
  }
  return text_table(rows);
}

std::string wall_text(const results::WallSeconds& wall) {
  std::string out = fmt::format("{:.3g} s = set-up {:.3g} + stepping {:.3g}", wall.total,
                                wall.setup, wall.stepping);
  std::string phases;
  for (const auto& [name, seconds] : wall.phases) {
    phases += fmt::format("{}{} {:.3g}", phases.empty() ? "" : ", ", name, seconds);
  }
  return phases.empty() ? out : out + " (" + phases + ")";
}

/// "1.6e-05 to 0.001 s; 12 undone for their error, 0 for not settling; 1e-3 s: 90 steps, …"
std::string steps_text(const results::StepControlEffort& control) {
  std::string out =
      fmt::format("{:.3g} to {:.3g} s; undone: {} for their error, {} not settled",
                  control.smallest, control.largest, control.rejected, control.failed);
  std::string sizes;
  for (const results::StepSizeEffort& size : control.sizes) {
    sizes += fmt::format("{}{} of {:.3g} s", sizes.empty() ? "" : ", ", size.steps, size.step);
  }
  return out + " (" + sizes + ")";
}

std::string join(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : "; ") + text;
  return out;
}

/// How near a body came to the limits of its level and of linear elasticity.
std::string limits_text(const results::BodyEffort& body) {
  constexpr std::pair<const char*, const char*> kShown[] = {
      {"spin_over_lowest_frequency", "|w|/w1 {:.2g}"},
      {"largest_neglected_share", "neglected {:.2g}"},
      {"largest_rotation_rad", "rotation {:.2g} rad"},
      {"largest_strain", "strain {:.2g}"},
      {"largest_axial_load_over_buckling_load", "axial load {:.2g} of buckling"}};
  std::string out;
  for (const auto& [name, format] : kShown) {
    for (const auto& [key, value] : body.measures) {
      if (key != name) continue;
      out += (out.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), value);
    }
  }
  return out;
}

/// Where the energy came from and went. Parts that rounding leaves are left out.
std::string energy_table(const results::EnergyAccount& account) {
  constexpr double kNothing = 1e-12;
  double largest = 0;
  for (const results::EnergyEntry& entry : account.entries) {
    largest = std::max(largest, std::abs(entry.energy));
  }
  std::vector<std::vector<std::string>> rows = {{"energy", "", "of", "J"}};
  using Side = results::EnergyEntry::Side;
  for (const auto& [side, word] : {std::pair{Side::brought_in, "brought in"},
                                   std::pair{Side::lost, "lost"}, std::pair{Side::kept, "kept"}}) {
    for (const results::EnergyEntry& entry : account.entries) {
      if (entry.side != side || std::abs(entry.energy) <= kNothing * largest) continue;
      rows.push_back({word, entry.kind, entry.of, fmt::format("{:.6g}", entry.energy)});
    }
  }
  if (rows.size() == 1) return "";
  rows.push_back({"unexplained", "", "", fmt::format("{:.2g}", account.unexplained)});
  return text_table(rows);
}

}  // namespace

std::string summary_text(const results::RunSummary& summary) {
  if (summary.static_path) return static_path_text(summary);
  std::string out = headline(summary);
  if (!summary.bodies.empty()) out += bodies_table(summary);
  Entries entries = {
      {"solves before the first step", fmt::to_string(summary.setup_solves)},
      {"Newton iterations",
       fmt::format("{:.2f} per step, most {}", summary.newton_iterations.per_step_mean,
                   summary.newton_iterations.max)},
      {"constraint residual, position", fmt::format("{:.2g} at most", summary.residuals.position)},
      {"constraint residual, velocity", fmt::format("{:.2g} at most", summary.residuals.velocity)},
      {"sieve residual |P'd|",
       fmt::format("{:.2g} at most, relative to the body", summary.residuals.sieve)},
      {"energy balance", fmt::format("off by {:.2g} of its scale", summary.energy_error)},
      {"wall time", wall_text(summary.wall_seconds)},
      {"trust", summary.trust.empty() ? "ok" : join(summary.trust)}};
  for (const auto& [name, value] : summary.measures) {
    entries.emplace_back(name, fmt::format("{:.4g}", value));
  }
  const results::StepControlEffort& control = summary.step_control;
  if (control.is_controlled || control.failed > 0) {
    entries.insert(entries.begin(), {"step sizes", steps_text(control)});
  }
  for (const results::BodyEffort& body : summary.bodies) {
    if (body.dof > 0) entries.emplace_back("body " + body.name, limits_text(body));
  }
  out += text_list(entries);
  if (summary.energy_account) out += energy_table(*summary.energy_account);
  if (summary.errors) out += error_text(*summary.errors);
  for (const std::string& text : summary.redundant_constraints) out += "redundant: " + text + '\n';
  for (const std::string& text : summary.notes) out += "note: " + text + '\n';
  return out;
}

}  // namespace buckens::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/vibration_text.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output.h"
#include "cli/text_table.h"

namespace buckens::cli {

namespace {

using analysis::Vibration;
using analysis::VibrationReport;
using Json = nlohmann::ordered_json;

/// Groups named in a line of the table; the rest stands in the JSON output.
constexpr std::size_t kGroupsShown = 3;
constexpr double kShareShown = 0.005;

/// "rod 93 %, crank 7 %": the groups with most energy first.
std::string shares_text(const VibrationReport& report, const Vibration& v) {
  std::vector<std::size_t> order(v.energy_shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return v.energy_shares[a] > v.energy_shares[b];
  });
  std::string out;
  for (std::size_t k = 0; k < std::min(order.size(), kGroupsShown); ++k) {
    const double share = v.energy_shares[order[k]];
    if (share < kShareShown) break;
    out += fmt::format("{}{} {:.0f} %", k == 0 ? "" : ", ", report.energy_groups[order[k]],
                       100.0 * share);
  }
  return out;
}

std::string modes_table(const VibrationReport& report) {
  std::vector<std::vector<std::string>> rows = {{"mode", "frequency [Hz]", "mass [kg]"}};
  const bool system = report.is_system();
  if (system) {
    for (const char* axis : {"x", "y", "z"}) rows[0].push_back(fmt::format("eff. {} [%]", axis));
  }
  const bool damped = system && std::any_of(report.vibrations.begin(), report.vibrations.end(),
                                            [](const auto& v) { return v.damping_ratio > 0.0; });
  if (damped) rows[0].emplace_back("damping [%]");
  rows[0].emplace_back("error");
  rows[0].emplace_back("energy in");
  std::array<double, 3> sums{};
  for (std::size_t k = 0; k < report.vibrations.size(); ++k) {
    const Vibration& v = report.vibrations[k];
    rows.push_back({fmt::to_string(k + 1),
                    v.square < 0.0 ? "unstable" : fmt::format("{:.7g}", v.frequency),
                    fmt::format("{:.4g}", v.generalised_mass)});
    for (std::size_t a = 0; system && a < 3; ++a) {
      sums[a] += v.effective_mass[a];
      rows.back().push_back(fmt::format("{:.2f}", 100.0 * v.effective_mass[a] / report.mass));
    }
    if (damped) rows.back().push_back(fmt::format("{:.3g}", 100.0 * v.damping_ratio));
    rows.back().push_back(fmt::format("{:.0e}", v.error));
    rows.back().push_back(shares_text(report, v));
  }
  if (system && !report.vibrations.empty()) {
    rows.push_back({"sum", "", ""});
    for (const double sum : sums) {
      rows.back().push_back(fmt::format("{:.2f}", 100.0 * sum / report.mass));
    }
    rows.back().resize(rows[0].size());
  }
  return text_table(rows);
}

std::string report_text(const VibrationReport& report) {
  const std::string where =
      report.is_system() ? "assembled system" : fmt::format("free body \"{}\"", report.subject);
  const std::string rigid =
      report.is_system()
          ? fmt::format("{} without resistance (0 Hz)", counted(report.rigid_modes, "motion"))
          : fmt::format("{}, not listed", counted(report.rigid_modes, "rigid mode"));
  std::string out = fmt::format("{}: {}, {}\n", where, counted(report.dof, "unknown"), rigid);
  if (report.vibrations.empty()) {
    out += "  no vibrations\n";
  } else {
    out += modes_table(report);
  }
  const auto& work = report.work;
  out += fmt::format("  method {}: {}, {}, {}, factor of {:.3g} entries, {:.3g} s\n", work.method,
                     counted(work.factorisations, "factorisation"), counted(work.sweeps, "sweep"),
                     counted(work.solves, "solve"), work.factor_entries, work.seconds);
  if (work.condition > 0.0) out += fmt::format("  condition number {:.2g}\n", work.condition);
  for (const std::string& note : report.notes) out += "note: " + note + '\n';
  return out;
}

Json json_of(const VibrationReport& report, const Vibration& v) {
  Json shares = Json::object();
  for (std::size_t k = 0; k < v.energy_shares.size(); ++k) {
    shares[report.energy_groups[k]] = v.energy_shares[k];
  }
  Json out = {{"frequency", v.frequency},
              {"omega_squared", v.square},
              {"generalised_mass", v.generalised_mass},
              {"error", v.error},
              {"energy_shares", std::move(shares)}};
  if (report.is_system()) {
    out["effective_mass"] = v.effective_mass;
    out["damping_ratio"] = v.damping_ratio;
  } else {
    out["residual"] = v.residual;
  }
  return out;
}

Json json_of(const analysis::VibrationWork& work) {
  Json out = {{"method", work.method},
              {"shift", work.shift},
              {"penalty", work.penalty},
              {"sweeps", work.sweeps},
              {"solves", work.solves},
              {"factorisations", work.factorisations},
              {"factor_entries", work.factor_entries},
              {"condition", work.condition > 0.0 ? Json(work.condition) : Json(nullptr)},
              {"seconds", work.seconds}};
  if (linalg::Ranks::count() > 1) {
    out["processes"] = linalg::Ranks::count();
    out["messages"] = work.traffic.messages;
    out["bytes"] = work.traffic.bytes;
    out["bytes_of_whole_matrices"] = work.traffic.bytes_of_whole_matrices;
  }
  return out;
}

Json json_of(const VibrationReport& report) {
  Json modes = Json::array();
  for (const Vibration& v : report.vibrations) modes.push_back(json_of(report, v));
  return {{"kind", report.is_system() ? "system" : "free"},
          {"body", report.is_system() ? Json(nullptr) : Json(report.subject)},
          {"dof", report.dof},
          {"rigid_modes", report.rigid_modes},
          {"mass", report.mass},
          {"modes", std::move(modes)},
          {"work", json_of(report.work)},
          {"notes", report.notes}};
}

}  // namespace

std::string vibration_text(const std::string& title, const std::vector<VibrationReport>& reports) {
  std::string out = title.empty() ? "" : title + '\n';
  for (const VibrationReport& report : reports) out += report_text(report);
  return out;
}

std::string vibration_json(const std::string& title, const std::vector<VibrationReport>& reports) {
  Json all = Json::array();
  for (const VibrationReport& report : reports) all.push_back(json_of(report));
  return to_text({{"title", title}, {"analyses", std::move(all)}});
}

}  // namespace buckens::cli

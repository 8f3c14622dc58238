// SPDX-License-Identifier: Apache-2.0
#include "cli/model_report_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output.h"
#include "cli/text_table.h"

#include "buckens/analysis/output_plan.h"
#include "buckens/files/vector_json.h"

namespace buckens::cli {

namespace {

using analysis::BodyReport;
using analysis::ModelReport;
using Json = nlohmann::ordered_json;
using files::json_of;

/// Columns of the frequency list; the rest stands in the JSON output.
constexpr std::size_t kFrequenciesShown = 6;
constexpr double kTurn = 2.0 * std::numbers::pi;

std::string number(double value) { return fmt::format("{:.5g}", value); }

std::string triple(double x, double y, double z) {
  return fmt::format("{:.5g}, {:.5g}, {:.5g}", x, y, z);
}

std::string bodies_table(const ModelReport& report) {
  std::vector<std::vector<std::string>> rows = {{"body", "mass [kg]", "mass centre [m]",
                                                 "principal inertia [kg m^2]", "nodes", "elements",
                                                 "nodal DOF", "frame"}};
  for (const BodyReport& body : report.bodies) {
    const auto& inertia = body.principal_inertia;
    const auto mesh = [&](int count) {
      return body.is_flexible ? fmt::to_string(count) : std::string("-");
    };
    rows.push_back({body.name, number(body.mass), triple(body.com.x(), body.com.y(), body.com.z()),
                    triple(inertia[0], inertia[1], inertia[2]), mesh(body.nodes),
                    mesh(body.elements), mesh(body.dof), fmt::to_string(body.frame_coordinates)});
  }
  return text_table(rows);
}

std::string frequencies_text(const ModelReport& report) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const BodyReport& body : report.bodies) {
    if (body.frequencies.empty()) continue;
    std::string list;
    for (std::size_t i = 0; i < std::min(body.frequencies.size(), kFrequenciesShown); ++i) {
      list += fmt::format("{}{:.5g}", i == 0 ? "" : ", ", body.frequencies[i]);
    }
    entries.emplace_back(body.name, list + " Hz");
  }
  return entries.empty() ? "" : "lowest free-free frequencies\n" + text_list(entries);
}

/// What reduced bodies keep, and what their vibrations alone would miss.
std::string reductions_text(const ModelReport& report) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const BodyReport& body : report.bodies) {
    if (!body.reduction) continue;
    const body::ReductionFigures& r = *body.reduction;
    std::string text = fmt::format("{}: {} of {} variables, {}", r.basis, body.dof, r.full_dofs,
                                   counted(r.modes, "vibration"));
    if (r.modes > 0) text += fmt::format(" up to {:.5g} Hz", r.highest_mode / kTurn);
    text += fmt::format(" and {}", counted(r.static_shapes, "static shape"));
    if (r.static_share > 0) {
      text += fmt::format(
          "; without static correction the answer to slow joint forces lacks up "
          "to {:.2g} %",
          100.0 * r.static_share);
    }
    entries.emplace_back(body.name, text);
  }
  return entries.empty() ? "" : "reduced bodies\n" + text_list(entries);
}

std::string markers_text(const ModelReport& report) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const BodyReport& body : report.bodies) {
    std::string list;
    for (const std::string& name : body.markers) list += (list.empty() ? "" : ", ") + name;
    if (!list.empty()) entries.emplace_back(body.name, list);
  }
  return entries.empty() ? "" : "markers\n" + text_list(entries);
}

std::string interfaces_table(const ModelReport& report) {
  std::vector<std::vector<std::string>> rows = {
      {"interface", "kind", "nodes", "area [m^2]", "centre [m]", "carries"}};
  for (const BodyReport& body : report.bodies) {
    for (const analysis::InterfaceReport& interface : body.interfaces) {
      const Eigen::Vector3d& c = interface.centre;
      rows.push_back(
          {body.name + "/" + interface.name, interface.is_rigid ? "rigid" : "average",
           fmt::to_string(interface.nodes), interface.area > 0.0 ? number(interface.area) : "-",
           triple(c.x(), c.y(), c.z()), interface.carries_moment ? "forces, moments" : "forces"});
    }
  }
  return rows.size() == 1 ? "" : text_table(rows);
}

std::string loads_table(const ModelReport& report) {
  std::vector<std::vector<std::string>> rows = {
      {"distributed load", "kind", "on", "extent", "force [N]", "torque [N m]"}};
  for (const analysis::LoadReport& load : report.distributed_loads) {
    // What cancels leaves rounding, and lengths in metres are of the order of one.
    const double rounding = 1e-12 * (load.force.norm() + load.torque.norm());
    const auto shown = [&](double x) { return std::abs(x) > rounding ? x : 0.0; };
    const Eigen::Vector3d f = load.force.unaryExpr(shown), m = load.torque.unaryExpr(shown);
    rows.push_back({load.name, load.kind, load.place.empty() ? "all bodies" : load.place,
                    number(load.extent) + " " + load.unit, triple(f.x(), f.y(), f.z()),
                    triple(m.x(), m.y(), m.z())});
  }
  if (rows.size() == 1) return "";
  return text_table(rows) + "  forces and torques at t = 0, torques about the mass centre\n";
}

Json json_of(const std::vector<analysis::LoadReport>& loads) {
  Json out = Json::object();
  for (const analysis::LoadReport& load : loads) {
    out[load.name] = {{"kind", load.kind},
                      {"on", load.place},
                      {"extent", load.extent},
                      {"unit", load.unit},
                      {"force", json_of(load.force)},
                      {"torque", json_of(load.torque)}};
  }
  return out;
}

Json json_of(const std::vector<analysis::InterfaceReport>& interfaces) {
  Json out = Json::object();
  for (const analysis::InterfaceReport& interface : interfaces) {
    out[interface.name] = {{"kind", interface.is_rigid ? "rigid" : "average"},
                           {"nodes", interface.nodes},
                           {"area", interface.area},
                           {"centre", json_of(interface.centre)},
                           {"carries_moment", interface.carries_moment}};
  }
  return out;
}

Json json_of(const body::ReductionFigures& r) {
  return {{"basis", r.basis},
          {"modes", r.modes},
          {"static_shapes", r.static_shapes},
          {"full_dof", r.full_dofs},
          {"highest_mode", r.highest_mode / kTurn},
          {"static_share", r.static_share}};
}

Json json_of(const BodyReport& body) {
  Json out = {{"flexible", body.is_flexible},
              {"mass", body.mass},
              {"com", json_of(body.com)},
              {"inertia", json_of(body.inertia)},
              {"principal_inertia", body.principal_inertia},
              {"nodes", body.nodes},
              {"elements", body.elements},
              {"dof", body.dof},
              {"frames", body.frames},
              {"frame_coordinates", body.frame_coordinates},
              {"frequencies", body.frequencies},
              {"markers", body.markers},
              {"interfaces", json_of(body.interfaces)}};
  if (body.reduction) out["reduction"] = json_of(*body.reduction);
  return out;
}

}  // namespace

std::string report_text(const std::string& title, const ModelReport& report) {
  std::string out = title.empty() ? "" : title + '\n';
  out += bodies_table(report) + frequencies_text(report) + reductions_text(report) +
         markers_text(report) + interfaces_table(report) + loads_table(report);
  out += "mechanism\n";
  std::vector<std::pair<std::string, std::string>> entries = {
      {"joints", fmt::format("{} with {}, {} redundant", counted(report.joints, "joint"),
                             counted(report.constraint_rows, "equation"), report.redundant_rows)},
      {"loads", fmt::to_string(report.loads)},
      {"degrees of freedom", fmt::format("{} (bodies taken as rigid)", report.degrees_of_freedom)},
      {"gap left by assembly", fmt::format("{:.2g}", report.assembly_gap)}};
  if (report.step > 0) entries.emplace_back("step", fmt::format("{:.6g} s", report.step));
  if (report.highest_frequency > 0) {
    entries.emplace_back("highest frequency excited by loads",
                         fmt::format("{:.5g} Hz", report.highest_frequency));
  }
  if (report.result_bytes > 0) {
    entries.emplace_back("size of results.h5", "about " + analysis::size_text(report.result_bytes));
  }
  out += text_list(entries);
  for (const std::string& text : report.redundant) out += "redundant: " + text + '\n';
  for (const std::string& text : report.notes) out += "note: " + text + '\n';
  for (const std::string& text : report.warnings) out += "warning: " + text + '\n';
  return out;
}

std::string report_json(const std::string& title, const ModelReport& report) {
  Json bodies = Json::object();
  for (const BodyReport& body : report.bodies) bodies[body.name] = json_of(body);
  return to_text({{"title", title},
                  {"bodies", std::move(bodies)},
                  {"joints", report.joints},
                  {"loads", report.loads},
                  {"distributed_loads", json_of(report.distributed_loads)},
                  {"constraint_rows", report.constraint_rows},
                  {"redundant_rows", report.redundant_rows},
                  {"redundant", report.redundant},
                  {"degrees_of_freedom", report.degrees_of_freedom},
                  {"assembly_gap", report.assembly_gap},
                  {"step", report.step},
                  {"highest_frequency", report.highest_frequency},
                  {"result_bytes", report.result_bytes},
                  {"notes", report.notes},
                  {"warnings", report.warnings}});
}

}  // namespace buckens::cli

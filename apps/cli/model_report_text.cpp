// SPDX-License-Identifier: Apache-2.0
#include "cli/model_report_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/output.h"
#include "cli/text_table.h"

#include "buckens/analysis/simulation/output_plan.h"

namespace buckens::cli {

namespace {

using analysis::BodyReport;
using analysis::ModelReport;

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
          "; without static correction the response to slow joint forces is too small by up to "
          "{:.2g} %",
          100.0 * r.static_share);
    }
    entries.emplace_back(body.name, text);
  }
  return entries.empty() ? "" : "reduced bodies\n" + text_list(entries);
}

std::string axis_text(const Eigen::Vector3d& v) {
  const auto shown = [](double x) { return std::abs(x) > 1e-6 ? x : 0.0; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(v.x()), shown(v.y()), shown(v.z()));
}

/// "16 elements, 5 mm in the plane x 20 mm across it; bends about (0, 0, 1) with EI = 41.7 N m^2"
std::string section_text(const analysis::SectionReport& s) {
  const std::string count = counted(s.elements, "element");
  if (s.planar) {
    return fmt::format(
        "{}: {:.4g} m in the plane, {:.4g} m across it; bends about {} with EI = {:.4g} N m^2",
        count, s.planar->extent_in_plane, s.planar->extent_across, axis_text(s.planar->axis),
        s.planar->EI);
  }
  return fmt::format(
      "{}: {:.4g} m along {}, {:.4g} m along {}; bends about {} with EI = {:.4g} N m^2, about {} "
      "with {:.4g} N m^2",
      count, s.width, axis_text(s.y), s.height, axis_text(s.z), axis_text(s.y), s.EI_y,
      axis_text(s.z), s.EI_z);
}

/// Which way sections of beams lie, in the model axes of their body.
std::string sections_text(const ModelReport& report) {
  constexpr std::size_t kSectionsShown = 4;  // the rest stands in the JSON output
  std::vector<std::pair<std::string, std::string>> entries;
  for (const BodyReport& body : report.bodies) {
    for (std::size_t i = 0; i < std::min(body.sections.size(), kSectionsShown); ++i) {
      entries.emplace_back(i == 0 ? body.name : "", section_text(body.sections[i]));
    }
    if (body.sections.size() > kSectionsShown) {
      entries.emplace_back("", fmt::format("and {} more", body.sections.size() - kSectionsShown));
    }
  }
  return entries.empty() ? ""
                         : "beam sections, in the model axes of the body\n" + text_list(entries);
}

/// What assembly did, body by body.
std::string moves_text(const ModelReport& report) {
  std::string out;
  for (const analysis::AssemblyMove& move : report.moves) {
    if (!move.is_large) out += "note: " + move.text() + '\n';
  }
  return out;
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

/// Ratios that vibrations of the assembled model have, whatever the bodies alone would have.
std::string damping_table(const ModelReport& report) {
  if (report.damping.empty()) return "";
  std::vector<std::vector<std::string>> rows = {
      {"vibration as assembled [Hz]", "damping [%]", "asked [%]", "energy in"}};
  for (const analysis::ModeDamping& mode : report.damping) {
    rows.push_back({number(mode.frequency), fmt::format("{:.3g}", 100.0 * mode.ratio),
                    mode.asked ? fmt::format("{:.3g}", 100.0 * *mode.asked) : "-",
                    fmt::format("{} {:.0f} %", mode.body, 100.0 * mode.share)});
  }
  return text_table(rows);
}

}  // namespace

std::string report_text(const std::string& title, const ModelReport& report) {
  std::string out = title.empty() ? "" : title + '\n';
  out += bodies_table(report) + frequencies_text(report) + sections_text(report) +
         reductions_text(report) + markers_text(report) + interfaces_table(report) +
         loads_table(report) + damping_table(report);
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
  out += moves_text(report);
  for (const std::string& text : report.notes) out += "note: " + text + '\n';
  for (const std::string& text : report.warnings) out += "warning: " + text + '\n';
  return out;
}

}  // namespace buckens::cli

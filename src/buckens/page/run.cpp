// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/files/vector_json.h"
#include "buckens/page/body.h"
#include "buckens/page/contact_shapes.h"
#include "buckens/page/fields.h"
#include "buckens/page/frames.h"
#include "buckens/page/origin.h"
#include "buckens/results/motion_tables.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"

namespace buckens::page {

namespace {

using Json = nlohmann::ordered_json;
using results::Channel;

constexpr std::size_t kPoseNumbers = 7;

/// A body and what it shows in colour.
struct Shown {
  PageBody body;
  std::vector<PageField> fields;
};

/// Among more bodies than this, rigid ones are only counted: there is nothing to tell of them.
constexpr std::size_t kManyBodies = 100;

void count_rigid_bodies(nlohmann::json& summary) {
  const auto bodies = summary.find("bodies");
  if (bodies == summary.end() || !bodies->is_object() || bodies->size() <= kManyBodies) return;
  std::size_t count = 0;
  for (auto body = bodies->begin(); body != bodies->end();) {
    const bool is_rigid = body->is_object() && body->value("dof", nlohmann::json()) == 0;
    count += is_rigid ? 1 : 0;
    body = is_rigid ? bodies->erase(body) : std::next(body);
  }
  if (count > 0) summary["rigid_bodies"] = count;
}

/// The summary of a run, null where a crash has damaged it.
nlohmann::json parse_summary(const std::string& text) {
  nlohmann::json summary = nlohmann::json::parse(text, nullptr, false);
  if (summary.is_discarded()) return nullptr;
  if (summary.is_object()) count_rigid_bodies(summary);
  return summary;
}

/// Values of a vector over time, null where it was not recorded.
Json vector_json(const FrameReader& reader, const std::string& path) {
  return reader.size_of(path) == 3 ? Json(reader.values(path)) : Json(nullptr);
}

Json joint_json(const results::GeometryJoint& joint, const FrameReader& reader) {
  Json between = Json::array();
  for (const results::GeometrySide& side : joint.between) {
    between.push_back(side_json(side));
  }
  return {{"name", joint.name},
          {"type", joint.type},
          {"between", std::move(between)},
          {"axis", files::json_of(joint.axis)},
          {"force", vector_json(reader, fmt::format("joints/{}/force", joint.name))},
          {"torque", vector_json(reader, fmt::format("joints/{}/torque", joint.name))}};
}

/// Loads as arrows; the nodes that carry them by their numbers in the page.
Json loads_json(const run_store::RunReader& run, const FrameReader& reader,
                const std::vector<Shown>& shown) {
  Json all = Json::array();
  for (const results::GeometryLoad& load : run.geometry().loads) {
    Json positions = Json::array();
    Json directions = Json::array();
    Json nodes = Json::array();
    for (const Eigen::Vector3d& p : load.positions) positions.push_back(files::json_of(p));
    for (const Eigen::Vector3d& v : load.directions) directions.push_back(files::json_of(v));
    for (const int node : load.nodes) {
      const std::vector<int>* numbers =
          load.body < 0 ? nullptr
                        : &shown.at(static_cast<std::size_t>(load.body)).body.visible().number;
      const bool known =
          numbers != nullptr && node >= 0 && static_cast<std::size_t>(node) < numbers->size();
      nodes.push_back(known ? (*numbers)[static_cast<std::size_t>(node)] : -1);
    }
    const std::string path = fmt::format("loads/{}/value", load.name);
    const std::size_t width = reader.size_of(path);
    const bool has_values = width == 1 || width == 3;
    all.push_back({{"name", load.name},
                   {"kind", load.kind},
                   {"body", load.body},
                   {"follows", load.follows},
                   {"unit", load.unit},
                   {"positions", std::move(positions)},
                   {"nodes", std::move(nodes)},
                   {"directions", std::move(directions)},
                   {"values", has_values ? Json(reader.values(path)) : Json(nullptr)},
                   {"width", has_values ? width : 0}});
  }
  return all;
}

/// Names of a channel's values, one each.
std::vector<std::string> component_names(const Channel& channel) {
  if (channel.shape.empty()) return {""};
  if (channel.components.size() == channel.size()) return channel.components;
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= channel.size(); ++i) names.push_back(fmt::format("{}", i));
  return names;
}

Json curve_json(const Channel& channel, const FrameReader& reader) {
  return {{"name", channel.path.substr(channel.path.find('/') + 1)},
          {"unit", channel.unit},
          {"components", component_names(channel)},
          {"values", reader.values(channel.path)}};
}

Json sensors_json(const run_store::RunReader& run, const FrameReader& reader) {
  Json all = Json::array();
  for (const Channel* channel : run.sensors()) all.push_back(curve_json(*channel, reader));
  return all;
}

Json energies_json(const run_store::RunReader& run, const FrameReader& reader) {
  Json all = Json::array();
  for (const Channel& channel : run.layout().channels()) {
    if (!channel.path.starts_with("energies/") || channel.size() != 1) continue;
    all.push_back(curve_json(channel, reader));
  }
  return all;
}

/// Vibrations: every frame is one of them. Null for runs.
Json modes_json(const run_store::RunReader& run, const FrameReader& reader) {
  const std::vector<double> bodies = reader.scalars("modes/body");
  const std::vector<double> numbers = reader.scalars("modes/number");
  const std::vector<double> frequencies = reader.scalars("modes/frequency");
  const std::vector<double> masses = reader.scalars("modes/generalised_mass");
  const std::size_t count = bodies.size();
  if (count == 0 || numbers.size() != count || frequencies.size() != count ||
      masses.size() != count) {
    return nullptr;
  }
  Json all = Json::array();
  for (std::size_t k = 0; k < count; ++k) {
    const auto& known = run.geometry().bodies;
    const bool is_body = bodies[k] >= 0 && bodies[k] < static_cast<double>(known.size());
    const std::string name =
        is_body ? known[static_cast<std::size_t>(bodies[k])].name : std::string("system");
    all.push_back({{"label", fmt::format("{} {:.0f}", name, numbers[k])},
                   {"frequency", frequencies[k]},
                   {"mass", masses[k]}});
  }
  return all;
}

/// Number of frames that keeps the page below the size browsers handle well, and whether rounded.
void choose_size(const run_store::RunReader& run, const std::vector<Shown>& shown,
                 const ViewPageOptions& options, ViewPageReport& report) {
  std::size_t plain = 1;  // numbers of a frame that stay float32
  std::size_t rows = 0;   // numbers that may be rounded
  for (const Channel& channel : run.layout().channels()) {
    const std::string& path = channel.path;
    const bool is_shown = path.ends_with("/pose") || path.ends_with("/motion") ||
                          path.starts_with("sensors/") || path.starts_with("energies/") ||
                          path.starts_with("loads/") || path.starts_with("modes/") ||
                          path.starts_with("joints/");
    if (is_shown) plain += channel.size();
    // Of thousands of bodies all poses stand in one channel, beside velocities; of joints all
    // forces.
    if (path == results::kMotionsPath) plain += kPoseNumbers * run.geometry().bodies.size();
    if (path == results::kReactionsPath) plain += channel.size();
  }
  std::size_t ranges = 0;  // ends of ranges of rounded rows
  for (const Shown& one : shown) {
    rows += one.body.displacements_per_frame(run);
    for (const PageField& field : one.fields) rows += field.values_per_frame();
    ranges += 2 * (1 + one.fields.size());
  }
  const std::size_t wanted = std::min(run.num_records(), options.max_frames);
  constexpr std::size_t kFloat = sizeof(float);
  constexpr std::size_t kCode = sizeof(std::uint16_t);
  report.rounded = rows > 0 && wanted * kFloat * (plain + rows) > options.max_bytes / 4;
  const std::size_t of_rows = report.rounded ? kCode * rows + kFloat * ranges : kFloat * rows;
  const std::size_t bytes = kFloat * plain + of_rows;
  report.frames = std::min(wanted, options.max_bytes / bytes);
}

Json storage_json(const ViewPageReport& report, const ViewPageOptions& options, bool at_fields,
                  std::size_t possible) {
  Json notes = Json::array();
  if (at_fields) notes.push_back("Frames are at the instants at which fields were recorded");
  if (report.frames < std::min(possible, options.max_frames)) {
    notes.push_back(fmt::format("Frames were left out to keep the page below {} MiB of numbers",
                                options.max_bytes >> 20U));
  }
  return {{"records", report.records}, {"rounded", report.rounded}, {"notes", std::move(notes)}};
}

Json bodies_json(const std::vector<Shown>& shown, const FrameReader& reader) {
  Json bodies = Json::array();
  for (const Shown& one : shown) {
    Json body = one.body.json(reader);
    body["fields"] = Json::array();
    for (const PageField& field : one.fields) body["fields"].push_back(field.json(reader));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// Bodies with those of their fields that are wanted.
std::vector<Shown> what_is_shown(const run_store::RunReader& run, const ViewPageOptions& options,
                                 ViewPageReport& report) {
  std::vector<Shown> shown;
  std::set<std::string> names;
  for (const results::GeometryBody& body : run.geometry().bodies) {
    PageBody page(body);
    std::vector<PageField> fields = page_fields(body, page.visible(), run);
    for (const PageField& field : fields) names.insert(field.name);
    if (!options.fields.empty()) {
      std::erase_if(fields, [&](const PageField& field) {
        return std::find(options.fields.begin(), options.fields.end(), field.name) ==
               options.fields.end();
      });
    }
    shown.push_back({std::move(page), std::move(fields)});
  }
  report.fields.assign(names.begin(), names.end());
  return shown;
}

}  // namespace

nlohmann::ordered_json page_run(const std::filesystem::path& directory,
                                const ViewPageOptions& options, ViewPageReport& report) {
  const run_store::RunReader run(directory);
  if (run.num_records() == 0) {
    throw IoError(fmt::format("{}: the run has no records yet, there is nothing to show.",
                              directory.string()));
  }
  const results::Geometry& geometry = run.geometry();
  const std::vector<Shown> shown = what_is_shown(run, options, report);
  report.records = run.num_records();
  choose_size(run, shown, options, report);
  const bool with_fields = std::any_of(shown.begin(), shown.end(), [](const Shown& one) {
    return std::any_of(one.fields.begin(), one.fields.end(), [](const PageField& field) {
      return field.from == PageField::From::fields;
    });
  });
  const FrameReader reader(run, choose_frames(run, with_fields, report.frames), report.rounded);
  report.frames = reader.num_frames();
  const bool at_fields = with_fields && reader.frames().field_rows.size() == report.frames &&
                         run.field_times().size() < report.records;
  const std::size_t possible = at_fields ? run.field_times().size() : report.records;
  Json joints = Json::array();
  for (const results::GeometryJoint& joint : geometry.joints) {
    joints.push_back(joint_json(joint, reader));
  }
  Json modes = modes_json(run, reader);
  Json summary = parse_summary(run.summary_text());
  const std::filesystem::path shapes = directory / run_store::kModesName;
  std::error_code ignored;
  if (!modes.is_null() && std::filesystem::exists(shapes, ignored)) {
    summary = parse_summary(files::read_text_file(shapes));
  }
  return {{"title", run.title()},
          {"changes", run_changes(directory)},
          {"version", run.version()},
          {"generated", files::utc_now()},
          {"time", {{"n", reader.num_frames()}, {"f32", reader.times()}}},
          {"bodies", bodies_json(shown, reader)},
          {"joints", std::move(joints)},
          {"loads", loads_json(run, reader, shown)},
          {"shapes", shapes_json(geometry)},
          {"cables", cables_json(geometry)},
          {"gravity", files::json_of(geometry.gravity)},
          {"planar", geometry.planar.empty() ? Json(nullptr) : Json(geometry.planar)},
          {"sensors", sensors_json(run, reader)},
          {"energies", energies_json(run, reader)},
          {"modes", std::move(modes)},
          {"summary", std::move(summary)},
          {"storage", storage_json(report, options, at_fields, possible)}};
}

}  // namespace buckens::page

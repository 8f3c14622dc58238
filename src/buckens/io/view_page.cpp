// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/io/output_file.h"
#include "buckens/io/run_directory.h"
#include "buckens/io/run_reader.h"
#include "buckens/io/view_page_body.h"
#include "buckens/io/view_page_frames.h"

namespace buckens::io {

namespace {

/// The summary of a run, null where a crash has damaged it.
nlohmann::json parse_summary(const std::string& text) {
  nlohmann::json summary = nlohmann::json::parse(text, nullptr, false);
  return summary.is_discarded() ? nlohmann::json() : summary;
}

using Json = nlohmann::ordered_json;
using results::Channel;

constexpr std::string_view kMarker = "/*BUCKENS_DATA*/null";
constexpr int kFormat = 1;

Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Which records become frames: evenly spread, the first and the last among them.
std::vector<std::size_t> choose_frames(std::size_t records, std::size_t limit) {
  const std::size_t count = std::min(records, std::max<std::size_t>(limit, 2));
  std::vector<std::size_t> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i] = count == 1 ? 0 : i * (records - 1) / (count - 1);
  }
  return frames;
}

Json joint_json(const results::GeometryJoint& joint) {
  Json between = Json::array();
  for (const results::GeometrySide& side : joint.between) {
    between.push_back(
        {{"body", side.body}, {"marker", side.marker}, {"position", json_of(side.position)}});
  }
  return {{"name", joint.name},
          {"type", joint.type},
          {"between", std::move(between)},
          {"axis", json_of(joint.axis)}};
}

/// Names of a channel's values, one each.
std::vector<std::string> component_names(const Channel& channel) {
  if (channel.shape.empty()) return {""};
  if (channel.components.size() == channel.size()) return channel.components;
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= channel.size(); ++i) names.push_back(fmt::format("{}", i));
  return names;
}

/// The channels right below `group`, as curves.
Json curves_json(const RunReader& run, const FrameReader& reader, std::string_view group,
                 bool with_components) {
  Json all = Json::array();
  for (const Channel& channel : run.layout().channels()) {
    if (!channel.path.starts_with(group)) continue;
    if (!with_components && channel.size() != 1) continue;
    Json curve = {{"name", channel.path.substr(group.size())}, {"unit", channel.unit}};
    if (with_components) curve["components"] = component_names(channel);
    curve["values"] = reader.values(channel.path);
    all.push_back(std::move(curve));
  }
  return all;
}

/// Vibrations: every frame is one of them. Null for runs.
Json modes_json(const RunReader& run, const FrameReader& reader) {
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

/// How many frames keep the page below the size that browsers take well.
std::size_t frame_limit(const RunReader& run, const std::vector<PageBody>& bodies,
                        const ViewPageOptions& options) {
  const auto is_of_solid = [&](const Channel& channel) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const PageBody& body) {
      return body.is_solid() && channel.path.starts_with(fmt::format("bodies/{}/", body.name()));
    });
  };
  std::size_t values = 1;
  for (const Channel& channel : run.layout().channels()) {
    if (!is_of_solid(channel)) values += channel.size();
  }
  for (const PageBody& body : bodies) {
    if (body.is_solid()) values += body.values_per_frame();
  }
  return std::min(options.max_frames, options.max_bytes / (sizeof(float) * values));
}

Json page_json(const RunReader& run, const std::vector<PageBody>& shown,
               const FrameReader& reader) {
  const results::Geometry& geometry = run.geometry();
  Json bodies = Json::array();
  for (const PageBody& body : shown) bodies.push_back(body.json(reader));
  Json joints = Json::array();
  for (const results::GeometryJoint& joint : geometry.joints) joints.push_back(joint_json(joint));
  return {{"format", kFormat},
          {"title", run.title()},
          {"version", run.version()},
          {"generated", utc_now()},
          {"time", {{"n", reader.num_frames()}, {"f32", reader.times()}}},
          {"bodies", std::move(bodies)},
          {"joints", std::move(joints)},
          {"gravity", json_of(geometry.gravity)},
          {"planar", geometry.planar.empty() ? Json(nullptr) : Json(geometry.planar)},
          {"sensors", curves_json(run, reader, "sensors/", true)},
          {"energies", curves_json(run, reader, "energies/", false)},
          {"modes", modes_json(run, reader)},
          {"summary", parse_summary(run.summary_text())}};
}

/// JSON that may stand inside a <script> element: a name like "</script>" must not end it. These
/// characters occur in JSON only within strings, where escapes mean the same.
std::string script_text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else if (plain.compare(i, 3, "\u2028") == 0 || plain.compare(i, 3, "\u2029") == 0) {
      text += plain[i + 2] == '\xA8' ? "\\u2028" : "\\u2029";  // line ends in older JavaScript
      i += 2;
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

ViewPageReport write_view_page(const std::filesystem::path& run_directory,
                               const std::filesystem::path& template_html,
                               const std::filesystem::path& output_html,
                               const ViewPageOptions& options) {
  const RunReader run(run_directory);
  if (run.num_records() == 0) {
    throw IoError(fmt::format("{}: the run has no records yet, there is nothing to show.",
                              run_directory.string()));
  }
  std::string page = read_text_file(template_html);
  const std::size_t at = page.find(kMarker);
  if (at == page.npos || page.find(kMarker, at + 1) != page.npos) {
    throw IoError(
        fmt::format("{}: not the viewer's page: it must hold the text {} exactly once. "
                    "Install Buckens again.",
                    template_html.string(), kMarker));
  }
  const std::vector<PageBody> bodies(run.geometry().bodies.begin(), run.geometry().bodies.end());
  const std::size_t limit = frame_limit(run, bodies, options);
  const FrameReader reader(run, choose_frames(run.num_records(), limit));
  Json content = page_json(run, bodies, reader);
  const std::filesystem::path modes = run_directory / kModesName;
  std::error_code ignored;
  if (!content["modes"].is_null() && std::filesystem::exists(modes, ignored)) {
    content["summary"] = parse_summary(read_text_file(modes));
  }
  page.replace(at, kMarker.size(), script_text(content));
  replace_text_file(output_html, page);
  return {run.num_records(), reader.num_frames()};
}

}  // namespace buckens::io

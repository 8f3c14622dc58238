// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/summary_json.h"

#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/json_member.h"
#include "buckens/results/unassessed.h"

namespace buckens::run_store {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kSummaryFormat = 1;

Json head(RunStatus status, const std::string& title, const std::string& version,
          const std::string& started) {
  return {{"program", "buckens"}, {"format", kSummaryFormat}, {"status", to_string(status)},
          {"title", title},       {"version", version},       {"started", started}};
}

Json by_name(const std::vector<std::pair<std::string, double>>& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = value;
  return object;
}

/// Texts from a model file may hold broken UTF-8; a summary must not fail over that.
std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json bodies_json(const std::vector<results::BodyEffort>& bodies) {
  Json all = Json::object();
  for (const results::BodyEffort& body : bodies) {
    Json entry = {
        {"dof", body.dof}, {"factorisations", body.factorisations}, {"solves", body.solves}};
    if (body.recycled > 0) entry["recycled"] = body.recycled;
    if (!body.coupling.empty()) entry["coupling"] = body.coupling;
    for (const auto& [name, value] : body.measures) entry[name] = value;
    files::add_member(all, body.name, std::move(entry));
  }
  return all;
}

Json wall_json(const results::WallSeconds& wall) {
  return {{"total", wall.total},
          {"setup", wall.setup},
          {"stepping", wall.stepping},
          {"phases", by_name(wall.phases)},
          {"preparation", by_name(wall.preparation)}};
}

Json static_path_json(const results::StaticPathSummary& path) {
  Json points = Json::array();
  for (const results::CriticalPoint& point : path.critical_points) {
    points.push_back({{"kind", point.kind},
                      {"load_factor", point.load_factor},
                      {"t", point.position},
                      {"sensors", by_name(point.sensors)}});
  }
  return {{"load_factor", path.load_factor}, {"critical_points", std::move(points)}};
}

/// By side, kind and name: {"lost": {"joint-friction": {"pin": 1.5}}}.
Json energy_account_json(const results::EnergyAccount& account) {
  Json sides = {{"brought_in", Json::object()}, {"lost", Json::object()}, {"kept", Json::object()}};
  for (const results::EnergyEntry& entry : account.entries) {
    using Side = results::EnergyEntry::Side;
    Json& side = sides[entry.side == Side::brought_in ? "brought_in"
                       : entry.side == Side::lost     ? "lost"
                                                      : "kept"];
    side[entry.kind][entry.of.empty() ? "model" : entry.of] = entry.energy;
  }
  sides["unexplained"] = account.unexplained;
  return sides;
}

Json step_control_json(const results::StepControlEffort& control) {
  Json sizes = Json::array();
  for (const results::StepSizeEffort& size : control.sizes) {
    sizes.push_back(
        {{"step", size.step}, {"steps", size.steps}, {"factorisations", size.factorisations}});
  }
  return {{"controlled", control.is_controlled},
          {"rejected", control.rejected},
          {"failed", control.failed},
          {"smallest", control.smallest},
          {"largest", control.largest},
          {"sizes", std::move(sizes)}};
}

Json uncertain_json(const results::UncertainValue& value,
                    const std::vector<results::ErrorSource>& sources) {
  Json parts = Json::object();
  for (std::size_t k = 0; k < value.parts.size(); ++k) parts[sources[k].name] = value.parts[k];
  return {{"value", value.value},
          {"t", value.at},
          {"uncertainty", value.uncertainty},
          {"parts", std::move(parts)}};
}

Json errors_json(const results::ErrorStatement& errors) {
  Json runs = Json::array();
  for (const results::ErrorSource& source : errors.sources) {
    runs.push_back({{"source", source.name},
                    {"change", source.what},
                    {"refinement", source.refinement},
                    {"factor", source.factor},
                    {"steps", source.steps},
                    {"seconds", source.seconds}});
  }
  Json sensors = Json::object();
  for (const results::SensorErrors& sensor : errors.sensors) {
    sensors[sensor.name] = {{"unit", sensor.unit},
                            {"resolved", sensor.is_resolved},
                            {"sampling", sensor.sampling},
                            {"not_assessed", results::unassessed(errors)},
                            {"peak", uncertain_json(sensor.peak, errors.sources)},
                            {"final", uncertain_json(sensor.last, errors.sources)},
                            {"curve", uncertain_json(sensor.curve, errors.sources)}};
  }
  return {{"complete", errors.is_complete},
          {"runs", std::move(runs)},
          {"notes", errors.notes},
          {"sensors", std::move(sensors)}};
}

}  // namespace

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::starting:
      return "starting";
    case RunStatus::running:
      return "running";
    case RunStatus::finished:
      return "finished";
    case RunStatus::interrupted:
      break;
  }
  return "interrupted";
}

std::string status_json(RunStatus status, const std::string& title, const std::string& version,
                        const std::string& started) {
  return dump(head(status, title, version, started));
}

std::string summary_json(const results::RunSummary& summary, const std::string& started,
                         const std::string& ended) {
  const RunStatus status = summary.finished ? RunStatus::finished : RunStatus::interrupted;
  Json json = head(status, summary.title, summary.version, started);
  json["ended"] = ended;
  json["finished"] = summary.finished;
  json["interrupted"] = summary.interrupted.empty() ? Json(nullptr) : Json(summary.interrupted);
  json["end_time"] = summary.end_time;
  json["steps"] = summary.steps;
  json["step_control"] = step_control_json(summary.step_control);
  json["wall_seconds"] = wall_json(summary.wall_seconds);
  json["bodies"] = bodies_json(summary.bodies);
  json["setup_solves"] = summary.setup_solves;
  json["newton_iterations"] = {{"total", summary.newton_iterations.total},
                               {"per_step_mean", summary.newton_iterations.per_step_mean},
                               {"max", summary.newton_iterations.max}};
  json["residuals"] = {{"position", summary.residuals.position},
                       {"velocity", summary.residuals.velocity},
                       {"sieve", summary.residuals.sieve},
                       {"opening", summary.residuals.opening},
                       {"opening_rate", summary.residuals.opening_rate}};
  json["energy_error"] = summary.energy_error;
  if (summary.energy_account) json["energy_account"] = energy_account_json(*summary.energy_account);
  json["trust"] = summary.trust.empty() ? Json("ok") : Json(summary.trust);
  json["warnings"] = summary.warnings;
  json["notes"] = summary.notes;
  json["redundant_constraints"] = summary.redundant_constraints;
  if (summary.static_path) json["static_path"] = static_path_json(*summary.static_path);
  if (summary.errors) json["errors"] = errors_json(*summary.errors);
  if (!summary.measures.empty()) json["measures"] = by_name(summary.measures);
  return dump(json);
}

bool is_summary_json(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.value("program", nlohmann::json()) == "buckens" &&
         json.contains("status");
}

RunStatus status_in(std::string_view text, const std::string& where) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_object() && json.contains("status")) {
    for (const RunStatus status :
         {RunStatus::starting, RunStatus::running, RunStatus::finished, RunStatus::interrupted}) {
      if (json["status"] == to_string(status)) return status;
    }
  }
  throw IoError(fmt::format("{}: not the summary of a Buckens run.", where));
}

}  // namespace buckens::run_store

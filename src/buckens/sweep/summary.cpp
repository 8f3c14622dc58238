// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/summary.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/sensors_csv.h"
#include "buckens/run_store/summary_json.h"

namespace buckens::sweep {

namespace {

void add(SummaryCells& cells, std::string column, std::string cell) {
  cells.emplace_back(std::move(column), std::move(cell));
}

bool is_sensor(const results::Channel& channel) { return channel.path.starts_with("sensors/"); }

std::string number(double value) { return fmt::format("{:.17g}", value); }

using SummaryJson = nlohmann::json;

/// Numbers of the summary; 0 where they are missing or another program has put something else
/// there.
double number_in(const SummaryJson& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number() ? at->get<double>() : 0.0;
}

long count_in(const SummaryJson& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number_integer() ? at->get<long>() : 0;
}

std::string trust_in(const SummaryJson& trust) {
  if (trust.is_string()) return trust.get<std::string>();
  std::string out;
  for (const auto& reason : trust) {
    if (reason.is_string()) out += (out.empty() ? "" : "; ") + reason.get<std::string>();
  }
  return out;
}

void add_effort(SummaryCells& cells, const std::string& summary) {
  const auto json = SummaryJson::parse(summary);
  add(cells, "end_time [s]", number(number_in(json, "end_time")));
  add(cells, "steps", std::to_string(count_in(json, "steps")));
  long solves = 0;
  if (const auto bodies = json.find("bodies"); bodies != json.end() && bodies->is_object()) {
    for (const auto& body : *bodies) solves += body.is_object() ? count_in(body, "solves") : 0;
  }
  add(cells, "solves", std::to_string(solves));
  if (json.contains("energy_error") && json["energy_error"].is_number()) {
    add(cells, "energy_error", number(json["energy_error"].get<double>()));
  }
  if (json.contains("trust")) add(cells, "trust", trust_in(json["trust"]));
}

void add_channel(SummaryCells& cells, const results::Channel& channel,
                 const std::vector<Extremes>& extremes) {
  const std::vector<std::string> names = run_store::csv_column_names(channel);
  for (std::size_t k = 0; k < names.size(); ++k) {
    add(cells, names[k] + " last", number(extremes[k].last));
    add(cells, names[k] + " min", number(extremes[k].least));
    add(cells, names[k] + " max", number(extremes[k].most));
  }
}

SummaryCells cells_of_run(const run_store::RunReader& run) {
  SummaryCells cells;
  add_effort(cells, run.summary_text());
  for (const results::Channel& channel : run.layout().channels()) {
    if (!is_sensor(channel)) continue;
    const std::vector<double> values = run.read(channel.path);
    const std::size_t size = channel.size();
    if (values.size() < size) continue;
    std::vector<Extremes> extremes(size);
    for (std::size_t k = 0; k < values.size(); ++k) extremes[k % size].see(values[k]);
    add_channel(cells, channel, extremes);
  }
  return cells;
}

}  // namespace

void SensorExtremes::begin(const results::RecordLayout& layout, const results::Geometry&) {
  for (std::size_t c = 0; c < layout.channels().size(); ++c) {
    if (is_sensor(layout.channel(c))) {
      const results::Channel& channel = layout.channel(c);
      sensors_.push_back({channel, layout.offset(c), std::vector<Extremes>(channel.size())});
    }
  }
  // As a file of results lists them.
  std::sort(sensors_.begin(), sensors_.end(),
            [](const Sensor& a, const Sensor& b) { return a.channel.path < b.channel.path; });
}

void SensorExtremes::write(const results::Record& record) {
  ++num_records_;
  for (Sensor& sensor : sensors_) {
    for (std::size_t k = 0; k < sensor.extremes.size(); ++k) {
      sensor.extremes[k].see(record.values[sensor.offset + k]);
    }
  }
}

SummaryCells SensorExtremes::cells(const results::RunSummary& summary) const {
  SummaryCells cells;
  add_effort(cells, run_store::summary_json(summary, "", ""));
  for (const Sensor& sensor : sensors_) {
    if (num_records_ > 0) add_channel(cells, sensor.channel, sensor.extremes);
  }
  return cells;
}

SummaryCells summary_cells(const SweepTable& table, const Variant& variant,
                           const VariantOutcome& outcome) {
  SummaryCells cells;
  add(cells, "name", variant.name);
  for (std::size_t k = 0; k < table.paths.size(); ++k) {
    add(cells, table.paths[k], variant.values[k]);
  }
  add(cells, "status", to_string(outcome.status));
  add(cells, "message", outcome.message);
  return cells;
}

SummaryTable sweep_summary(const std::filesystem::path& out, const SweepTable& table,
                           const SweepOutcome& outcome) {
  SummaryTable summary;
  for (std::size_t v = 0; v < table.variants.size(); ++v) {
    const VariantOutcome& variant = outcome.variants[v];
    SummaryCells cells = summary_cells(table, table.variants[v], variant);
    if (variant.status == VariantStatus::done || variant.status == VariantStatus::kept) {
      const SummaryCells found = cells_of_run(run_store::RunReader(out / variant.name));
      cells.insert(cells.end(), found.begin(), found.end());
    }
    summary.add_row(cells);
  }
  return summary;
}

}  // namespace buckens::sweep

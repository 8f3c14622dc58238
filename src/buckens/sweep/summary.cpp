// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/summary.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/csv_row.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/sensors_csv.h"

namespace buckens::sweep {

namespace {

/// A row under construction: cells by column name. Columns keep the order of their first use.
class CsvTable {
 public:
  void begin_row() { rows_.emplace_back(); }
  void add(const std::string& column, const std::string& cell) {
    if (std::find(columns_.begin(), columns_.end(), column) == columns_.end()) {
      columns_.push_back(column);
    }
    rows_.back()[column] = cell;
  }

  std::string text() const {
    std::string out;
    for (const std::string& column : columns_) {
      out += (out.empty() ? "" : ",") + files::csv_cell(column);
    }
    for (const auto& row : rows_) {
      out += '\n';
      bool is_first = true;
      for (const std::string& column : columns_) {
        if (!is_first) out += ',';
        is_first = false;
        const auto cell = row.find(column);
        if (cell != row.end()) out += files::csv_cell(cell->second);
      }
    }
    return out + '\n';
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::map<std::string, std::string>> rows_;
};

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

void add_effort(CsvTable& table, const run_store::RunReader& run) {
  const auto json = SummaryJson::parse(run.summary_text());
  table.add("end_time [s]", number(number_in(json, "end_time")));
  table.add("steps", std::to_string(count_in(json, "steps")));
  long solves = 0;
  if (const auto bodies = json.find("bodies"); bodies != json.end() && bodies->is_object()) {
    for (const auto& body : *bodies) solves += body.is_object() ? count_in(body, "solves") : 0;
  }
  table.add("solves", std::to_string(solves));
  if (json.contains("energy_error") && json["energy_error"].is_number()) {
    table.add("energy_error", number(json["energy_error"].get<double>()));
  }
  if (json.contains("trust")) table.add("trust", trust_in(json["trust"]));
}

void add_sensors(CsvTable& table, const run_store::RunReader& run) {
  for (const results::Channel& channel : run.layout().channels()) {
    if (!channel.path.starts_with("sensors/")) continue;
    const std::vector<double> values = run.read(channel.path);
    const std::size_t size = channel.size();
    if (values.size() < size) continue;
    const std::vector<std::string> names = run_store::csv_column_names(channel);
    for (std::size_t k = 0; k < size; ++k) {
      double least = values[k], most = values[k], last = values[k];
      for (std::size_t at = k; at < values.size(); at += size) {
        last = values[at];
        least = std::min(least, last);
        most = std::max(most, last);
      }
      table.add(names[k] + " last", number(last));
      table.add(names[k] + " min", number(least));
      table.add(names[k] + " max", number(most));
    }
  }
}

}  // namespace

std::string sweep_summary_csv(const std::filesystem::path& out, const SweepTable& table,
                              const SweepOutcome& outcome) {
  CsvTable csv;
  for (std::size_t v = 0; v < table.variants.size(); ++v) {
    const VariantOutcome& variant = outcome.variants[v];
    csv.begin_row();
    csv.add("name", variant.name);
    for (std::size_t k = 0; k < table.paths.size(); ++k) {
      csv.add(table.paths[k], table.variants[v].values[k]);
    }
    csv.add("status", to_string(variant.status));
    csv.add("message", variant.message);
    if (variant.status != VariantStatus::done && variant.status != VariantStatus::kept) continue;
    const run_store::RunReader run(out / variant.name);
    add_effort(csv, run);
    add_sensors(csv, run);
  }
  return csv.text();
}

}  // namespace buckens::sweep

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

void add_effort(CsvTable& table, const run_store::RunReader& run) {
  const auto json = nlohmann::json::parse(run.summary_text());
  table.add("end_time [s]", number(json.value("end_time", 0.0)));
  table.add("steps", std::to_string(json.value("steps", 0L)));
  long solves = 0;
  for (const auto& body : json.value("bodies", nlohmann::json::array())) {
    solves += body.value("solves", 0L);
  }
  table.add("solves", std::to_string(solves));
  if (json.contains("energy_error") && json["energy_error"].is_number()) {
    table.add("energy_error", number(json["energy_error"].get<double>()));
  }
  if (!json.contains("trust")) return;
  std::string trust;
  if (json["trust"].is_string()) trust = json["trust"].get<std::string>();
  for (const auto& reason : json["trust"]) {
    if (json["trust"].is_array()) trust += (trust.empty() ? "" : "; ") + reason.get<std::string>();
  }
  table.add("trust", trust);
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

// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/csv.h"

#include <array>
#include <cmath>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/csv_row.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/sensors_csv.h"

namespace buckens::exports {

namespace {

constexpr std::size_t kPiece = 1U << 20U;  // bytes written at once

/// A table that goes to its file in large pieces.
class Table {
 public:
  Table(const std::filesystem::path& path, const std::string& head) : file_(path), text_(head) {}

  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }
  void put_value(double value) {
    if (std::isnan(value)) {
      text_ += ',';
    } else {
      put(",{:.9g}", value);
    }
  }
  void end_line() {
    text_ += '\n';
    if (text_.size() < kPiece) return;
    file_.write(text_);
    text_.clear();
  }
  void close() {
    file_.write(text_);
    file_.close();
  }

 private:
  files::OutputFile file_;
  std::string text_;
};

/// Heads of the columns of one field: one per component.
std::string heads_of(const results::Channel& channel, const std::string& name) {
  if (channel.shape.size() < 2)
    return ',' + files::csv_cell(fmt::format("{} [{}]", name, channel.unit));
  std::string out;
  if (channel.shape.size() == 3) {  // levels of shells: bottom and top of each layer
    for (int level = 0; level < channel.shape[1]; ++level) {
      for (const std::string& component : channel.components) {
        out += ',' + files::csv_cell(fmt::format("{}.{}.{}{} [{}]", name, component, level / 2 + 1,
                                                 level % 2 == 0 ? "-" : "+", channel.unit));
      }
    }
    return out;
  }
  for (const std::string& component : channel.components) {
    out += ',' + files::csv_cell(fmt::format("{}.{} [{}]", name, component, channel.unit));
  }
  return out;
}

void write_sensors(const run_store::RunReader& run, const std::filesystem::path& path) {
  struct Column {
    std::vector<double> values;
    std::size_t width;
  };
  std::string head = "t [s]";
  std::vector<Column> columns;
  for (const results::Channel* channel : run.sensors()) {
    for (const std::string& name : run_store::csv_column_names(*channel))
      head += ',' + files::csv_cell(name);
    columns.push_back({run.read(channel->path), channel->size()});
  }
  Table table(path, head + '\n');
  for (std::size_t row = 0; row < run.num_records(); ++row) {
    table.put("{:.17g}", run.times()[row]);
    for (const Column& column : columns) {
      for (std::size_t k = 0; k < column.width; ++k) {
        table.put(",{:.17g}", column.values[row * column.width + k]);
      }
    }
    table.end_line();
  }
  table.close();
}

std::vector<int> places_of(const results::GeometryBody& body, const std::string& location) {
  if (location == "nodes") return body.field_nodes;
  return location == "shells" ? run_store::shells_of(body) : body.field_elements;
}

/// Fields of one body at nodes, solids or shells.
void write_fields(const run_store::RunReader& run, const std::vector<run_store::Instant>& instants,
                  const results::GeometryBody& body, const std::string& location,
                  const std::filesystem::path& path) {
  const bool at_nodes = location == "nodes";
  const std::vector<int> places = places_of(body, location);
  std::string head = at_nodes ? "t [s],node,x [m],y [m],z [m]" : "t [s],element";
  std::vector<const results::Channel*> channels;
  for (const std::string& name : run_store::field_names(run, body.name, location)) {
    channels.push_back(run_store::find_channel(
        run.field_layout(), fmt::format("fields/bodies/{}/{}/{}", body.name, location, name)));
    head += heads_of(*channels.back(), name);
  }
  Table table(path, head + '\n');
  for (const run_store::Instant& now : instants) {
    if (!now.field_row) continue;
    std::vector<std::vector<double>> values;
    for (const results::Channel* channel : channels) {
      values.push_back(run.read_fields(channel->path, std::array{*now.field_row}));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
      table.put("{:.17g},{}", now.t, places[p] + 1);
      for (int k = 0; at_nodes && k < 3; ++k) table.put_value(body.nodes(places[p], k));
      for (const std::vector<double>& of_field : values) {
        const std::size_t width = of_field.size() / places.size();
        for (std::size_t k = 0; k < width; ++k) table.put_value(of_field[p * width + k]);
      }
      table.end_line();
    }
  }
  table.close();
}

/// Forces and torques on one body, a column per place and component.
bool write_loads(const run_store::RunReader& run, const std::vector<run_store::Instant>& instants,
                 const std::string& body, const std::filesystem::path& path) {
  const std::string group = fmt::format("fields/bodies/{}/", body);
  std::string head = "t [s]";
  std::vector<std::string> channels;
  for (const results::Channel& channel : run.field_layout().channels()) {
    if (!channel.path.starts_with(group)) continue;
    const std::string place = channel.path.substr(group.size());
    if (!place.starts_with("interfaces/") && !place.starts_with("loads/")) continue;
    channels.push_back(channel.path);
    const std::string name = place.substr(place.find('/') + 1);
    for (std::size_t k = 0; k < channel.components.size(); ++k) {
      head += ',' + files::csv_cell(fmt::format("{}.{} [{}]", name, channel.components[k],
                                                k < 3 ? "N" : "N m"));
    }
  }
  if (channels.empty()) return false;
  Table table(path, head + '\n');
  for (const run_store::Instant& now : instants) {
    if (!now.field_row) continue;
    table.put("{:.17g}", now.t);
    for (const std::string& channel : channels) {
      for (const double value : run.read_fields(channel, std::array{*now.field_row})) {
        table.put_value(value);
      }
    }
    table.end_line();
  }
  table.close();
  return true;
}

bool write_extremes(const run_store::RunReader& run, const results::GeometryBody& body,
                    const std::string& location, const std::filesystem::path& path) {
  const std::string place = fmt::format("extremes/bodies/{}/{}/von_mises", body.name, location);
  const std::vector<double> largest = run.read_fixed(place);
  const std::vector<double> times = run.read_fixed(place + "_time");
  const bool at_nodes = location == "nodes";
  const std::vector<int> places = places_of(body, location);
  if (largest.empty() || largest.size() != places.size() || times.size() != places.size()) {
    return false;
  }
  Table table(path, at_nodes ? "node,x [m],y [m],z [m],von_mises [Pa],at [s]\n"
                             : "element,von_mises [Pa],at [s]\n");
  for (std::size_t p = 0; p < places.size(); ++p) {
    table.put("{}", places[p] + 1);
    for (int k = 0; at_nodes && k < 3; ++k) table.put_value(body.nodes(places[p], k));
    table.put_value(largest[p]);
    table.put_value(times[p]);
    table.end_line();
  }
  table.close();
  return true;
}

}  // namespace

std::vector<std::string> export_csv(const run_store::RunReader& run,
                                    const run_store::InstantChoice& choice,
                                    const std::filesystem::path& directory) {
  const std::vector<run_store::Instant> instants = run_store::choose_instants(run, choice);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw IoError(
        fmt::format("{}: cannot create the directory: {}.", directory.string(), error.message()));
  }
  std::vector<std::string> files = {"sensors.csv"};
  write_sensors(run, directory / files.front());
  for (const results::GeometryBody& body : run.geometry().bodies) {
    for (const std::string location : {"nodes", "elements", "shells"}) {
      if (!run_store::field_names(run, body.name, location).empty()) {
        files.push_back(fmt::format("{}_{}.csv", body.name, location));
        write_fields(run, instants, body, location, directory / files.back());
      }
      const std::string name = fmt::format("{}_{}_extremes.csv", body.name, location);
      if (write_extremes(run, body, location, directory / name)) files.push_back(name);
    }
    const std::string loads = body.name + "_loads.csv";
    if (write_loads(run, instants, body.name, directory / loads)) files.push_back(loads);
  }
  return files;
}

}  // namespace buckens::exports

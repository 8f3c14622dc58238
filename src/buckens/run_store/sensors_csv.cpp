// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/sensors_csv.h"

#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "buckens/files/csv_row.h"

namespace buckens::run_store {

namespace {

constexpr std::string_view kSensorGroup = "sensors/";

}  // namespace

std::vector<std::string> csv_column_names(const results::Channel& channel) {
  const std::string_view path = channel.path;
  const std::string_view name =
      path.starts_with(kSensorGroup) ? path.substr(kSensorGroup.size()) : path;
  const std::string unit = channel.unit.empty() ? "1" : channel.unit;
  if (channel.shape.empty()) return {fmt::format("{} [{}]", name, unit)};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < channel.size(); ++i) {
    const bool named = channel.shape.size() == 1 && i < channel.components.size();
    const std::string component = named ? channel.components[i] : fmt::format("{}", i + 1);
    names.push_back(component.empty() ? fmt::format("{} [{}]", name, unit)
                                      : fmt::format("{}.{} [{}]", name, component, unit));
  }
  return names;
}

SensorsCsv::SensorsCsv(const std::filesystem::path& path, const results::RecordLayout& layout)
    : file_(path, files::OutputFile::Start::anew) {
  line_ = "t [s]";
  for (std::size_t index = 0; index < layout.channels().size(); ++index) {
    const results::Channel& channel = layout.channel(index);
    if (!channel.path.starts_with(kSensorGroup)) continue;
    std::size_t position = layout.offset(index);
    for (const std::string& name : csv_column_names(channel)) {
      line_ += ',' + files::csv_cell(name);
      positions_.push_back(position++);
    }
  }
  line_ += '\n';
  file_.write(line_);
}

void SensorsCsv::write(const results::Record& record) {
  line_.clear();
  const auto out = std::back_inserter(line_);
  fmt::format_to(out, "{:.17g}", record.t);
  for (const std::size_t position : positions_) {
    fmt::format_to(out, ",{:.17g}", record.values[position]);
  }
  line_ += '\n';
  file_.write(line_);
}

}  // namespace buckens::run_store

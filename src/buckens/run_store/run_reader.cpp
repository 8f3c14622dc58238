// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/results/stored_size.h"
#include "buckens/run_store/hdf5_geometry.h"
#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/run_channels.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::run_store {

namespace {

/// The instants up to `last`; all if it is not among them. Later ones are not touched, but for
/// those that lie in one piece of the file with it.
std::vector<double> read_up_to(const Hdf5File& file, const std::string& path, double last) {
  if (last < 0.0) return {};
  const Hdf5Quiet quiet;
  const Hdf5Dataset dataset = open_dataset(file, path, Hdf5Values::numbers, 0);
  if (dataset.extents.size() != 1) return read_double_dataset(file, path);
  const std::size_t piece = results::chunk_rows(1);
  std::vector<double> times;
  while (times.size() < dataset.extents[0]) {
    const std::size_t first = times.size();
    times.resize(std::min<std::size_t>(dataset.extents[0], first + piece));
    read_rows(file, dataset, path, first, times.size() - first, times.data() + first);
    const auto found =
        std::find(times.begin() + static_cast<std::ptrdiff_t>(first), times.end(), last);
    if (found == times.end()) continue;
    times.erase(found + 1, times.end());
    break;
  }
  return times;
}

/// Calls a function with the first index and the number of each stretch of neighbouring records:
/// they are read together.
void each_stretch(std::span<const std::size_t> records,
                  const std::function<void(std::size_t first, std::size_t count)>& read) {
  for (std::size_t i = 0; i < records.size();) {
    std::size_t count = 1;
    while (i + count < records.size() && records[i + count] == records[i] + count) ++count;
    read(i, count);
    i += count;
  }
}

}  // namespace

RunReader::RunReader(const std::filesystem::path& directory, const AtCheckpoint& at)
    : directory_(directory) {
  const std::filesystem::path summary = directory / kSummaryName;
  std::error_code ignored;
  if (!std::filesystem::exists(summary, ignored)) {
    throw IoError(
        fmt::format("{}: not a run directory: it holds no {}. Give the directory that "
                    "`buckens run` has written (-o).",
                    directory.string(), kSummaryName));
  }
  summary_text_ = files::read_text_file(summary);
  status_ = status_in(summary_text_, summary.string());
  if (!std::filesystem::exists(directory / kResultsName, ignored)) {
    throw IoError(
        fmt::format("{}: the run has no results: {} is missing. It is still starting, or "
                    "ended before its first record; see {}.",
                    directory.string(), kResultsName, kLogName));
  }
  const std::filesystem::path results = directory / kResultsName;
  const auto try_reading = [&](const std::shared_ptr<Hdf5Texts>& texts) {
    RunReader trial;
    trial.open(results, texts, at);
    trial.touch_channels();
  };
  open(results, read_texts_apart(results, try_reading), at);
}

void RunReader::open(const std::filesystem::path& results, const std::shared_ptr<Hdf5Texts>& texts,
                     const AtCheckpoint& at) {
  file_ = Hdf5File::open_for_reading(results, texts, at.undone);
  title_ = read_string(file_, "/", "title");
  version_ = read_string(file_, "/", "version");
  geometry_ = read_geometry(file_);
  // A run that goes on writes the channels, then the time, then fields, then theirs. In reverse,
  // each instant of fields is one of the records, and every channel has rows for all of them.
  const bool has_fields = has_object(file_, "/fields/time");
  if (has_fields) field_times_ = read_times("/fields/time", at.last_fields);
  times_ = read_times("/time", at.last_record);
  for (const double t : field_times_) {
    if (!std::binary_search(times_.begin(), times_.end(), t)) {
      refuse(file_, "/fields/time", fmt::format("holds t = {} s, which is no record", t));
    }
  }
  if (has_fields) field_layout_ = read_layout(file_, "/fields", field_times_.size());
  layout_ = read_layout(file_, "/", times_.size());
  check_channels(file_, geometry_, layout_, field_layout_);
}

std::vector<const results::Channel*> RunReader::sensors() const {
  constexpr std::string_view kGroup = "sensors/";
  std::vector<const results::Channel*> found;
  for (const results::Channel& channel : layout_.channels()) {
    if (channel.path.starts_with(kGroup)) found.push_back(&channel);
  }
  // HDF5 lists them by their names; the table has them as the model file does.
  std::ifstream table(directory_ / kSensorsName);
  std::string heading;
  std::getline(table, heading);
  const auto column = [&](const results::Channel* channel) {
    const std::string name = ',' + channel->path.substr(kGroup.size());
    return std::min(heading.find(name + " ["), heading.find(name + '.'));
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto* a, const auto* b) { return column(a) < column(b); });
  return found;
}

/// Makes HDF5 look up where the values of each channel lie.
void RunReader::touch_channels() const {
  constexpr std::size_t kFewValues = 1 << 17;
  const std::array<std::size_t, 1> first{};
  for (const results::Channel& channel : layout_.channels()) {
    if (num_records() > 0 && channel.size() < kFewValues) read(channel.path, first);
  }
  for (const results::Channel& channel : field_layout_.channels()) {
    if (!field_times_.empty() && channel.size() < kFewValues) read_fields(channel.path, first);
  }
}

std::vector<double> RunReader::read_times(const std::string& path, double last) const {
  std::vector<double> times =
      last < HUGE_VAL ? read_up_to(file_, path, last) : read_double_dataset(file_, path);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k]) || (k > 0 && times[k] < times[k - 1])) {
      refuse(file_, path, fmt::format("holds {} as its instant number {}", times[k], k + 1));
    }
  }
  return times;
}

std::vector<double> RunReader::read(std::string_view path) const {
  std::vector<std::size_t> all(num_records());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return read(path, all);
}

std::vector<double> RunReader::read(std::string_view path,
                                    std::span<const std::size_t> records) const {
  if (layout_.find(path) < 0) {
    if (const auto part = find_part(path)) return read_part(*part, records);
  }
  return read_rows_of(layout_, path, records);
}

std::optional<results::Channel> RunReader::find(std::string_view path) const {
  const int index = layout_.find(path);
  if (index >= 0) return layout_.channel(static_cast<std::size_t>(index));
  if (const auto part = find_part(path)) return part->channel;
  return std::nullopt;
}

std::optional<results::TablePart> RunReader::find_part(std::string_view path) const {
  const auto row_in = [](base::NameIndex& index, const auto& list, const std::string& name) {
    const auto* found = index.find(list, name);
    return found == nullptr ? -1 : static_cast<int>(found - list.data());
  };
  return results::find_in_tables(
      layout_, path,
      [&](const std::string& name) { return row_in(bodies_, geometry_.bodies, name); },
      [&](const std::string& name) { return row_in(joints_, geometry_.joints, name); });
}

std::vector<double> RunReader::read_part(const results::TablePart& part,
                                         std::span<const std::size_t> records) const {
  const results::Channel& table = layout_.channel(part.table);
  const RowWish wish{table.path,
                     static_cast<std::size_t>(table.shape[0]),
                     static_cast<std::size_t>(table.shape[1]),
                     part.row,
                     part.first,
                     part.channel.size()};
  return table_rows_.get(wish, records,
                         [&](const std::string& path, std::span<const std::size_t> wanted,
                             std::size_t first, std::size_t count) {
                           const Hdf5Dataset dataset = open_channel(file_, table);
                           const std::size_t size = count * wish.width;
                           std::vector<double> values(wanted.size() * size);
                           each_stretch(wanted, [&](std::size_t k, std::size_t rows) {
                             read_rows(file_, dataset, '/' + path, wanted[k], rows, {first, count},
                                       values.data() + k * size);
                           });
                           return values;
                         });
}

std::vector<double> RunReader::read_fields(std::string_view path,
                                           std::span<const std::size_t> rows) const {
  return read_rows_of(field_layout_, path, rows);
}

std::vector<double> RunReader::read_fixed(std::string_view path) const {
  const std::string place = fmt::format("/{}", path);
  return has_object(file_, place) ? read_any_double_dataset(file_, place) : std::vector<double>();
}

std::size_t RunReader::record_of_field(std::size_t row) const {
  const auto at = std::lower_bound(times_.begin(), times_.end(), field_times_.at(row));
  return static_cast<std::size_t>(at - times_.begin());
}

std::vector<double> RunReader::read_rows_of(const results::RecordLayout& layout,
                                            std::string_view path,
                                            std::span<const std::size_t> records) const {
  const int index = layout.find(path);
  if (index < 0) {
    throw IoError(fmt::format("{}: holds no \"{}\".", file_.path().string(), path));
  }
  const std::string place = fmt::format("/{}", path);
  const Hdf5Dataset dataset = open_channel(file_, layout.channel(static_cast<std::size_t>(index)));
  const std::size_t size = dataset.row_size;
  std::vector<double> values(records.size() * size);
  each_stretch(records, [&](std::size_t k, std::size_t count) {
    read_rows(file_, dataset, place, records[k], count, values.data() + k * size);
  });
  return values;
}

}  // namespace buckens::run_store

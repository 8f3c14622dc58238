// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/kept_records.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {

namespace {

constexpr std::size_t kBlockValues = 2U << 20U;  // copied at once: 16 MB
constexpr char kSteered[] = "steered";

std::vector<double> up_to(const std::vector<double>& times, double last,
                          const std::filesystem::path& file) {
  std::vector<double> kept(times.begin(), std::upper_bound(times.begin(), times.end(), last));
  if (last < 0.0 || (!kept.empty() && kept.back() == last)) return kept;
  throw IoError(
      fmt::format("{}: the record at t = {:.9g} s, at which the checkpoint was written, is "
                  "missing: the files do not belong together; run the model from the start",
                  file.string(), last));
}

using ReadRows =
    std::function<std::vector<double>(const std::string& path, std::span<const std::size_t> rows)>;

/// @param here,there channels of the continued run and of the file
void check_channels(const results::RecordLayout& here, const results::RecordLayout& there,
                    const std::filesystem::path& file) {
  for (const results::Channel& channel : here.channels()) {
    const int found = there.find(channel.path);
    const bool is_same =
        found >= 0 && there.channel(static_cast<std::size_t>(found)).shape == channel.shape;
    if (is_same) continue;
    throw IoError(fmt::format(
        "{}: {} \"{}\", which this run records; run the model from the start", file.string(),
        found < 0 ? "holds no" : "holds values of another shape in", channel.path));
  }
}

void copy_rows(const std::vector<double>& times, const results::RecordLayout& layout,
               const ReadRows& read, const AppendRows& append) {
  const std::size_t width = std::max<std::size_t>(layout.num_values(), 1);
  const std::size_t most = std::max<std::size_t>(kBlockValues / width, 1);
  for (std::size_t first = 0; first < times.size(); first += most) {
    std::vector<std::size_t> rows(std::min(most, times.size() - first));
    std::iota(rows.begin(), rows.end(), first);
    std::vector<double> values(rows.size() * layout.num_values());
    for (std::size_t c = 0; c < layout.channels().size(); ++c) {
      const std::size_t size = layout.channel(c).size();
      const std::vector<double> column = read(layout.channel(c).path, rows);
      for (std::size_t row = 0; row < rows.size(); ++row) {
        std::copy_n(column.data() + row * size, size,
                    values.data() + row * layout.num_values() + layout.offset(c));
      }
    }
    append({times.data() + first, rows.size()}, values);
  }
}

AtCheckpoint at_checkpoint(const std::filesystem::path& directory, const Continuation& until) {
  const std::string mark = checkpoint_mark(directory / kCheckpointName);
  return {until.last_record, until.last_fields, read_undone(directory, mark)};
}

double number_in(const base::SavedValues& state, const std::string& name) {
  const auto found = state.numbers.find(name);
  if (found != state.numbers.end() && found->second.size() == 1) return found->second.front();
  throw IoError(
      fmt::format("this is no checkpoint of a run: it holds no {}; run the model from "
                  "the start",
                  name));
}

}  // namespace

Continuation continuation_from(const base::SavedValues& checkpoint) {
  return {number_in(checkpoint, "recording/last_due"),
          number_in(checkpoint, "recording/last_due_fields"),
          number_in(checkpoint, "state/t"),
          number_in(checkpoint, "march_start"),
          number_in(checkpoint, "longest_step"),
          checkpoint.texts.contains(kSteered)};
}

void mark_steered(base::SavedValues& checkpoint) { checkpoint.texts[kSteered] = {"yes"}; }

KeptRecords::KeptRecords(const std::filesystem::path& directory, const Continuation& until)
    : file_(directory / kResultsName),
      reader_(directory, at_checkpoint(directory, until)),
      times_(up_to(reader_.times(), until.last_record, file_)),
      field_times_(up_to(reader_.field_times(), until.last_fields, file_)) {}

void KeptRecords::copy_records(const results::RecordLayout& layout,
                               const AppendRows& append) const {
  check_channels(layout, reader_.layout(), file_);
  copy_rows(
      times_, layout,
      [this](const std::string& path, std::span<const std::size_t> rows) {
        return reader_.read(path, rows);
      },
      append);
}

void KeptRecords::copy_fields(const results::RecordLayout& layout, const AppendRows& append) const {
  check_channels(layout, reader_.field_layout(), file_);
  copy_rows(
      field_times_, layout,
      [this](const std::string& path, std::span<const std::size_t> rows) {
        return reader_.read_fields(path, rows);
      },
      append);
}

}  // namespace buckens::run_store

// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/frames.h"

#include <algorithm>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "buckens/files/base64.h"
#include "buckens/page/rows.h"

namespace buckens::page {

namespace {

/// Fewer instants of fields make no film.
constexpr std::size_t kFewInstants = 20;

/// Evenly spread numbers below `count`, the first and the last among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t limit) {
  const std::size_t kept = std::min(count, std::max<std::size_t>(limit, 2));
  std::vector<std::size_t> numbers(kept);
  for (std::size_t i = 0; i < kept; ++i) numbers[i] = kept == 1 ? 0 : i * (count - 1) / (kept - 1);
  return numbers;
}

}  // namespace

PageFrames choose_frames(const run_store::RunReader& run, bool with_fields, std::size_t limit) {
  PageFrames out;
  const std::size_t instants = with_fields ? run.field_times().size() : 0;
  const std::size_t records = run.num_records();
  if (instants < std::min(records, kFewInstants)) out.records = spread(records, limit);
  out.field_rows = spread(instants, limit);
  for (const std::size_t row : out.field_rows) out.records.push_back(run.record_of_field(row));
  std::sort(out.records.begin(), out.records.end());
  out.records.erase(std::unique(out.records.begin(), out.records.end()), out.records.end());
  for (const std::size_t row : out.field_rows) {
    const auto at =
        std::lower_bound(out.records.begin(), out.records.end(), run.record_of_field(row));
    out.field_frames.push_back(static_cast<int>(at - out.records.begin()));
  }
  return out;
}

FrameReader::FrameReader(const run_store::RunReader& run, PageFrames frames, bool coded)
    : run_(run), frames_(std::move(frames)), coded_(coded) {}

std::string FrameReader::times() const {
  std::vector<double> times;
  for (const std::size_t frame : frames_.records) times.push_back(run_.times()[frame]);
  return files::base64_float32(times);
}

std::string FrameReader::values(const std::string& path) const {
  return files::base64_float32(run_.read(path, frames_.records));
}

nlohmann::ordered_json FrameReader::rows(const std::string& path, const Choose& choose) const {
  PageRowsWriter writer(coded_);
  // Frame by frame: a whole field over all frames may not fit into memory.
  for (const std::size_t frame : frames_.records) {
    writer.add(choose(run_.read(path, std::span(&frame, 1))));
  }
  return writer.json();
}

nlohmann::ordered_json FrameReader::field_rows(const std::string& path,
                                               const Choose& choose) const {
  PageRowsWriter writer(coded_);
  for (const std::size_t row : frames_.field_rows) {
    writer.add(choose(run_.read_fields(path, std::span(&row, 1))));
  }
  return writer.json();
}

nlohmann::ordered_json FrameReader::fixed_row(const std::string& path, const Choose& choose) const {
  PageRowsWriter writer(false);
  writer.add(choose(run_.read_fixed(path)));
  return writer.json();
}

std::vector<double> FrameReader::scalars(const std::string& path) const {
  if (size_of(path) != 1) return {};
  return run_.read(path, frames_.records);
}

std::size_t FrameReader::size_of(const std::string& path) const {
  const auto channel = run_.find(path);
  return channel ? channel->size() : 0;
}

std::vector<double> values_at(const std::vector<double>& all, const std::vector<std::size_t>& at) {
  std::vector<double> out;
  out.reserve(at.size());
  for (const std::size_t place : at) out.push_back(all.at(place));
  return out;
}

}  // namespace buckens::page

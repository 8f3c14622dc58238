// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page_frames.h"

#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "buckens/io/base64.h"
#include "buckens/io/view_page_rows.h"

namespace buckens::io {

FrameReader::FrameReader(const RunReader& run, std::vector<std::size_t> frames, bool coded)
    : run_(run), frames_(std::move(frames)), coded_(coded) {}

std::string FrameReader::times() const {
  std::vector<double> times;
  for (const std::size_t frame : frames_) times.push_back(run_.times()[frame]);
  return base64_float32(times);
}

std::string FrameReader::values(const std::string& path) const {
  return base64_float32(run_.read(path, frames_));
}

nlohmann::ordered_json FrameReader::rows(const std::string& path, const Choose& choose) const {
  PageRowsWriter writer(coded_);
  // Frame by frame: a whole field over all frames may not fit into memory.
  for (const std::size_t frame : frames_) {
    writer.add(choose(run_.read(path, std::span(&frame, 1))));
  }
  return writer.json();
}

std::vector<double> FrameReader::scalars(const std::string& path) const {
  if (size_of(path) != 1) return {};
  return run_.read(path, frames_);
}

std::size_t FrameReader::size_of(const std::string& path) const {
  const int index = run_.layout().find(path);
  return index < 0 ? 0 : run_.layout().channel(static_cast<std::size_t>(index)).size();
}

std::vector<double> values_at(const std::vector<double>& all, const std::vector<std::size_t>& at) {
  std::vector<double> out;
  out.reserve(at.size());
  for (const std::size_t place : at) out.push_back(all.at(place));
  return out;
}

}  // namespace buckens::io

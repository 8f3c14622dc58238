// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page_frames.h"

#include <span>
#include <utility>

#include "buckens/io/base64.h"

namespace buckens::io {

FrameReader::FrameReader(const RunReader& run, std::vector<std::size_t> frames)
    : run_(run), frames_(std::move(frames)) {}

std::string FrameReader::times() const {
  std::vector<double> times;
  for (const std::size_t frame : frames_) times.push_back(run_.times()[frame]);
  return base64_float32(times);
}

std::string FrameReader::values(const std::string& path) const {
  return base64_float32(numbers(path));
}

std::string FrameReader::values_at(const std::string& path,
                                   const std::vector<std::size_t>& places) const {
  std::vector<double> out;
  out.reserve(frames_.size() * places.size());
  // Frame by frame: a whole field over all frames may not fit into memory.
  for (const std::size_t frame : frames_) {
    const std::vector<double> all = run_.read(path, std::span(&frame, 1));
    for (const std::size_t place : places) out.push_back(all.at(place));
  }
  return base64_float32(out);
}

std::vector<double> FrameReader::numbers(const std::string& path) const {
  return run_.read(path, frames_);
}

std::vector<double> FrameReader::scalars(const std::string& path) const {
  if (size_of(path) != 1) return {};
  return numbers(path);
}

std::size_t FrameReader::size_of(const std::string& path) const {
  const int index = run_.layout().find(path);
  return index < 0 ? 0 : run_.layout().channel(static_cast<std::size_t>(index)).size();
}

}  // namespace buckens::io

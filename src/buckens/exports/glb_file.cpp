// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/glb_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/files/output_file.h"

namespace buckens::exports {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification.
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

void append(std::string& out, std::uint32_t value) {
  std::array<char, sizeof value> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.size());
}

/// Chunks begin at multiples of four.
void pad(std::string& text, char filler) {
  while (text.size() % 4 != 0) text += filler;
}

}  // namespace

GlbFile::GlbFile() : views_(Json::array()), accessors_(Json::array()) {
  root["asset"] = {{"version", "2.0"}, {"generator", fmt::format("buckens {}", kVersion)}};
}

int GlbFile::add(const void* data, std::size_t bytes, std::size_t count, int component_type,
                 const char* type, int target) {
  pad(buffer_, '\0');
  Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes}};
  if (target != 0) view["target"] = target;
  buffer_.append(static_cast<const char*>(data), bytes);
  accessors_.push_back({{"bufferView", views_.size()},
                        {"componentType", component_type},
                        {"count", count},
                        {"type", type}});
  views_.push_back(std::move(view));
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbFile::add_vectors(const Eigen::Matrix3Xf& values, bool bounds) {
  const auto count = static_cast<std::size_t>(values.cols());
  const int index = add(values.data(), 3 * count * sizeof(float), count, kFloat, "VEC3", kVertices);
  if (bounds && count > 0) {
    const Eigen::Vector3f least = values.rowwise().minCoeff();
    const Eigen::Vector3f most = values.rowwise().maxCoeff();
    accessors_.back()["min"] = {least.x(), least.y(), least.z()};
    accessors_.back()["max"] = {most.x(), most.y(), most.z()};
  }
  return index;
}

int GlbFile::add_floats(const std::vector<float>& values, bool bounds) {
  const int index =
      add(values.data(), values.size() * sizeof(float), values.size(), kFloat, "SCALAR", 0);
  if (bounds && !values.empty()) {
    accessors_.back()["min"] = {*std::min_element(values.begin(), values.end())};
    accessors_.back()["max"] = {*std::max_element(values.begin(), values.end())};
  }
  return index;
}

int GlbFile::add_quaternions(const std::vector<std::array<float, 4>>& values) {
  return add(values.data(), values.size() * sizeof values[0], values.size(), kFloat, "VEC4", 0);
}

int GlbFile::add_colours(const std::vector<std::array<std::uint8_t, 4>>& values) {
  const int index = add(values.data(), values.size() * sizeof values[0], values.size(),
                        kUnsignedByte, "VEC4", kVertices);
  accessors_.back()["normalized"] = true;
  return index;
}

int GlbFile::add_indices(const std::vector<std::uint32_t>& values) {
  return add(values.data(), values.size() * sizeof values[0], values.size(), kUnsignedInt, "SCALAR",
             kIndices);
}

void GlbFile::write(const std::filesystem::path& path) const {
  std::string binary = buffer_;
  pad(binary, '\0');
  Json all = root;
  if (!binary.empty()) {
    all["buffers"] = {{{"byteLength", binary.size()}}};
    all["bufferViews"] = views_;
    all["accessors"] = accessors_;
  }
  std::string json = all.dump(-1, ' ', false, Json::error_handler_t::replace);
  pad(json, ' ');
  const std::size_t size = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw IoError(fmt::format(
        "{}: a .glb file holds at most 4 GB. Export fewer instants or bodies.", path.string()));
  }
  std::string out;
  append(out, kMagic);
  append(out, 2);
  append(out, static_cast<std::uint32_t>(size));
  append(out, static_cast<std::uint32_t>(json.size()));
  append(out, kJsonChunk);
  out += json;
  if (!binary.empty()) {
    append(out, static_cast<std::uint32_t>(binary.size()));
    append(out, kBinaryChunk);
    out += binary;
  }
  files::replace_text_file(path, out);
}

}  // namespace buckens::exports

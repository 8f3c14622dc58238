// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace buckens::exports {

/// A binary glTF 2.0 file under construction: JSON followed by one buffer with the numbers.
class GlbFile {
 public:
  nlohmann::ordered_json root;  ///< everything except buffers, bufferViews and accessors

  GlbFile();

  /// Appends numbers and returns the index of their accessor.
  /// @param bounds smallest and largest components, required for positions and times
  int add_vectors(const Eigen::Matrix3Xf& values, bool bounds);
  int add_floats(const std::vector<float>& values, bool bounds);
  int add_quaternions(const std::vector<std::array<float, 4>>& values);  ///< x, y, z, w
  int add_colours(const std::vector<std::array<std::uint8_t, 4>>& values);
  int add_indices(const std::vector<std::uint32_t>& values);

  /// @throws IoError, also if the numbers exceed the 4 GB limit of the format
  void write(const std::filesystem::path& path) const;

 private:
  int add(const void* data, std::size_t bytes, std::size_t count, int component_type,
          const char* type, int target);

  nlohmann::ordered_json views_, accessors_;
  std::string buffer_;
};

}  // namespace buckens::exports

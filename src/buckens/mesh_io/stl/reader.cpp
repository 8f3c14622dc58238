// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/stl/reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/mesh_text.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

// A binary file: 80 bytes that say nothing, the number of triangles, and for each of them twelve
// numbers and two bytes of attributes.
constexpr std::size_t kStlHeader = 80;
constexpr std::size_t kStlStart = kStlHeader + 4;
constexpr std::size_t kStlTriangle = 50;
// Far above what a shape of contact needs; a hundred megabytes of triangles.
constexpr std::size_t kMostStlTriangles = 2'000'000;

std::string lower(std::string_view word) {
  std::string out(word);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::uint32_t stated_count(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kStlHeader, sizeof count);
  return count;
}

/// Some programs begin binary files with "solid", too: the size decides.
bool is_binary_stl(const std::string& bytes) {
  return bytes.size() >= kStlStart &&
         bytes.size() == kStlStart + kStlTriangle * std::size_t{stated_count(bytes)};
}

void add_triangle(const std::array<Vector3d, 3>& corners, spatial::TriangleList& out) {
  const int first = static_cast<int>(out.points.size());
  out.points.insert(out.points.end(), corners.begin(), corners.end());
  out.triangles.push_back({first, first + 1, first + 2});
}

void require_stl_size(std::size_t count, const std::string& name) {
  if (count <= kMostStlTriangles) return;
  throw InputError({name, 0, 0},
                   fmt::format("it has {} triangles, more than {}; export it with a coarser "
                               "tolerance",
                               count, kMostStlTriangles));
}

spatial::TriangleList read_binary_stl(const std::string& bytes, const std::string& name,
                                      double unit) {
  const std::size_t count = stated_count(bytes);
  require_stl_size(count, name);
  spatial::TriangleList out;
  out.points.reserve(3 * count);
  out.triangles.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<float, 12> numbers{};  // the normal, which follows from the corners, and these
    std::memcpy(numbers.data(), bytes.data() + kStlStart + k * kStlTriangle, sizeof numbers);
    std::array<Vector3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 + 3 * c;
      corners[c] = unit * Vector3d(numbers[at], numbers[at + 1], numbers[at + 2]);
      if (corners[c].allFinite()) continue;
      throw InputError(
          {name, 0, 0},
          fmt::format("a corner of its triangle {} is not a number; export it again", k + 1));
    }
    add_triangle(corners, out);
  }
  return out;
}

/// Words of the text form: solid NAME, facet normal x y z, outer loop, vertex x y z …, endloop,
/// endfacet, endsolid NAME.
class StlText {
 public:
  StlText(const std::string& bytes, const std::string& name, double unit)
      : text_(bytes, name), name_(name), unit_(unit) {}

  spatial::TriangleList read() {
    while (has_solid()) {
      for (std::string word = next("facet or endsolid"); word != "endsolid";
           word = next("facet or endsolid")) {
        if (word != "facet") text_.fail(fmt::format("expected facet or endsolid, found {}", word));
        read_facet();
        require_stl_size(out_.triangles.size(), name_);
      }
      if (!text_.at_end()) text_.next_line("the name of a solid");
    }
    return std::move(out_);
  }

 private:
  std::string next(const char* what) { return lower(text_.word(what)); }

  void expect(const char* wanted) {
    const std::string found = next(wanted);
    if (found != wanted) text_.fail(fmt::format("expected {}, found {}", wanted, found));
  }

  /// Passes the line with the name of the next solid; blank lines may follow the last.
  bool has_solid() {
    while (!text_.at_end()) {
      const std::string_view line = text_.peek_line();
      const bool is_blank = std::all_of(line.begin(), line.end(),
                                        [](unsigned char c) { return std::isspace(c) != 0; });
      if (!is_blank) {
        expect("solid");
        text_.next_line("the name of a solid");
        return true;
      }
      text_.next_line("a solid");
    }
    return false;
  }

  void read_facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) text_.word("a normal");  // some write "nan": it is not used
    expect("outer");
    expect("loop");
    std::array<Vector3d, 3> corners;
    for (Vector3d& corner : corners) {
      expect("vertex");
      for (int k = 0; k < 3; ++k) corner[k] = unit_ * text_.number("a corner");
    }
    expect("endloop");
    expect("endfacet");
    add_triangle(corners, out_);
  }

  MeshText text_;
  const std::string& name_;
  double unit_;
  spatial::TriangleList out_;
};

}  // namespace

spatial::TriangleList read_stl_bytes(const std::string& bytes, const std::string& name,
                                     double unit) {
  const bool is_text = lower(bytes.substr(0, 5)) == "solid";
  spatial::TriangleList out;
  if (is_binary_stl(bytes)) {
    out = read_binary_stl(bytes, name, unit);
  } else if (is_text) {
    out = StlText(bytes, name, unit).read();
  } else if (bytes.size() < kStlStart) {
    throw InputError({name, 0, 0}, fmt::format("it has {} bytes, too few for an STL file; export "
                                               "it again",
                                               bytes.size()));
  } else {
    throw InputError(
        {name, 0, 0},
        fmt::format("it is not an STL file, or it is truncated: {} triangles are announced, which "
                    "take {} bytes, but it has {}; export it again",
                    stated_count(bytes),
                    kStlStart + kStlTriangle * std::size_t{stated_count(bytes)}, bytes.size()));
  }
  if (out.triangles.empty()) {
    throw InputError({name, 0, 0}, "it has no triangles; export it again");
  }
  return out;
}

spatial::TriangleList read_stl(const std::filesystem::path& path, double unit) {
  return read_stl_bytes(files::read_text_file(path, "STL file"), path.string(), unit);
}

}  // namespace buckens::mesh_io

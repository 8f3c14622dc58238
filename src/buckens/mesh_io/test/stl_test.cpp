// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/stl/reader.h"

namespace buckens::mesh_io {
namespace {

using testing::HasSubstr;

constexpr char kText[] =
    "solid part of two words\n"
    "  facet normal 0 0 1\n    outer loop\n"
    "      vertex 0 0 0\n      vertex 1.5e1 0 0\n      vertex 0 2 0\n"
    "    endloop\n  endfacet\n"
    "endsolid part of two words\n";

std::string binary(std::uint32_t stated, std::uint32_t count, const char* head = "solid") {
  std::string out(80, '\0');
  std::memcpy(out.data(), head, std::strlen(head));
  out.append(reinterpret_cast<const char*>(&stated), sizeof stated);
  const float numbers[12] = {0, 0, 1, 0, 0, 0, 15, 0, 0, 0, 2, 0};
  for (std::uint32_t k = 0; k < count; ++k) {
    out.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    out.append(2, '\0');
  }
  return out;
}

std::string message(const std::string& bytes) {
  try {
    read_stl_bytes(bytes, "part.stl", 1.0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Stl, IsReadAsTextAndBinaryAlike) {
  // Binary files may begin with "solid", too.
  for (const std::string& bytes : {std::string(kText), binary(1, 1), binary(1, 1, "")}) {
    const spatial::TriangleList list = read_stl_bytes(bytes, "part.stl", 1e-3);
    ASSERT_EQ(list.triangles.size(), 1u);
    ASSERT_EQ(list.points.size(), 3u);
    EXPECT_DOUBLE_EQ(list.points[1].x(), 0.015);
    EXPECT_DOUBLE_EQ(list.points[2].y(), 0.002);
  }
  const spatial::TriangleList two =
      read_stl_bytes(std::string(kText) + "\n" + kText + "\n", "part.stl", 1.0);
  EXPECT_EQ(two.triangles.size(), 2u);
}

TEST(Stl, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(message(binary(2, 1, "part")), HasSubstr("2 triangles are announced"));
  EXPECT_THAT(message("short"), HasSubstr("too few"));
  EXPECT_THAT(message(binary(0, 0)), HasSubstr("no triangles"));
  std::string text = kText;
  text.replace(text.find("vertex 0 2 0"), 12, "vertex 0 x 0");
  EXPECT_THAT(message(text), HasSubstr("part.stl:6"));
  text = kText;
  EXPECT_THAT(message(text.substr(0, 100)), HasSubstr("part.stl"));
  text.replace(text.find("endloop"), 7, "endloup");
  EXPECT_THAT(message(text), HasSubstr("expected endloop, found endloup"));
}

TEST(Stl, NeverReadsBeyondItsBytes) {
  const std::string whole = binary(3, 3, "part");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(read_stl_bytes(whole.substr(0, size), "part.stl", 1.0), InputError) << size;
  }
  const std::string text = kText;
  for (std::size_t size = 0; size + 30 < text.size(); ++size) {
    EXPECT_THROW(read_stl_bytes(text.substr(0, size), "part.stl", 1.0), InputError) << size;
  }
}

}  // namespace
}  // namespace buckens::mesh_io

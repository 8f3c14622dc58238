// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstring>
#include <span>

#include <gtest/gtest.h>
#include <zlib.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/vtu/file.h"

namespace buckens::mesh_io {
namespace {

std::uint64_t number_at(const std::string& bytes, std::size_t place) {
  std::uint64_t out = 0;
  std::memcpy(&out, bytes.data() + place, sizeof out);
  return out;
}

/// The numbers of an array, unpacked the way VTK's documents describe it.
template <class T>
std::vector<T> unpacked(const std::string& file, const std::string& name) {
  const std::size_t at = file.find("Name=\"" + name + "\"");
  const std::size_t mark = file.find("offset=\"", at) + 8;
  std::size_t place = file.find("encoding=\"raw\">\n_") + 17 + std::stoul(file.substr(mark));
  const std::uint64_t blocks = number_at(file, place);
  const std::uint64_t size = number_at(file, place + 8), last = number_at(file, place + 16);
  std::size_t data = place + 24 + 8 * blocks;
  std::string out;
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const std::uint64_t packed = number_at(file, place + 24 + 8 * block);
    std::string room(size, '\0');
    uLongf length = size;
    EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(room.data()), &length,
                           reinterpret_cast<const Bytef*>(file.data() + data), packed),
              Z_OK);
    EXPECT_EQ(length, block + 1 == blocks && last > 0 ? last : size);
    out += room.substr(0, length);
    data += packed;
  }
  std::vector<T> values(out.size() / sizeof(T));
  std::memcpy(values.data(), out.data(), out.size());
  return values;
}

TEST(VtuFile, UnpacksToWhatWasWritten) {
  VtuGrid grid;
  // More than one block of 64 KiB.
  std::vector<float> heat;
  for (int i = 0; i < 20000; ++i) {
    grid.points.emplace_back(i, 0.5 * i, -i);
    heat.push_back(0.25F * static_cast<float>(i));
  }
  const std::array<int, 4> tet = {0, 1, 2, 3};
  const std::array<int, 2> line = {4, 19999};
  grid.add_cell(fem::CellKind::tet4, tet);
  grid.add_cell(fem::CellKind::line2, line);
  grid.point_data.push_back({"heat <\"&\">", 1, heat, {}});
  grid.cell_data.push_back({"id", 1, std::vector<std::int64_t>{7, 9}, {}});
  grid.field_data.push_back({"TimeValue", 1, std::vector<double>{0.125}, {}});
  const std::string file = vtu_bytes(grid);

  EXPECT_EQ(unpacked<float>(file, "heat &lt;&quot;&amp;&quot;&gt;"), heat);
  EXPECT_EQ(unpacked<std::int64_t>(file, "id"), (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(unpacked<double>(file, "TimeValue"), std::vector<double>{0.125});
  EXPECT_EQ(unpacked<double>(file, "Points")[3 * 7 + 1], 3.5);
  EXPECT_EQ(unpacked<std::int64_t>(file, "connectivity"),
            (std::vector<std::int64_t>{0, 1, 2, 3, 4, 19999}));
  EXPECT_EQ(unpacked<std::int64_t>(file, "offsets"), (std::vector<std::int64_t>{4, 6}));
  EXPECT_EQ(unpacked<std::uint8_t>(file, "types"), (std::vector<std::uint8_t>{10, 3}));
}

TEST(VtuFile, TurnsWedgesAsVtkWantsThem) {
  // VTK's own reading of a wedge of either kind in this order gives a positive volume.
  VtuGrid grid;
  std::array<int, 15> nodes;
  for (int k = 0; k < 15; ++k) nodes[static_cast<std::size_t>(k)] = 10 + k;
  grid.add_cell(fem::CellKind::wedge6, std::span(nodes).first<6>());
  grid.add_cell(fem::CellKind::wedge15, nodes);
  EXPECT_EQ(grid.connectivity,
            (std::vector<std::int64_t>{10, 12, 11, 13, 15, 14, 10, 12, 11, 13, 15,
                                       14, 18, 17, 16, 21, 20, 19, 22, 24, 23}));
  EXPECT_EQ(grid.offsets, (std::vector<std::int64_t>{6, 21}));
}

TEST(VtuFile, RefusesArraysOfAnotherLength) {
  VtuGrid grid;
  grid.points.emplace_back(0, 0, 0);
  grid.point_data.push_back({"stress", 6, std::vector<float>(5), {}});
  try {
    vtu_bytes(grid);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "the array \"stress\" has 5 numbers in place of 1 x 6");
  }
}

}  // namespace
}  // namespace buckens::mesh_io

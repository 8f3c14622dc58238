// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"
#include "buckens/base/sanitizers.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/sealed_file.h"
#include "buckens/run_store/test/file_size_limit.h"
#include "buckens/run_store/test/memory_peak.h"
#include "buckens/run_store/test/sample_state.h"

namespace buckens::run_store {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(StateFile, GivesTheSameBitsAgain) {
  const base::SavedValues state = some_state();
  const std::string bytes = state_bytes(state);
  EXPECT_EQ(state_in(bytes), state);
  EXPECT_TRUE(std::signbit(state_in(bytes).numbers["state/bodies/0/d"][1]));
  EXPECT_EQ(state_bytes(state), bytes);  // no time of day in it
}

TEST(StateFile, HasNumbersOfSinglePrecisionAmongTheOthers) {
  base::SavedValues state = some_state();
  state.singles["pairs/0/load"] = {1.0F / 3.0F, -0.0F, 1e-38F};
  state.singles["pairs/1/load"] = {};
  const base::SavedValues found = state_in(state_bytes(state));
  base::SavedValues expected = some_state();
  expected.numbers["pairs/0/load"] = {1.0F / 3.0F, -0.0F, 1e-38F};
  expected.numbers["pairs/1/load"] = {};
  EXPECT_EQ(found, expected);
  // What holds them gets the same numbers from the file and from the state itself.
  for (const base::SavedValues* from : {&found, &std::as_const(state)}) {
    const base::SaveVisit pair = base::SaveVisit::restoring(*from).inside("pairs").inside(0);
    EXPECT_EQ(pair.restored_singles("load", 3), Eigen::Vector3f(1.0F / 3.0F, -0.0F, 1e-38F));
    EXPECT_THROW((void)pair.restored_singles("load", 4), InputError);
  }
}

TEST(StateFile, IsTheSameIfListsAreMadeAsTheyAreWritten) {
  base::SavedValues at_once = some_state(), later = some_state();
  visit_pairs(base::SaveVisit::saving(at_once), 3, 5);
  visit_pairs(base::SaveVisit::saving_to_write(later), 3, 5);
  EXPECT_EQ(at_once.singles.size(), 3U);
  EXPECT_TRUE(later.singles.empty());
  EXPECT_EQ(state_bytes(later), state_bytes(at_once));
}

TEST(StateFile, AFullDiskLeavesTheStateThatWasThere) {
  const base::SavedValues before = some_state();
  write_state(before, some_path());
  base::SavedValues large = before;
  large.numbers["more"].assign(20000, 0.5);
  // Neither the first list, nor the last, nor the trailer has room.
  for (const rlim_t limit : {100, 50000, 165000}) {
    const FileSizeLimit full_disk(limit);
    EXPECT_THAT([&] { write_state(large, some_path()); },
                ThrowsMessage<IoError>(testing::AllOf(HasSubstr("cannot write the file"),
                                                      HasSubstr("File too large"))))
        << limit;
  }
  EXPECT_EQ(read_state(some_path()), before);
  EXPECT_FALSE(std::filesystem::exists(some_path().string() + ".part"));
  std::filesystem::remove(some_path());
}

#if !BUCKENS_IS_SANITIZED && defined(__linux__)

TEST(StateFile, IsWrittenAndReadWithoutMemoryBesideTheLists) {
  constexpr std::size_t kLists = 20, kNumbers = 200000;
  constexpr double kSize = 8.0 * kLists * kNumbers;
  base::SavedValues state;
  for (std::size_t k = 0; k < kLists; ++k) {
    state.numbers["pairs/" + std::to_string(k)].assign(kNumbers, 1.0 / static_cast<double>(k + 1));
  }
  // A piece of the file for its checksum, buffers of HDF5.
  EXPECT_LT(peak_of([&] { write_state(state, some_path()); }), 0.15 * kSize);
  base::SavedValues later;
  visit_pairs(base::SaveVisit::saving_to_write(later), kLists, kNumbers);
  EXPECT_LT(peak_of([&] { write_state(later, some_path()); }), 0.15 * kSize);
  base::SavedValues found;
  EXPECT_LT(peak_of([&] { found = read_state(some_path()); }), 0.15 * kSize);
  std::vector<Eigen::VectorXf> pairs(kLists);
  const base::SaveVisit visit = base::SaveVisit::restoring(found);
  const double peak = peak_of([&] {
    for (std::size_t k = 0; k < kLists; ++k) {
      pairs[k] = visit.inside("pairs").inside(k).restored_singles("load", kNumbers);
    }
  });
  EXPECT_LT(peak, 0.65 * kSize);  // the lists themselves are half of the file
  for (std::size_t k = 0; k < kLists; ++k) {
    EXPECT_TRUE((pairs[k].array() == static_cast<float>(k)).all()) << k;
  }
  std::filesystem::remove(some_path());
}

#endif

TEST(StateFile, EveryCutAndEveryFlippedByteIsRefused) {
  write_state(some_state(), some_path());
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(some_path()));
  std::fstream file(some_path(), std::ios::in | std::ios::out | std::ios::binary);
  const auto flip = [&file](std::streamoff at) {
    file.seekg(at);
    const int byte = file.get();
    file.seekp(at);
    file.put(static_cast<char>(byte ^ 0x41)).flush();
  };
  for (std::streamoff at = 0; at < size; at += 3) {
    flip(at);
    EXPECT_THROW(read_state(some_path()), IoError) << at;
    flip(at);
  }
  EXPECT_EQ(read_state(some_path()), some_state());
  for (std::streamoff cut = size - 1; cut >= 0; cut -= 7) {
    std::filesystem::resize_file(some_path(), static_cast<std::uintmax_t>(cut));
    EXPECT_THROW(read_state(some_path()), IoError) << cut;
  }
  std::filesystem::remove(some_path());
}

std::string sealed(std::string_view content) {
  return std::string(content) + state_trailer(content.size(), base::checksum(content));
}

/// A file whose checksum is right although its content is invalid: it must not cause a crash.
TEST(StateFile, ForeignContentWithASoundTrailerIsRefused) {
  const std::string bytes = state_bytes(some_state());
  EXPECT_THAT(
      [&] { state_in(sealed("no HDF5 at all")); },
      ThrowsMessage<IoError>(HasSubstr(some_path().string() + ": the saved state is damaged")));
  const std::string content = bytes.substr(0, bytes.size() - kStateTrailer);
  EXPECT_EQ(sealed(content), bytes);
  for (std::size_t size = 0; size < content.size(); size += 101) {
    EXPECT_THROW(state_in(sealed(content.substr(0, size))), IoError) << size;
  }
}

TEST(StateFile, NumbersOfAnotherTypeAreRefused) {
  std::string content = state_bytes(some_state());
  content.resize(content.size() - kStateTrailer);
  // How HDF5 describes doubles: sizes of their fraction and bias of their exponent.
  const std::string_view of_double("\x00\x34\x0b\x00\x34\xff\x03\x00\x00", 9);
  const std::size_t at = content.find(of_double);
  ASSERT_NE(at, content.npos);
  content[at + 5] = '\xfe';
  EXPECT_THAT([&] { state_in(sealed(content)); },
              ThrowsMessage<IoError>(HasSubstr("damaged: a data set has another type")));
}

}  // namespace
}  // namespace buckens::run_store

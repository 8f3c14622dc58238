// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/state_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/sanitizers.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/test/file_size_limit.h"

namespace buckens::run_store {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

base::SavedValues some_state() {
  base::SavedValues out;
  out.numbers["state/t"] = {0.1};
  out.numbers["state/bodies/0/d"] = {1.0 / 3.0, -0.0, 1e-308, 5e-324};
  out.numbers["none"] = {};
  out.counts["ticks"] = {1L << 55, -7};
  out.texts["model"] = {"bodies.rod.mass: 1", "", "läuft"};
  out.texts["version"] = {};
  return out;
}

std::filesystem::path some_path() {
  return std::filesystem::path(testing::TempDir()) / "buckens_state_file_test.h5";
}

/// The contents of its file.
std::string state_bytes(const base::SavedValues& state) {
  write_state(state, some_path());
  std::string bytes = files::read_text_file(some_path());
  std::filesystem::remove(some_path());
  return bytes;
}

TEST(StateFile, GivesTheSameBitsAgain) {
  const base::SavedValues state = some_state();
  const std::string bytes = state_bytes(state);
  EXPECT_EQ(parse_state(bytes, "s"), state);
  EXPECT_TRUE(std::signbit(parse_state(bytes, "s").numbers["state/bodies/0/d"][1]));
  EXPECT_EQ(state_bytes(state), bytes);  // no time of day in it
}

TEST(StateFile, HasNumbersOfSinglePrecisionAmongTheOthers) {
  base::SavedValues state = some_state();
  state.singles["pairs/0/load"] = {1.0F / 3.0F, -0.0F, 1e-38F};
  state.singles["pairs/1/load"] = {};
  const base::SavedValues found = parse_state(state_bytes(state), "s");
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

/// Saves some pairs, each number of which is its number.
void visit_pairs(const base::SaveVisit& visit, int pairs, Eigen::Index size) {
  for (int k = 0; k < pairs; ++k) {
    visit.inside("pairs").inside(static_cast<std::size_t>(k)).save_singles("load", size, [=] {
      return Eigen::VectorXf(Eigen::VectorXf::Constant(size, static_cast<float>(k)));
    });
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

/// An entry of the status of this process [bytes].
double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return 1024.0 * std::stod(line.substr(key.size() + 1));
  }
  return 0;
}

/// Largest memory while a function runs, beyond what there was before [bytes].
template <class Function>
double peak_of(Function&& function) {
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
  const double before = memory("VmRSS");
  function();
  return memory("VmHWM") - before;
}

TEST(StateFile, IsWrittenWithoutMemoryAndReadWithLittleMoreThanTheFileTwice) {
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
  const std::string bytes = state_bytes(state);
  ASSERT_GT(static_cast<double>(bytes.size()), kSize);
  base::SavedValues found;
  // HDF5 copies the file, and for a moment twice; later there are the lists instead.
  EXPECT_LT(peak_of([&] { found = parse_state(bytes, "s"); }), 3.3 * kSize);
  EXPECT_EQ(found, state);
}

#endif

TEST(StateFile, EveryCutAndEveryFlippedByteIsRefused) {
  const std::string bytes = state_bytes(some_state());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_THROW(parse_state(std::string_view(bytes).substr(0, size), "s"), IoError) << size;
  }
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    EXPECT_THROW(parse_state(damaged, "s"), IoError) << at;
  }
}

/// A file whose checksum is right although its content is invalid: it must not cause a crash.
TEST(StateFile, ForeignContentWithASoundTrailerIsRefused) {
  const std::string bytes = state_bytes(some_state());
  EXPECT_THAT([&] { parse_state(sealed("no HDF5 at all"), "s"); },
              ThrowsMessage<IoError>(HasSubstr("s: the saved state is damaged")));
  const std::string content = bytes.substr(0, bytes.size() - kStateTrailer);
  EXPECT_EQ(sealed(content), bytes);
  for (std::size_t size = 0; size < content.size(); size += 101) {
    EXPECT_THROW(parse_state(sealed(content.substr(0, size)), "s"), IoError) << size;
  }
}

}  // namespace
}  // namespace buckens::run_store

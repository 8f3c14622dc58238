// SPDX-License-Identifier: Apache-2.0
// Lists that stay in the file of a saved state until a visit asks for them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/state_file.h"
#include "buckens/run_store/test/sample_state.h"

namespace buckens::run_store {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(StateReading, LongListsAreReadWhenAVisitAsksForThem) {
  const base::SavedValues state = long_state();
  write_state(state, some_path());
  const base::SavedValues found = read_state(some_path());
  EXPECT_EQ(found.in_file.size(), 3U);
  EXPECT_EQ(found.numbers, some_state().numbers);
  const base::SaveVisit visit = base::SaveVisit::restoring(found).inside("pairs");
  const std::vector<double>& last = state.numbers.at("pairs/2");
  Eigen::VectorXd vector;
  visit.vector("2", vector, 20000);
  EXPECT_TRUE(std::equal(last.begin(), last.end(), vector.begin(), vector.end()));
  visit.vector_or_none("1", vector, 20000);
  EXPECT_EQ(vector[16384], 2.0);
  const Eigen::VectorXf singles = visit.restored_singles("2", 20000);
  EXPECT_TRUE(std::equal(last.begin(), last.end(), singles.begin(), singles.end()));
  std::vector<double> list;
  visit.list("0", list, 20000);
  EXPECT_EQ(list, state.numbers.at("pairs/0"));
  visit.list_or_none("1", list, 20000);
  EXPECT_EQ(list, state.numbers.at("pairs/1"));
  EXPECT_EQ(found.part("pairs/1").numbers, decltype(found.numbers)({{"pairs/1", list}}));
  EXPECT_EQ(found, state);
  base::SavedValues other = state;
  other.numbers["pairs/2"].back() += 1.0;
  EXPECT_FALSE(found == other);
  std::filesystem::remove(some_path());
}

TEST(StateReading, ListsThatDoNotFitAreRefusedBeforeTheyAreRead) {
  base::SavedValues state = long_state();
  state.numbers["pairs/1"][777] = NAN;
  state.numbers["pairs/2"][777] = 1e200;
  write_state(state, some_path());
  const base::SavedValues found = read_state(some_path());
  const base::SaveVisit visit = base::SaveVisit::restoring(found).inside("pairs");
  Eigen::VectorXd vector = Eigen::VectorXd::Ones(3);
  const auto refuses = [&](auto&& restore, const char* what) {
    EXPECT_THAT(restore, ThrowsMessage<InputError>(HasSubstr(what)));
    EXPECT_EQ(vector, Eigen::VectorXd::Ones(3));
  };
  refuses([&] { visit.vector("1", vector, 20000); }, "not finite");
  refuses([&] { (void)visit.restored_singles("2", 20000); }, "not finite");  // too large
  std::filesystem::resize_file(some_path(), 1000);  // there is nothing to read any more
  refuses([&] { visit.vector("0", vector, 19999); }, "has 20000 values, expected 19999");
  refuses([&] { visit.vector_or_none("0", vector, 1); }, "has 20000 values, expected 1");
  refuses([&] { (void)visit.restored_singles("0", 20001); }, "expected 20001");
  std::vector<double> list;
  refuses([&] { visit.list_or_none("0", list, 3); }, "expected 3 or none");
  std::filesystem::remove(some_path());
}

TEST(StateReading, AFileThatTakesItsPlaceChangesNothing) {
  write_state(long_state(), some_path());
  const base::SavedValues found = read_state(some_path());
  base::SavedValues next = long_state();
  for (auto& [path, list] : next.numbers) list.assign(list.size(), 7.0);
  write_state(next, some_path());
  EXPECT_EQ(found, long_state());
  EXPECT_EQ(read_state(some_path()), next);
  // A state may even be written where it is read.
  write_state(read_state(some_path()), some_path());
  EXPECT_EQ(read_state(some_path()), next);
  std::filesystem::remove(some_path());
  EXPECT_EQ(found, long_state());
}

/// Whatever happens to the file once it has been found sound.
TEST(StateReading, WhatHasChangedSinceTheCheckIsRefused) {
  const std::string bytes = state_bytes(long_state());
  const auto refuses = [&](const auto& change, int list) {
    const base::SavedValues found = read_state(file_of(bytes));
    change();
    const base::SaveVisit visit = base::SaveVisit::restoring(found).inside("pairs");
    Eigen::VectorXd vector;
    EXPECT_THAT([&] { visit.vector(std::to_string(list), vector, 20000); },
                ThrowsMessage<IoError>(testing::AllOf(HasSubstr(some_path().string()),
                                                      HasSubstr("changed while it was read"))));
    EXPECT_EQ(vector.size(), 0);
    EXPECT_THROW((void)visit.restored_singles(std::to_string(list), 20000), IoError);
    EXPECT_THROW((void)found.part(""), IoError);
  };
  for (const int list : {0, 1, 2}) {
    refuses([] { std::filesystem::resize_file(some_path(), 0); }, list);
  }
  refuses([&] { std::filesystem::resize_file(some_path(), bytes.size() - 100000); }, 2);
  // One bit of a number, in its first, a middle and its last piece.
  const double number = 2 + 9000 / 16384.0;
  const std::size_t middle =
      bytes.find(std::string_view(reinterpret_cast<const char*>(&number), sizeof number));
  ASSERT_NE(middle, bytes.npos);
  for (const std::ptrdiff_t place : {-9000, 0, 10999}) {
    refuses(
        [&] {
          std::fstream file(some_path(), std::ios::in | std::ios::out | std::ios::binary);
          const auto at = static_cast<std::streamoff>(middle) + 8 * place;
          const char bit = static_cast<char>(bytes[static_cast<std::size_t>(at)] ^ 1);
          file.seekp(at);
          file.put(bit);
        },
        2);
  }
  std::filesystem::remove(some_path());
}

TEST(StateReading, IsReadByManyAndWithoutLocks) {
  write_state(long_state(), some_path());
  const int descriptor = ::open(some_path().c_str(), O_RDONLY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX | LOCK_NB), 0);
  const base::SavedValues first = read_state(some_path()), second = read_state(some_path());
  EXPECT_EQ(first, second);
  ::close(descriptor);
  std::filesystem::remove(some_path());
}

TEST(StateReading, WhatIsNoFileIsRefused) {
  const std::filesystem::path folder = some_path().parent_path();
  EXPECT_THAT([&] { read_state(folder); }, ThrowsMessage<IoError>(HasSubstr("is a directory")));
  EXPECT_THAT([&] { read_state("/dev/null"); },
              ThrowsMessage<IoError>(HasSubstr("no file on a disk")));
  EXPECT_THAT([&] { read_state(folder / "nowhere.h5"); },
              ThrowsMessage<IoError>(HasSubstr("nowhere.h5: cannot read the file: No such file")));
}

#if defined(__linux__)

int count_open_files() {
  const std::filesystem::directory_iterator open("/proc/self/fd");
  return static_cast<int>(std::distance(begin(open), end(open)));
}

TEST(StateReading, IsOpenAsLongAsListsAreInIt) {
  write_state(long_state(), some_path());
  const int before = count_open_files();
  {
    auto found = std::make_optional(read_state(some_path()));
    const base::SavedValues copy = *found;
    found.reset();
    EXPECT_EQ(count_open_files(), before + 1);
    EXPECT_EQ(copy, long_state());
  }
  EXPECT_EQ(count_open_files(), before);
  write_state(some_state(), some_path());
  const base::SavedValues short_lists = read_state(some_path());
  EXPECT_EQ(count_open_files(), before);
  std::filesystem::remove(some_path());
}

#endif

}  // namespace
}  // namespace buckens::run_store

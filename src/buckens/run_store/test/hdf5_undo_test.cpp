// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_undo.h"

#include <fstream>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "buckens/files/output_file.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {
namespace {

namespace fs = std::filesystem;
using testing::IsNull;
using testing::NotNull;

/// A directory with a file of 1000 bytes, which is written through an undo file.
class Hdf5UndoTest : public testing::Test {
 protected:
  Hdf5UndoTest() : directory_(fs::path(testing::TempDir()) / "hdf5_undo_test") {
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    for (int k = 0; k < 1000; ++k) content_ += static_cast<char>('a' + k % 26);
    std::ofstream(directory_ / kResultsName) << content_;
    descriptor_ = ::open((directory_ / kResultsName).c_str(), O_RDWR | O_CLOEXEC);
  }
  ~Hdf5UndoTest() override {
    ::close(descriptor_);
    fs::remove_all(directory_);
  }
  Hdf5UndoTest(const Hdf5UndoTest&) = delete;
  Hdf5UndoTest& operator=(const Hdf5UndoTest&) = delete;

  void overwrite(Hdf5Undo& undo, std::uint64_t address, const std::string& bytes) const {
    ASSERT_EQ(undo.keep(descriptor_, address, bytes.size()), 0);
    ASSERT_EQ(undo.sync(), 0);
    ASSERT_EQ(::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(address)),
              static_cast<ssize_t>(bytes.size()));
  }

  /// The file as it was.
  std::string undone(const Undone& undone) const {
    std::string out = files::read_text_file(directory_ / kResultsName);
    for (const FileBytes& one : undone.before) {
      out.replace(one.address, one.bytes.size(), std::string(one.bytes.begin(), one.bytes.end()));
    }
    return out.substr(0, undone.length);
  }

  fs::path directory_;
  std::string content_;
  int descriptor_ = -1;
};

TEST_F(Hdf5UndoTest, TheFileIsReadAsItWas) {
  Hdf5Undo undo(directory_);
  overwrite(undo, 10, "nothing is kept before it begins");
  const std::string before = files::read_text_file(directory_ / kResultsName);
  undo.begin("first", 1000);
  EXPECT_THAT(read_undone(directory_, "first"), IsNull());  // as long as nothing has changed
  overwrite(undo, 100, std::string(50, '!'));
  overwrite(undo, 90, std::string(80, '?'));    // around it
  overwrite(undo, 120, std::string(10, '#'));   // within
  overwrite(undo, 990, std::string(100, '+'));  // beyond the end
  const auto found = read_undone(directory_, "first");
  ASSERT_THAT(found, NotNull());
  EXPECT_EQ(found->length, 1000U);
  EXPECT_EQ(undone(*found), before);
  std::size_t kept = 0;
  for (const FileBytes& one : found->before) kept += one.bytes.size();
  EXPECT_EQ(kept, 80U + 10U);  // each byte once
}

TEST_F(Hdf5UndoTest, OnlyWhatIsNewWaits) {
  Hdf5Undo undo(directory_);
  undo.begin("first", 1000);
  EXPECT_EQ(undo.keep(descriptor_, 2000, 10), 0);
  EXPECT_FALSE(undo.is_waiting());
  EXPECT_EQ(undo.keep(descriptor_, 500, 10), 0);
  EXPECT_TRUE(undo.is_waiting());
  EXPECT_EQ(undo.sync(), 0);
  EXPECT_EQ(undo.keep(descriptor_, 502, 5), 0);
  EXPECT_FALSE(undo.is_waiting());
}

TEST_F(Hdf5UndoTest, ItBelongsToItsCheckpoint) {
  Hdf5Undo undo(directory_);
  undo.begin("first", 1000);
  overwrite(undo, 100, "one");
  EXPECT_THAT(read_undone(directory_, "other"), IsNull());
  undo.begin("second", 1000);
  overwrite(undo, 200, "two");
  EXPECT_THAT(read_undone(directory_, "first"), IsNull());
  ASSERT_THAT(read_undone(directory_, "second"), NotNull());
  EXPECT_EQ(undone(*read_undone(directory_, "second")).substr(100, 3), "one");
  undo.discard();
  EXPECT_THAT(read_undone(directory_, "second"), IsNull());
}

TEST_F(Hdf5UndoTest, APartOfARecordWasNotNeeded) {
  Hdf5Undo undo(directory_);
  undo.begin("first", 1000);
  overwrite(undo, 100, "one");
  const auto size = fs::file_size(directory_ / kUndoName);
  EXPECT_EQ(undo.keep(descriptor_, 200, 30), 0);
  EXPECT_EQ(undo.sync(), 0);
  fs::resize_file(directory_ / kUndoName, fs::file_size(directory_ / kUndoName) - 1);
  ASSERT_THAT(read_undone(directory_, "first"), NotNull());
  EXPECT_EQ(read_undone(directory_, "first")->before.size(), 1U);
  fs::resize_file(directory_ / kUndoName, size);
  EXPECT_EQ(undone(*read_undone(directory_, "first")), content_);
  fs::resize_file(directory_ / kUndoName, 20);  // not even its head
  EXPECT_THAT(read_undone(directory_, "first"), IsNull());
}

TEST_F(Hdf5UndoTest, PutAsideItServesUntilTheNewFileTakesItsPlace) {
  Hdf5Undo undo(directory_);
  undo.begin("first", 1000);
  overwrite(undo, 100, "one");
  std::ofstream(directory_ / (std::string(kResultsName) + ".part")) << "new";
  undo.set_aside();
  EXPECT_THAT(read_undone(directory_, "first"), NotNull());
  fs::rename(directory_ / (std::string(kResultsName) + ".part"), directory_ / kResultsName);
  EXPECT_THAT(read_undone(directory_, "first"), IsNull());
}

TEST_F(Hdf5UndoTest, ADiskThatTakesNothingIsReported) {
  Hdf5Undo undo(directory_ / "missing");
  undo.begin("first", 1000);
  EXPECT_EQ(undo.keep(descriptor_, 100, 3), 0);
  EXPECT_EQ(undo.sync(), ENOENT);
  EXPECT_TRUE(undo.is_waiting());
}

}  // namespace
}  // namespace buckens::run_store

// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/write_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace buckens::files {
namespace {

class WriteProcessTest : public testing::Test {
 protected:
  WriteProcessTest()
      : path_(std::filesystem::path(testing::TempDir()) /
              ("write_process_" + std::to_string(::getpid()))),
        file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600)) {}
  ~WriteProcessTest() override {
    ::close(file_);
    std::filesystem::remove(path_);
  }
  std::string content() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  std::filesystem::path path_;
  int file_;
};

TEST_F(WriteProcessTest, WritesWhereItIsTold) {
  WriteProcess writer;
  ASSERT_EQ(writer.take_file(file_), 0);
  EXPECT_EQ(writer.write(4, "world", 5), 0);
  EXPECT_EQ(writer.write(0, "hell", 4), 0);
  EXPECT_EQ(writer.write(2, "", 0), 0);
  EXPECT_EQ(content(), "hellworld");
}

TEST_F(WriteProcessTest, LargeWritesArriveWhole) {
  WriteProcess writer;
  ASSERT_EQ(writer.take_file(file_), 0);
  std::string bytes(5'000'001, 'x');
  bytes[1'234'567] = 'y';
  EXPECT_EQ(writer.write(10, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(content().substr(10), bytes);
}

TEST_F(WriteProcessTest, TellsTheReasonOfAFailure) {
  WriteProcess writer;
  const int read_only = ::open(path_.c_str(), O_RDONLY);
  ASSERT_EQ(writer.take_file(read_only), 0);
  EXPECT_EQ(writer.write(0, "a", 1), EBADF);
  ::close(read_only);
  ASSERT_EQ(writer.take_file(file_), 0);  // another file brings it back
  EXPECT_EQ(writer.write(0, "a", 1), 0);
  ::kill(writer.id(), SIGKILL);
  EXPECT_EQ(writer.write(0, "b", 1), EPIPE);
  EXPECT_EQ(writer.take_file(file_), EPIPE);
}

TEST_F(WriteProcessTest, DoesNotHearTheTerminal) {
  WriteProcess writer;
  ASSERT_EQ(writer.take_file(file_), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::kill(writer.id(), signal);
  EXPECT_EQ(writer.write(0, "a", 1), 0);
  EXPECT_NE(::getpgid(writer.id()), ::getpgrp());
}

// Two megabytes are 512 pages: a write cut off by SIGKILL would leave some of either letter.
// Written without the second process, a third of such kills leaves a mixture.
TEST_F(WriteProcessTest, AKillLeavesNoHalfWrite) {
  constexpr std::size_t kSize = 8U << 20U;
  for (int round = 0; round < 20; ++round) {
    int go[2];
    ASSERT_EQ(::pipe(go), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      WriteProcess writer;
      if (writer.take_file(file_) != 0) ::_exit(1);
      for (char letter = 'a';; letter = letter == 'a' ? 'b' : 'a') {
        const std::vector<char> bytes(kSize, letter);
        if (writer.write(0, bytes.data(), bytes.size()) != 0) ::_exit(1);
        if (letter == 'b') static_cast<void>(!::write(go[1], "b", 1));
      }
    }
    ::close(go[1]);
    char first = 0;
    EXPECT_EQ(::read(go[0], &first, 1), 1);
    std::this_thread::sleep_for(std::chrono::microseconds(977 * (round + 1)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    // The second process may still be executing the last request; the pipe ends with it.
    char drained[64];
    while (::read(go[0], drained, sizeof drained) > 0) {
    }
    ::close(go[0]);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::string bytes = content();
    ASSERT_EQ(bytes.size(), kSize);
    EXPECT_EQ(std::count(bytes.begin(), bytes.end(), bytes.front()), kSize) << "round " << round;
  }
}

}  // namespace
}  // namespace buckens::files

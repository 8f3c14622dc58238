// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/pages_on_disk.h"

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "plugins/petsc/nameless_file.h"
#include "plugins/petsc/test/file_limit.h"

namespace buckens_petsc {
namespace {

constexpr std::size_t kMany = std::size_t{8} << 20;

char letter(std::size_t place) { return static_cast<char>('a' + place % 23); }

void fill(const PagesOnDisk& pages) {
  for (std::size_t k = 0; k < kMany; ++k) pages.data()[k] = letter(k);
}

bool is_as_filled(const PagesOnDisk& pages) {
  for (std::size_t k = 0; k < kMany; ++k) {
    if (pages.data()[k] != letter(k)) return false;
  }
  return true;
}

/// Memory of this process that files are mapped to [bytes].
double of_files() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "RssFile:") continue;
    double kilobytes = 0;
    status >> kilobytes;
    return 1024 * kilobytes;
  }
  return -1;
}

bool has_disk() {
  const int file = nameless_file();
  if (file >= 0) ::close(file);
  return file >= 0;
}

#define SKIP_WITHOUT_DISK() \
  if (!has_disk()) GTEST_SKIP() << "neither TMPDIR, /var/tmp nor /tmp is on a disk"

TEST(PagesOnDisk, LeaveMemoryAndComeBackAsTheyWere) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  const double before = of_files();
  fill(pages);
  const double filled = of_files();
  EXPECT_GT(filled, before + 0.9 * kMany);
  pages.let_go();
  EXPECT_LT(of_files(), filled - 0.9 * kMany);
  EXPECT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, GoByThemselvesAndAreReadAsTheyWere) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  fill(pages);
  const double filled = of_files();
  const LettingGo going(pages);
  // They go within a twentieth of a second; a minute on a machine that has no time.
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (of_files() > filled - 0.9 * kMany && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(of_files(), filled - 0.9 * kMany);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, AreOrdinaryMemoryWhereTheDiskDoesNotTakeThem) {
  PagesOnDisk pages;
  const double before = of_files();
  {
    const FileLimit limit(rlim_t{1'000'000});
    ASSERT_TRUE(pages.set_aside(kMany));
  }
  fill(pages);
  EXPECT_LT(of_files(), before + 0.5 * kMany);
  pages.let_go();
  EXPECT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, MayBeNone) {
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  ASSERT_TRUE(pages.set_aside(0));
  EXPECT_EQ(pages.data(), nullptr);
}

}  // namespace
}  // namespace buckens_petsc

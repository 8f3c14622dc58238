// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/pages_on_disk.h"

#include <cstring>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

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
  PagesOnDisk pages;
  if (!pages.set_aside(kMany)) return false;
  const double before = of_files();
  std::memset(pages.data(), 1, kMany);
  return of_files() > before + kMany / 2.0;
}

TEST(PagesOnDisk, LeaveMemoryAndComeBackAsTheyWere) {
  if (!has_disk()) GTEST_SKIP() << "neither TMPDIR, /var/tmp nor /tmp is on a disk";
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  fill(pages);
  const double filled = of_files();
  pages.let_go();
  EXPECT_LT(of_files(), filled - 0.9 * kMany);
  EXPECT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, AreReadAsTheyWereWhileTheyLeave) {
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  const LettingGo going(pages);
  fill(pages);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, AreOrdinaryMemoryWhereTheDiskDoesNotTakeThem) {
  PagesOnDisk pages;
  {
    const FileLimit limit(rlim_t{1'000'000});
    ASSERT_TRUE(pages.set_aside(kMany));
  }
  fill(pages);
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

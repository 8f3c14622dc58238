// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/pages_on_disk.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "plugins/petsc/nameless_file.h"
#include "plugins/petsc/test/file_limit.h"

namespace buckens_petsc {
namespace {

constexpr std::size_t kMany = std::size_t{8} << 20;

char letter(std::size_t place) { return static_cast<char>('a' + place % 23); }

void fill(const PagesOnDisk& pages) {
  for (std::size_t k = 0; k < pages.bytes(); ++k) pages.data()[k] = letter(k);
}

bool is_as_filled(const PagesOnDisk& pages, std::size_t bytes) {
  for (std::size_t k = 0; k < bytes; ++k) {
    if (pages.data()[k] != letter(k)) return false;
  }
  return true;
}
bool is_as_filled(const PagesOnDisk& pages) { return is_as_filled(pages, pages.bytes()); }

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

/// While it lives, the process gets no more address space.
class AddressLimit {
 public:
  AddressLimit() {
    ::getrlimit(RLIMIT_AS, &before_);
    const rlimit none{rlim_t{1} << 20, before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &none);
  }
  ~AddressLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  AddressLimit(const AddressLimit&) = delete;
  AddressLimit& operator=(const AddressLimit&) = delete;

 private:
  rlimit before_{};
};

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
  const LettingGo going(pages, std::chrono::milliseconds(50));
  // They go within a twentieth of a second; a minute on a machine that has no time.
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (of_files() > filled - 0.9 * kMany && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(of_files(), filled - 0.9 * kMany);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(is_as_filled(pages));
}

TEST(PagesOnDisk, StayWhileThereAreFew) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  const LettingGo going(pages, std::chrono::milliseconds(1), 2 * kMany);
  const double before = of_files();
  fill(pages);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GT(of_files(), before + 0.9 * kMany);
}

TEST(PagesOnDisk, GoWhenThereAreMany) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  const double before = of_files();
  const LettingGo going(pages, std::chrono::milliseconds(1), kMany / 2);
  fill(pages);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (of_files() > before + 0.6 * kMany && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_LE(of_files(), before + 0.6 * kMany);
  EXPECT_TRUE(is_as_filled(pages));
}

/// The first bytes as they were, and zeros behind them, in memory that can be written to.
void expect_brought_back(const PagesOnDisk& pages, std::size_t bytes) {
  EXPECT_TRUE(is_as_filled(pages, bytes));
  // What is behind them is given back by whole pages.
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  for (std::size_t k = bytes + page; k < pages.bytes(); k += page / 2) {
    ASSERT_EQ(pages.data()[k], 0);
  }
  pages.data()[pages.bytes() - 1] = 'z';
  EXPECT_EQ(pages.data()[pages.bytes() - 1], 'z');
}

constexpr std::size_t kKept = kMany / 2 + 100;

TEST(PagesOnDisk, ComeBackForGoodToTheSameAddress) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  const double before = of_files();
  // More than come back at a time.
  ASSERT_TRUE(pages.set_aside(3 * kMany));
  ASSERT_TRUE(pages.is_on_disk());
  const char* const address = pages.data();
  fill(pages);
  pages.bring_back(2 * kMany + kKept);
  EXPECT_FALSE(pages.is_on_disk());
  EXPECT_EQ(pages.data(), address);
  EXPECT_LT(of_files(), before + 0.1 * kMany);
  pages.let_go();
  expect_brought_back(pages, 2 * kMany + kKept);
}

TEST(PagesOnDisk, GiveBackWhatIsNotKeptWhereTheyAreMemory) {
  PagesOnDisk pages;
  {
    const FileLimit limit(rlim_t{1'000'000});
    ASSERT_TRUE(pages.set_aside(kMany));
  }
  ASSERT_FALSE(pages.is_on_disk());
  fill(pages);
  pages.bring_back(kKept);
  expect_brought_back(pages, kKept);
}

TEST(PagesOnDisk, StayOnTheDiskWhereThereIsNoMemory) {
  SKIP_WITHOUT_DISK();
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  fill(pages);
  {
    const AddressLimit limit;
    pages.bring_back(kKept);
  }
  EXPECT_TRUE(pages.is_on_disk());
  EXPECT_TRUE(is_as_filled(pages));
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

TEST(PagesOnDisk, AreOrdinaryMemoryWhereTheDiskIsSwitchedOff) {
  ::setenv("BUCKENS_MPI_DISK", "off", 1);
  PagesOnDisk pages;
  EXPECT_TRUE(pages.set_aside(kMany));
  EXPECT_FALSE(pages.is_on_disk());
  EXPECT_LT(nameless_file(), 0);
  ::unsetenv("BUCKENS_MPI_DISK");
}

TEST(PagesOnDisk, MayBeNone) {
  PagesOnDisk pages;
  ASSERT_TRUE(pages.set_aside(kMany));
  ASSERT_TRUE(pages.set_aside(0));
  EXPECT_EQ(pages.data(), nullptr);
}

}  // namespace
}  // namespace buckens_petsc

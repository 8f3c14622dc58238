// SPDX-License-Identifier: Apache-2.0
// Factors from files against those computed; files that are missing, cut short or changed.
#include "buckens/linalg/panel_file.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "buckens/base/log.h"
#include "buckens/linalg/content_hash.h"
#include "buckens/linalg/factor_cache.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

namespace fs = std::filesystem;

class StoredFactors : public testing::Test {
 protected:
  StoredFactors() { fs::remove_all(folder_); }
  ~StoredFactors() override {
    base::set_log_sink({});
    fs::remove_all(folder_);
  }
  void listen() {
    base::set_log_sink([this](base::LogLevel level, const std::string& text) {
      if (level == base::LogLevel::warning) told_ += text + "\n";
    });
  }
  Matrix solved() const {
    const FactorCache cache(folder_);
    return SparseCholesky(A_).solve(B_);
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> out;
    if (!fs::exists(folder_)) return out;
    for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path());
    return out;
  }

  // Large enough to be kept, and to be solved in two groups.
  SparseMatrix A_ = matrices::grid(13, 0.1);
  Matrix B_ = Matrix::Ones(A_.rows(), 3);
  Matrix expected_ = SparseCholesky(A_).solve(B_);
  fs::path folder_ = fs::temp_directory_path() / ("buckens_factors_" + std::to_string(getpid()));
  std::string told_;
};

TEST_F(StoredFactors, GiveTheSameBits) {
  listen();
  EXPECT_EQ(solved(), expected_);
  ASSERT_EQ(files().size(), 1U);
  const auto written = fs::last_write_time(files()[0]);
  EXPECT_EQ(solved(), expected_);
  EXPECT_EQ(fs::last_write_time(files()[0]), written) << "read, not written again";
  const auto stored = PanelFile(folder_, A_).read(best_simd_level());
  ASSERT_TRUE(stored.has_value());
  EXPECT_EQ(stored->entries, SparseCholesky(A_).num_factor_entries());
  EXPECT_EQ(told_, "");
}

TEST_F(StoredFactors, OfSumsAreThoseOfTheirMatrices) {
  MatrixSum sum;
  const SymmetricMatrix A(A_);
  sum.add(0.25, A);
  sum.add(0.75, A);
  const SparseMatrix whole = sum.whole();
  const fs::path expected = PanelFile(folder_, whole).path();
  TaskPool pool(3);
  EXPECT_EQ(PanelFile(folder_, sum).path(), expected);
  EXPECT_EQ(PanelFile(folder_, sum, &pool).path(), expected);
  EXPECT_EQ(PanelFile(folder_, whole, &pool).path(), expected);
  EXPECT_NE(PanelFile(folder_, SparseMatrix(2.0 * whole)).path(), expected);
  const FactorCache cache(folder_);
  const Matrix made = SparseCholesky(sum).solve(B_);
  ASSERT_EQ(files().size(), 1U);
  EXPECT_EQ(files()[0], expected);
  EXPECT_EQ(SparseCholesky(sum).solve(B_), made);  // as it was stored
  EXPECT_EQ(SparseCholesky(whole).solve(B_), made);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(StoredFactors, BelongToOneMatrix) {
  EXPECT_EQ(solved(), expected_);
  A_.coeffRef(77, 77) += 1e-12;
  EXPECT_FALSE(PanelFile(folder_, A_).read(best_simd_level()).has_value());
  solved();
  EXPECT_EQ(files().size(), 2U);
  A_.coeffRef(0, A_.cols() - 1) += 0.0;  // an entry more; not compressed
  EXPECT_FALSE(PanelFile(folder_, A_).read(best_simd_level()).has_value());
}

TEST_F(StoredFactors, AreComputedAnewWhereTheyAreDamaged) {
  listen();
  solved();
  const fs::path file = files().at(0);
  const auto length = static_cast<std::int64_t>(fs::file_size(file));
  for (const std::int64_t cut : {std::int64_t{0}, std::int64_t{50}, length / 2, length - 1}) {
    fs::resize_file(file, static_cast<std::uintmax_t>(cut));
    told_.clear();
    EXPECT_EQ(solved(), expected_) << cut;
    EXPECT_NE(told_.find("computed anew"), std::string::npos) << told_;
    EXPECT_EQ(static_cast<std::int64_t>(fs::file_size(file)), length) << "written again";
  }
  for (const std::int64_t place : {std::int64_t{3}, std::int64_t{20}, std::int64_t{60},
                                   std::int64_t{110}, length / 2, length - 1}) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(place);
    const char before = static_cast<char>(stream.get());
    stream.seekp(place);
    stream.put(static_cast<char>(before ^ 0x40));
    stream.close();
    told_.clear();
    EXPECT_EQ(solved(), expected_) << place;
    EXPECT_NE(told_.find("computed anew"), std::string::npos) << place << told_;
  }
}

TEST_F(StoredFactors, DoNotWaitForAPipeInPlaceOfAFile) {
  solved();
  ASSERT_EQ(files().size(), 1U);
  const fs::path path = files().front();
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  listen();
  EXPECT_EQ(solved(), expected_);
  EXPECT_NE(told_.find("is no regular file; the factor is computed anew"), std::string::npos)
      << told_;
  EXPECT_TRUE(fs::is_regular_file(path)) << "the factor takes its place";
}

TEST_F(StoredFactors, MayBeMadeBySeveralAtOnce) {
  std::vector<std::thread> threads;
  std::vector<Matrix> found(3);
  for (Matrix& X : found) threads.emplace_back([&X, this] { X = solved(); });
  for (std::thread& thread : threads) thread.join();
  for (const Matrix& X : found) EXPECT_EQ(X, expected_);
  EXPECT_EQ(files().size(), 1U) << "nothing is left aside";
  EXPECT_EQ(solved(), expected_);
}

TEST_F(StoredFactors, DoNotStopARunThatCannotWriteThem) {
  listen();
  std::ofstream(folder_) << "a file where the folder should be";
  EXPECT_EQ(solved(), expected_);
  EXPECT_NE(told_.find("cannot be written"), std::string::npos) << told_;
  EXPECT_NE(told_.find(folder_.string()), std::string::npos) << told_;
}

TEST_F(StoredFactors, OfSmallMatricesAreNotKept) {
  A_ = matrices::grid(4, 0.1);
  B_ = Matrix::Ones(A_.rows(), 1);
  solved();
  EXPECT_TRUE(files().empty());
}

TEST(ContentHash, SeesEveryBitAndWhereRunsEnd) {
  const auto hash = [](const std::string& text, std::size_t first) {
    ContentHash out;
    out.add(text.data(), first);
    out.add(text.data() + first, text.size() - first);
    return out.text();
  };
  const std::string text(100, 'a');
  EXPECT_EQ(hash(text, 40), hash(text, 40));
  EXPECT_EQ(hash(text, 40).size(), 32U);
  EXPECT_NE(hash(text, 40), hash(text, 41));
  EXPECT_NE(hash(text, 40), hash(text + '\0', 40));
  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string other = text;
    other[k] ^= 1;
    EXPECT_NE(hash(text, 40), hash(other, 40)) << k;
  }
}

}  // namespace
}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/column_maker.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/symmetric_matrix.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

/// The lower triangle of a grid; the first byte says what is wrong with it.
SparseMatrix columns_of_grid(std::span<const std::byte> description, int first, int end) {
  if (description.front() == std::byte{1}) throw NumericalError("the grid is gone");
  if (description.front() == std::byte{2}) throw std::bad_alloc();
  SparseMatrix A = matrices::grid(4, 0.3);
  if (description.front() == std::byte{3}) {
    A.valuePtr()[A.nonZeros() - 1] = std::numeric_limits<double>::quiet_NaN();
  }
  const SparseMatrix lower = A.triangularView<Eigen::Lower>();
  return lower.middleCols(first, end - first);
}

struct Made {
  int result = 0;
  std::string error;
  BuckensGridColumns columns{};
};

Made make(const BuckensGridMaker& maker, int kind, int first, int end) {
  Made out;
  std::array<char, 400> error{};
  const auto description = static_cast<std::byte>(kind);
  out.result = maker.make(&description, 1, first, end, &out.columns, error.data(),
                          static_cast<int>(error.size()));
  out.error = error.data();
  return out;
}

TEST(ColumnMaker, ContentOfRunsAddsUpToThatOfTheMatrix) {
  const SymmetricMatrix A(matrices::grid(4, 0.3));
  const BuckensGridMaker maker = column_maker(columns_of_grid);
  std::array<unsigned long long, 2> sum{};
  const int n = static_cast<int>(A.cols());
  for (const auto& [first, end] : {std::pair{n / 3, n}, std::pair{0, n / 3}}) {
    const Made run = make(maker, 0, first, end);
    ASSERT_EQ(run.result, 0) << run.error;
    // Places of rows: the columns come first.
    std::vector<int> variables(static_cast<std::size_t>(n));
    std::iota(variables.begin(), variables.end(), 0);
    std::rotate(variables.begin(), variables.begin() + first, variables.end());
    std::vector<int> places;
    for (int e = 0; e < run.columns.starts[end - first]; ++e) {
      places.push_back((run.columns.rows[e] - first + n) % n);
    }
    const BuckensGridColumns columns{run.columns.starts, places.data(), run.columns.values};
    maker.add_content(end - first, &columns, variables.data(), sum.data());
  }
  EXPECT_EQ(sum[0], A.content()[0]);
  EXPECT_EQ(sum[1], A.content()[1]);
  EXPECT_NE(A.content(), SymmetricMatrix(matrices::grid(4, 0.31)).content());
}

TEST(ColumnMaker, ErrorsAreToldAsText) {
  const BuckensGridMaker maker = column_maker(columns_of_grid);
  const Made gone = make(maker, 1, 0, 3);
  EXPECT_NE(gone.result, 0);
  EXPECT_EQ(gone.error, "the grid is gone");
  EXPECT_NE(make(maker, 2, 0, 3).error.find("too little memory"), std::string::npos);
  const int n = static_cast<int>(matrices::grid(4, 0.3).cols());
  const Made wrong = make(maker, 3, n - 2, n);
  EXPECT_NE(wrong.result, 0);
  EXPECT_NE(wrong.error.find("not finite"), std::string::npos) << wrong.error;
}

}  // namespace
}  // namespace buckens::linalg

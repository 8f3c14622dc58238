// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/basis_store.h"

#include <bit>

namespace buckens::body {

namespace {

/// FNV-1a over 64-bit words, each stirred so that small differences reach all bits.
class Hash {
 public:
  void add(std::uint64_t word) {
    word ^= word >> 33;
    word *= 0xff51afd7ed558ccdULL;
    word ^= word >> 33;
    value_ = (value_ ^ word) * 0x100000001b3ULL;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  template <class Sparse>
  void add_matrix(const Sparse& A) {
    add(static_cast<std::uint64_t>(A.rows()));
    add(static_cast<std::uint64_t>(A.cols()));
    for (int k = 0; k < A.outerSize(); ++k) {
      for (typename Sparse::InnerIterator it(A, k); it; ++it) {
        add(static_cast<std::uint64_t>(it.row()));
        add(static_cast<std::uint64_t>(it.col()));
        add(it.value());
      }
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t basis_key(const FlexiblePart& part, const std::string& choice) {
  Hash hash;
  for (const char letter : choice) hash.add(static_cast<std::uint64_t>(letter));
  // The same numbers wherever the matrices are.
  for (const linalg::SymmetricMatrix* A : {&part.fe.M, &part.fe.K}) {
    hash.add(static_cast<std::uint64_t>(A->rows()));
    for (const std::uint64_t number : A->content()) hash.add(number);
  }
  const Eigen::SparseMatrix<double, Eigen::RowMajor> N = part.rows.topRows(part.num_interface_rows);
  hash.add_matrix(N);
  hash.add(static_cast<std::uint64_t>(part.num_pattern_rows));
  const linalg::Matrix c = part.invariants.first_moments();
  for (Eigen::Index k = 0; k < c.size(); ++k) hash.add(c.data()[k]);
  return hash.value();
}

}  // namespace buckens::body

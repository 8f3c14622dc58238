// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/divided_vector.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

/// Vectors of one solid that the other processes have by runs of whole nodes (ranks.h), and the
/// work on them. Beside vectors, each process has its columns of the scalar mass matrix and of
/// the rows N of the body, and the places of its nodes.
class DividedVectors {
 public:
  struct Tables {
    const SparseMatrix* Ms;  ///< scalar mass matrix of the nodes
    const Eigen::Matrix4Xd* positions;
    const Eigen::Matrix4Xd* first_moments;
    const Eigen::SparseMatrix<double, Eigen::RowMajor>* N;  ///< columns: variables
  };
  /// @throws NumericalError if memory is too small
  explicit DividedVectors(const Tables& tables);
  ~DividedVectors();
  DividedVectors(const DividedVectors&) = delete;
  DividedVectors& operator=(const DividedVectors&) = delete;

  Eigen::Index size() const { return size_; }
  /// Rows N, of interfaces and of other places whose values are asked for.
  int num_rows() const { return num_rows_; }
  /// Gives a vector to the others.
  DividedVector put(const Vector& x);
  /// Brings one here. @param x gets its size
  void take(const DividedVector& x, Vector& out) const;
  /// x of K̂ x = b, by a factor of the plug-in which the processes share (SharedFactor).
  DividedVector solve(void* factor, const DividedVector& b);

 private:
  friend class RowProgram;
  DividedVector new_vector();
  // With the turn of the plug-in.
  /// Has the others do what was put off.
  void catch_up() const;
  /// The same, together with tasks that bring sums. @param sums of each process, one after the
  /// other
  void work(std::size_t sums_each, double* sums) const;

  int number_ = -1;
  Eigen::Index size_;
  int num_rows_;
  std::shared_ptr<std::vector<int>> dropped_ = std::make_shared<std::vector<int>>();
  mutable std::vector<std::byte> pending_;  // tasks that nobody waits for
};

/// Work on vectors, written down task by task and then done at once by all processes.
class RowProgram {
 public:
  using Terms = std::span<const std::pair<double, const DividedVector*>>;
  /// Where sums of a task are in what run() brings.
  struct Sums {
    std::size_t first = 0, count = 0;
  };

  explicit RowProgram(DividedVectors& of);

  /// Σ weight x. Terms whose weight is zero are left out.
  DividedVector combine(Terms terms);
  /// y ← y + Σ weight x. @pre no other copy of y is used
  void add(const DividedVector& y, Terms terms);
  DividedVector multiply_mass(const DividedVector& x);
  /// A M d + B M ḋ, empty without weights, and the sums of NodeKernels::couple.
  struct Coupled {
    DividedVector load;
    Sums sums;
  };
  /// @param weights 24 numbers, or null for no load
  Coupled couple(const DividedVector& d, const DividedVector& rate,
                 const DividedVector& acceleration, const double* weights);
  Sums moments(const DividedVector& x);
  /// y ← y − T X of each node. @pre no other copy of y is used
  void subtract(const DividedVector& y, const double* motion);
  /// N x of each, one after the other.
  Sums row_products(std::initializer_list<const DividedVector*> vectors);
  /// kCompared sums.
  Sums compare(const DividedVector& x, const DividedVector& before, const DividedVector& weights);
  /// Of all numbers: not finite if one of them is not.
  Sums total(std::initializer_list<const DividedVector*> vectors);

  /// Has the others do it, at once if there are sums, and otherwise before anything else is done
  /// with these vectors. Vectors that are gone give their memory back after it. @throws
  /// NumericalError if memory is too small
  void run();
  /// Of all rows, the parts of the processes added in their order.
  Vector sum(const Sums& of) const;
  /// The same, largest numbers instead of sums.
  double most(const Sums& of, std::size_t index) const;

 private:
  Sums expect(std::size_t count);
  void put_terms(Terms terms);

  DividedVectors* of_;
  base::BytesTo put_;
  std::size_t expected_ = 0;
  std::vector<double> replies_;  // process after process
};

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

class DividedVectors;

/// A vector of the variables of a solid of which the other processes have the rows; empty if
/// default-made. Copies are the same vector, which lives as long as one of them.
class DividedVector {
 public:
  DividedVector() = default;
  bool empty() const { return held_ == nullptr; }
  /// Of the other processes.
  int number() const { return held_->number; }
  /// Whether another copy is the same vector: then it must not be changed.
  bool is_shared() const { return held_.use_count() > 1; }

 private:
  friend class DividedVectors;
  struct Held {
    std::shared_ptr<std::vector<int>> dropped;  // of its body, when it is gone
    int number;
    ~Held() { dropped->push_back(number); }
  };
  std::shared_ptr<const Held> held_;
};

/// Vectors of one solid that the other processes have by runs of whole nodes (ranks.h), and the
/// work on them. Beside vectors, each process has its columns of the scalar mass matrix and of
/// interface rows, and the places of its nodes.
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
  int num_interface_rows() const { return num_rows_; }
  /// Gives a vector to the others.
  DividedVector put(const Vector& x);
  /// Brings one here. @param x gets its size
  void take(const DividedVector& x, Vector& out) const;
  /// x of K̂ x = b, by a factor of the plug-in which the processes share (SharedFactor).
  DividedVector solve(void* factor, const DividedVector& b);

 private:
  friend class RowProgram;
  DividedVector new_vector();

  int number_ = -1;
  Eigen::Index size_;
  int num_rows_;
  std::shared_ptr<std::vector<int>> dropped_ = std::make_shared<std::vector<int>>();
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
  /// y ← y + Σ weight x. @pre !y.is_shared()
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
  /// y ← y − T X of each node. @pre !y.is_shared()
  void subtract(const DividedVector& y, const double* motion);
  /// N x of each, one after the other.
  Sums row_products(std::initializer_list<const DividedVector*> vectors);
  /// kCompared sums. @param factors empty: weights
  Sums compare(const DividedVector& x, const DividedVector& before, const DividedVector& weights,
               const DividedVector& factors);
  /// Of all numbers: not finite if one of them is not.
  Sums total(std::initializer_list<const DividedVector*> vectors);

  /// Has it done. @throws NumericalError if memory is too small
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

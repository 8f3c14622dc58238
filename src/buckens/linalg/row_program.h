// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/divided_vectors.h"
#include "buckens/linalg/row_task.h"

namespace buckens::linalg {

class DividedMatrix;
class SparseRows;

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
  /// (Ms ⊗ 1) x, of a solid.
  DividedVector multiply_mass(const DividedVector& x);
  /// A x
  DividedVector multiply(const DividedMatrix& A, const DividedVector& x);
  /// Σ (A_ab W_ab d + B_ab W_ab ḋ), empty without weights, and the sums of NodeKernels::couple.
  struct Coupled {
    DividedVector load;
    Sums sums;
  };
  /// @param weights 24 numbers, or null for no load
  Coupled couple(const DividedVector& d, const DividedVector& rate,
                 const DividedVector& acceleration, const double* weights);
  /// See RowInertia::add_moments.
  Sums moments(const DividedVector& x);
  /// y ← y − Φ a. @param motion see RowInertia::subtract @pre no other copy of y is used
  void subtract(const DividedVector& y, const double* motion);
  /// See RowInertia::add_resultants.
  Sums resultants(const DividedVector& f);
  /// f ← f − P a − patterns. @param motion see RowInertia::subtract_load @pre no other copy of f is
  /// used
  void subtract_load(const DividedVector& f, const double* motion);
  /// f ← f + Nᵀ weights. @param weights of the first rows, those of others are zero @pre no other
  /// copy of f is used
  void add_row_loads(const DividedVector& f, const Eigen::Ref<const Vector>& weights);
  /// N x of each, one after the other.
  Sums row_products(std::span<const DividedVector* const> vectors);
  Sums row_products(std::initializer_list<const DividedVector*> vectors) {
    return row_products(std::span(vectors.begin(), vectors.size()));
  }
  /// x of some variables.
  Sums pick(const DividedVector& x, std::span<const int> variables);
  /// kCompared sums. @param of_largest weights of the largest change
  Sums compare(const DividedVector& x, const DividedVector& before, const DividedVector& weights,
               const DividedVector& of_largest);
  /// Of all numbers: not finite if one of them is not.
  Sums total(std::initializer_list<const DividedVector*> vectors);
  /// Σ x²
  Sums square(const DividedVector& x);
  /// Σ x y
  Sums inner_product(const DividedVector& x, const DividedVector& y);
  /// ‖F y‖² of the runs of y = A x that F has columns for: most() gives the largest. @pre no run is
  /// divided
  Sums largest_norm(const SparseRows& A, const DividedVector& x, const Matrix& F);
  /// x times or divided by weights, row by row.
  DividedVector scale(const DividedVector& x, const DividedVector& weights, bool divides);

  /// Some of the pairs of loads and answers that DividedPairs has put there.
  struct Pairs {
    int number, first, count;
  };
  /// cᵢᵀ r of each.
  Sums pair_products(const Pairs& pairs, const DividedVector& r);
  /// r ← r − Σ weight cᵢ, rounded to single precision. @pre no other copy of r is used
  void subtract_loads(const Pairs& pairs, const DividedVector& r, const Vector& weights);
  /// Σ weight xᵢ
  DividedVector combine_answers(const Pairs& pairs, const Vector& weights);
  /// y ← y + Σ weight xᵢ. @pre no other copy of y is used
  void add_answers(const Pairs& pairs, const DividedVector& y, const Vector& weights);
  /// Keeps factor times both. @param pair one of them
  void put_pair(const Pairs& pair, double factor, const DividedVector& load,
                const DividedVector& answer);

  /// Has the others do it, at once if there are sums, and otherwise before anything that depends on
  /// it (PutOffWork). Vectors that are gone give their memory back after it. @throws NumericalError
  /// if memory is too small
  void run();
  /// Of all rows, the parts of the processes added in their order.
  Vector sum(const Sums& of) const;
  /// The same, largest numbers instead of sums.
  double most(const Sums& of, std::size_t index) const;

 private:
  Sums expect(std::size_t count);
  void put_terms(Terms terms);
  void put_pairs(RowTask task, const Pairs& pairs);

  DividedVectors* of_;
  base::BytesTo put_;
  std::size_t expected_ = 0;
  std::vector<double> replies_;  // process after process
};

/// Of a whole body whose inertia acts node by node, from the sums of moments() or resultants(), and
/// of any body from those of couple().
NodeSums node_sums(const Vector& sums);

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/row_inertia.h"
#include "buckens/linalg/row_tables.h"
#include "buckens/linalg/row_task.h"

namespace buckens::linalg {

/// How processes that have rows of the same vectors reach each other.
class RowPeers {
 public:
  virtual ~RowPeers() = default;
  /// Gives numbers to each of them and takes some from each, process after process, its own place
  /// included. All call it together.
  virtual void exchange(std::span<const int> out_counts, const double* out,
                        std::span<const int> in_counts, double* in) = 0;
  /// y = A x of the rows that they have, A a divided matrix with the same runs of rows. All call it
  /// together.
  virtual void multiply(int matrix, const double* x, double* y) = 0;
  /// A matrix of rows (SparseRows), multiplied by vectors of a body.
  struct RowsOfBody {
    int matrix, space;
    bool is_new;            ///< to each other; then `rows` is read
    std::vector<int> rows;  ///< of the vector for the columns of the matrix; empty: the same
  };
  /// Its products that are here, until the next call. All call it together.
  virtual std::span<const double> multiply(const RowsOfBody& A, const double* x) = 0;
  /// Rows here of kept pairs (DividedPairs), each one behind the other.
  struct Pairs {
    float *loads, *answers;
  };
  virtual Pairs pairs(int number) = 0;

 protected:
  RowPeers() = default;
  RowPeers(const RowPeers&) = default;
  RowPeers& operator=(const RowPeers&) = default;
};

/// Rows of the vectors of bodies in one process, and the work on them that the first one asks for
/// (DividedVectors). Rows follow runs of whole units: nodes of solids, variables of other bodies.
class RowWorker {
 public:
  /// Rows of a body, which a program names by a number.
  void add(int space, RowTables tables);
  /// With all vectors of the body.
  void remove(int space);
  /// Does what a program says, together with the other processes.
  /// @return sums of the rows here, task after task; valid until the next call
  std::span<const double> work(std::span<const std::byte> program, RowPeers& peers);
  /// The rows of a vector of a body that are here; gives it room if it has none.
  std::span<double> rows(int space, int vector);
  std::size_t num_vectors() const { return vectors_.size(); }

 private:
  struct Space {
    int number = 0;
    RowTables tables;
    std::unique_ptr<RowInertia> inertia;
    std::size_t width() const { return static_cast<std::size_t>(tables.width); }
    std::size_t rows() const { return width() * static_cast<std::size_t>(tables.count); }
    /// Of a vector with the units beside; one more, since kernels read four numbers of a node.
    std::size_t room() const { return rows() + width() * tables.beside.size() + 1; }
  };
  struct Held {
    const Space* space = nullptr;
    std::vector<double> numbers;
  };
  using Take = base::BytesFrom;

  Held& held(int vector) { return vectors_.at(vector); }
  double* at(int vector) { return held(vector).numbers.data(); }
  void drop(int vector);
  double* make_room(const Space& space, int vector);
  void do_task(RowTask task, const Space& space, Take& take, RowPeers& peers);
  void combine(const Space& space, Take& take);
  void multiply_mass(const Space& space, Take& take, RowPeers& peers);
  void multiply(const Space& space, Take& take, RowPeers& peers);
  void couple(const Space& space, Take& take, RowPeers& peers);
  void add_row_loads(const Space& space, Take& take);
  void multiply_rows(const Space& space, Take& take);
  void pick(const Space& space, Take& take);
  void compare(const Space& space, Take& take);
  void add_total(const Space& space, Take& take);
  void add_square(const Space& space, Take& take);
  void add_inner_product(const Space& space, Take& take);
  void find_largest_norm(const Space& space, Take& take, RowPeers& peers);
  void scale(const Space& space, Take& take);
  void do_inertia(RowTask task, const Space& space, Take& take, RowPeers& peers);
  void do_pairs(RowTask task, const Space& space, Take& take, RowPeers& peers);
  /// Brings the units beside those here.
  void fill_beside(const Space& space, std::initializer_list<double*> vectors, RowPeers& peers);

  std::map<int, std::unique_ptr<Space>> spaces_;
  std::map<int, Held> vectors_;
  std::vector<std::vector<double>> spare_;  // of vectors that were dropped
  std::vector<double> sums_, out_, in_;
};

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/node_kernels.h"
#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

/// How processes that have rows of the same vectors reach each other.
class RowPeers {
 public:
  virtual ~RowPeers() = default;
  /// Gives numbers to each of them and takes some from each, process after process, its own place
  /// included. All call it together.
  virtual void exchange(std::span<const int> out_counts, const double* out,
                        std::span<const int> in_counts, double* in) = 0;

 protected:
  RowPeers() = default;
  RowPeers(const RowPeers&) = default;
  RowPeers& operator=(const RowPeers&) = default;
};

/// What of a solid a process needs for its rows of vectors: a run of nodes, numbered from 0 here.
struct RowTables {
  int first_node = 0;          ///< of the whole mesh
  int nodes = 0;               ///< here
  SparseMatrix Ms;             ///< columns of the nodes here; rows are places, see `beside`
  Eigen::Matrix4Xd positions;  ///< and 1
  Eigen::Matrix4Xd first_moments;
  Eigen::SparseMatrix<double, Eigen::RowMajor> N;  ///< columns of the variables here
  std::vector<int> beside;      ///< nodes of others, ascending: their places follow those here
  std::vector<int> in_counts;   ///< of these, per process
  std::vector<int> sent;        ///< nodes here that others have beside theirs, process by process
  std::vector<int> out_counts;  ///< of these, per process
};

/// Rows of the vectors of bodies in one process, and the work on them that the first one asks for
/// (DividedVectors). Rows follow runs of whole nodes of three variables.
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
    RowTables tables;
    NodeMatrix mass;
    std::size_t rows() const { return 3 * static_cast<std::size_t>(tables.nodes); }
    /// Of a vector with the nodes beside; one more, since kernels read four numbers of a node.
    std::size_t room() const { return rows() + 3 * tables.beside.size() + 1; }
  };
  struct Held {
    const Space* space = nullptr;
    std::vector<double> numbers;
  };
  using Take = base::BytesFrom;

  Held& held(int vector) { return vectors_.at(vector); }
  double* at(int vector) { return held(vector).numbers.data(); }
  double* make_room(const Space& space, int vector);
  void do_task(RowTask task, const Space& space, Take& take, RowPeers& peers);
  void combine(const Space& space, Take& take);
  void multiply_mass(const Space& space, Take& take, RowPeers& peers);
  void couple(const Space& space, Take& take, RowPeers& peers);
  void add_moments(const Space& space, Take& take);
  void subtract(const Space& space, Take& take);
  void multiply_rows(const Space& space, Take& take);
  void compare(const Space& space, Take& take);
  void add_total(const Space& space, Take& take);
  /// Brings the nodes beside those here.
  void fill_beside(const Space& space, std::initializer_list<double*> vectors, RowPeers& peers);

  const NodeKernels* kernels_ = &node_kernels();
  std::map<int, std::unique_ptr<Space>> spaces_;
  std::map<int, Held> vectors_;
  std::vector<std::vector<double>> spare_;  // of vectors that were dropped
  std::vector<double> sums_, out_, in_;
};

/// Of a solid's scalar mass matrix, places of nodes and interface rows what belongs to one run of
/// nodes. @param first_nodes of all processes, and the end. @param place of the process
void describe_rows(const SparseMatrix& Ms, const Eigen::Matrix4Xd& positions,
                   const Eigen::Matrix4Xd& first_moments,
                   const Eigen::SparseMatrix<double, Eigen::RowMajor>& N,
                   std::span<const int> first_nodes, std::size_t place, base::BytesTo& put);
RowTables described_rows(base::BytesFrom& take);

}  // namespace buckens::linalg

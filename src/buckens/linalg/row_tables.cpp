// SPDX-License-Identifier: Apache-2.0
// What of a solid belongs to the nodes of one process, as bytes.
#include <algorithm>

#include "buckens/linalg/row_worker.h"

namespace buckens::linalg {

namespace {

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Entries of the columns of some variables, with columns counted from the first of them.
RowMajor columns_of(const RowMajor& N, int first, int end) {
  std::vector<Triplet> entries;
  for (int row = 0; row < N.outerSize(); ++row) {
    for (RowMajor::InnerIterator it(N, row); it; ++it) {
      if (it.col() >= first && it.col() < end)
        entries.emplace_back(row, it.col() - first, it.value());
    }
  }
  RowMajor out(N.rows(), end - first);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

template <class Sparse>
void put_sparse(const Sparse& A, base::BytesTo& put) {
  put(static_cast<int>(A.rows()));
  put(static_cast<int>(A.cols()));
  put(static_cast<int>(A.nonZeros()));
  put.all(A.outerIndexPtr(), static_cast<std::size_t>(A.outerSize()) + 1);
  put.all(A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros()));
  put.all(A.valuePtr(), static_cast<std::size_t>(A.nonZeros()));
}

template <class Sparse>
Sparse taken_sparse(base::BytesFrom& take) {
  const auto rows = take.next<int>();
  const auto columns = take.next<int>();
  const auto entries = take.next<int>();
  Sparse A(rows, columns);
  A.resizeNonZeros(entries);
  take.take_all(A.outerIndexPtr(), static_cast<std::size_t>(A.outerSize()) + 1);
  take.take_all(A.innerIndexPtr(), static_cast<std::size_t>(entries));
  take.take_all(A.valuePtr(), static_cast<std::size_t>(entries));
  return A;
}

template <class T>
void put_list(const std::vector<T>& list, base::BytesTo& put) {
  put(static_cast<int>(list.size()));
  put.all(list.data(), list.size());
}

std::vector<int> taken_list(base::BytesFrom& take) {
  std::vector<int> list(static_cast<std::size_t>(take.next<int>()));
  take.take_all(list.data(), list.size());
  return list;
}

/// The neighbours of the nodes of a process, and who has them. Since Ms is symmetric, a process
/// has beside its nodes those of another that have one of its own beside them.
void find_neighbours(const SparseMatrix& Ms, std::span<const int> first_nodes, std::size_t place,
                     RowTables& own) {
  const std::size_t count = first_nodes.size() - 1;
  const int end = own.first_node + own.nodes;
  std::vector<std::vector<int>> sent(count);
  for (int node = own.first_node; node < end; ++node) {
    for (SparseMatrix::InnerIterator it(Ms, node); it; ++it) {
      const auto other = static_cast<int>(it.row());
      if (other >= own.first_node && other < end) continue;
      own.beside.push_back(other);
      const auto who =
          static_cast<std::size_t>(std::upper_bound(first_nodes.begin(), first_nodes.end(), other) -
                                   first_nodes.begin() - 1);
      if (sent[who].empty() || sent[who].back() != node) sent[who].push_back(node);
    }
  }
  std::sort(own.beside.begin(), own.beside.end());
  own.beside.erase(std::unique(own.beside.begin(), own.beside.end()), own.beside.end());
  for (std::size_t k = 0; k < count; ++k) {
    const auto begin = std::lower_bound(own.beside.begin(), own.beside.end(), first_nodes[k]);
    const auto last = std::lower_bound(begin, own.beside.end(), first_nodes[k + 1]);
    own.in_counts.push_back(k == place ? 0 : static_cast<int>(last - begin));
    own.out_counts.push_back(static_cast<int>(sent[k].size()));
    for (const int node : sent[k]) own.sent.push_back(node - own.first_node);
  }
}

}  // namespace

void describe_rows(const SparseMatrix& Ms, const Eigen::Matrix4Xd& positions,
                   const Eigen::Matrix4Xd& first_moments, const RowMajor& N,
                   std::span<const int> first_nodes, std::size_t place, base::BytesTo& put) {
  RowTables own;
  own.first_node = first_nodes[place];
  own.nodes = first_nodes[place + 1] - own.first_node;
  find_neighbours(Ms, first_nodes, place, own);
  SparseMatrix columns = Ms.middleCols(own.first_node, own.nodes);
  columns.makeCompressed();
  for (Eigen::Index e = 0; e < columns.nonZeros(); ++e) {
    int& row = columns.innerIndexPtr()[e];
    const auto found = std::lower_bound(own.beside.begin(), own.beside.end(), row);
    const bool is_beside = found != own.beside.end() && *found == row;
    row =
        is_beside ? own.nodes + static_cast<int>(found - own.beside.begin()) : row - own.first_node;
  }
  const auto nodes = static_cast<std::size_t>(own.nodes);
  put(own.first_node);
  put(own.nodes);
  put_sparse(columns, put);
  put.all(positions.col(own.first_node).data(), 4 * nodes);
  put.all(first_moments.col(own.first_node).data(), 4 * nodes);
  put_sparse(columns_of(N, 3 * own.first_node, 3 * (own.first_node + own.nodes)), put);
  for (const auto* list : {&own.beside, &own.in_counts, &own.sent, &own.out_counts}) {
    put_list(*list, put);
  }
}

RowTables described_rows(base::BytesFrom& take) {
  RowTables out;
  take(out.first_node);
  take(out.nodes);
  out.Ms = taken_sparse<SparseMatrix>(take);
  for (Eigen::Matrix4Xd* places : {&out.positions, &out.first_moments}) {
    places->resize(4, out.nodes);
    take.take_all(places->data(), 4 * static_cast<std::size_t>(out.nodes));
  }
  out.N = taken_sparse<RowMajor>(take);
  for (auto* list : {&out.beside, &out.in_counts, &out.sent, &out.out_counts}) {
    *list = taken_list(take);
  }
  return out;
}

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
// What of a body belongs to the rows of one process, as bytes.
#include "buckens/linalg/row_tables.h"

#include "buckens/linalg/row_neighbours.h"

namespace buckens::linalg {

namespace {

/// Entries of the columns of rows `first` to `end` − 1, with columns counted from the first.
RowMajorMatrix columns_of(const RowMajorMatrix& N, const UnitOrder& order, int first, int end) {
  std::vector<Triplet> entries;
  for (int row = 0; row < N.outerSize(); ++row) {
    for (RowMajorMatrix::InnerIterator it(N, row); it; ++it) {
      const int column = order.unit(static_cast<int>(it.col()));
      if (column >= first && column < end) entries.emplace_back(row, column - first, it.value());
    }
  }
  RowMajorMatrix out(N.rows(), end - first);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
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

NodeTables described_nodes(int nodes, base::BytesFrom& take) {
  NodeTables out;
  out.Ms = taken_sparse<SparseMatrix>(take);
  for (Eigen::Matrix4Xd* places : {&out.positions, &out.first_moments}) {
    places->resize(4, nodes);
    take.take_all(places->data(), 4 * static_cast<std::size_t>(nodes));
  }
  return out;
}

}  // namespace

void put_runs(const RowTables& own, const RowMajorMatrix& N, const SharedRowOrder& order,
              base::BytesTo& put) {
  put(own.width);
  put(own.first);
  put(own.count);
  const int first = own.width * own.first;
  put_sparse(columns_of(N, {order, 1}, first, first + own.width * own.count), put);
  for (const auto* list : {&own.beside, &own.in_counts, &own.sent, &own.out_counts}) {
    put_list(*list, put);
  }
}

void describe_rows(const WholeNodes& of, const RowMajorMatrix& N, std::span<const int> first_units,
                   std::size_t place, base::BytesTo& put) {
  RowTables own;
  own.width = 3;
  const UnitOrder order(of.order, own.width);
  RowNeighbours neighbours(first_units, place, own);
  for (int node = own.first; node < own.first + own.count; ++node) {
    for (SparseMatrix::InnerIterator it(*of.Ms, order.number(node)); it; ++it) {
      neighbours.add(node, order.unit(static_cast<int>(it.row())));
    }
  }
  neighbours.finish();
  put_runs(own, N, of.order, put);
  put_sparse(columns_at_places(*of.Ms, own, order, neighbours), put);
  for (const Eigen::Matrix4Xd* columns : {of.positions, of.first_moments}) {
    for (int node = own.first; node < own.first + own.count; ++node) {
      put.all(columns->col(order.number(node)).data(), 4);
    }
  }
}

RowTables described_rows(base::BytesFrom& take) {
  RowTables out;
  take(out.width);
  take(out.first);
  take(out.count);
  out.N = taken_sparse<RowMajorMatrix>(take);
  for (auto* list : {&out.beside, &out.in_counts, &out.sent, &out.out_counts}) {
    *list = taken_list(take);
  }
  if (out.width == 3) {
    out.inertia = described_nodes(out.count, take);
  } else {
    out.inertia = described_variables(take);
  }
  return out;
}

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
// What of a body of any elements belongs to the variables of one process, as bytes.
#include <algorithm>

#include "buckens/linalg/row_neighbours.h"

namespace buckens::linalg {

namespace {

struct Pair {
  int a, b;
};
// Of WholeVariables::W.
constexpr std::array<Pair, 6> kStored = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
constexpr int kNoMore = -1;  // after the integrals

bool is_missing(const SparseMatrix& A) { return A.nonZeros() == 0; }

/// What belongs to one process, found in two passes: which variables are beside, then where.
class Run {
 public:
  Run(const WholeVariables& of, std::span<const int> first_units, std::size_t place)
      : of_(&of), order_of_rows_(of.order, 1), neighbours_(first_units, place, own_) {
    own_.width = 1;
  }

  void find_neighbours() {
    for_rows([this](int, const SparseMatrix& columns) {
      for (int i = own_.first; i < own_.first + own_.count; ++i) {
        for (SparseMatrix::InnerIterator it(columns, order_of_rows_.number(i)); it; ++it) {
          neighbours_.add(i, row(static_cast<int>(it.row())));
        }
      }
    });
    if (has_nodes()) find_nodes();
    neighbours_.finish();
  }

  void put(const RowMajorMatrix& N, base::BytesTo& put) const {
    put_runs(own_, N, of_->order, put);
    for_rows([&](int k, const SparseMatrix& columns) {
      put(k);
      put_sparse(columns_at_places(columns, own_, order_of_rows_, neighbours_), put);
    });
    put(kNoMore);
    put_nodes(put);
    for (const Matrix* columns : {of_->Phi, of_->P, of_->patterns}) {
      const Matrix here =
          columns->rows() == 0 ? Matrix(own_.count, 0) : rows_here(*columns, own_, order_of_rows_);
      put(static_cast<int>(here.rows()));
      put(static_cast<int>(here.cols()));
      put.all(here.data(), static_cast<std::size_t>(here.size()));
    }
  }

 private:
  bool has_nodes() const { return of_->Ms != nullptr && !is_missing(*of_->Ms); }
  /// Rows of the variables of a node, −1 where there is none.
  std::array<int, 3> rows_of(int node) const {
    std::array<int, 3> out = (*of_->dofs)[static_cast<std::size_t>(node)];
    for (int& dof : out) dof = dof < 0 ? -1 : row(dof);
    return out;
  }
  int row(int variable) const { return order_of_rows_.unit(variable); }

  /// Calls f(3a + b, W_ba), whose columns are the rows of W_ab.
  template <class F>
  void for_rows(F&& f) const {
    for (std::size_t k = 0; k < kStored.size(); ++k) {
      const SparseMatrix& W = (*of_->W)[k];
      if (is_missing(W)) continue;
      const auto [a, b] = kStored[k];
      f(3 * b + a, W);
      if (a != b) f(3 * a + b, SparseMatrix(W.transpose()));
    }
  }

  /// Nodes with variables here, and those beside them.
  void find_nodes() {
    const SparseMatrix& Ms = *of_->Ms;
    places_.assign(static_cast<std::size_t>(Ms.cols()), -1);
    for (int node = 0; node < Ms.cols(); ++node) {
      const bool is_own = std::ranges::any_of(
          rows_of(node), [this](int row) { return row >= 0 && neighbours_.is_here(row); });
      if (is_own && SparseMatrix::InnerIterator(Ms, node)) nodes_.push_back(node);
    }
    num_own_ = nodes_.size();
    for (std::size_t k = 0; k < num_own_; ++k) {
      places_[static_cast<std::size_t>(nodes_[k])] = static_cast<int>(k);
    }
    for (std::size_t k = 0; k < num_own_; ++k) {
      for (SparseMatrix::InnerIterator it(Ms, nodes_[k]); it; ++it) {
        join(nodes_[k], static_cast<int>(it.row()));
        int& at = places_[static_cast<std::size_t>(it.row())];
        if (at >= 0) continue;
        at = static_cast<int>(nodes_.size());
        nodes_.push_back(static_cast<int>(it.row()));
      }
    }
  }

  /// All variables of a node go with each variable here of another.
  void join(int node, int other) {
    for (const int own : rows_of(node)) {
      if (own < 0 || !neighbours_.is_here(own)) continue;
      for (const int row : rows_of(other)) {
        if (row >= 0) neighbours_.add(own, row);
      }
    }
  }

  void put_nodes(base::BytesTo& put) const {
    put(static_cast<int>(nodes_.size()));
    for (const int node : nodes_) {
      for (const int row : rows_of(node)) put(row < 0 ? -1 : neighbours_.place_of(row));
    }
    std::vector<Triplet> entries;
    for (std::size_t k = 0; k < num_own_; ++k) {
      for (SparseMatrix::InnerIterator it(*of_->Ms, nodes_[k]); it; ++it) {
        entries.emplace_back(places_[static_cast<std::size_t>(it.row())], static_cast<int>(k),
                             it.value());
      }
    }
    SparseMatrix columns(static_cast<Eigen::Index>(nodes_.size()),
                         static_cast<Eigen::Index>(num_own_));
    columns.setFromTriplets(entries.begin(), entries.end());
    put_sparse(columns, put);
  }

  const WholeVariables* of_;
  UnitOrder order_of_rows_;
  RowTables own_;
  RowNeighbours neighbours_;
  std::vector<int> nodes_;   // those with variables here first
  std::vector<int> places_;  // place of each node there, −1: none
  std::size_t num_own_ = 0;
};

}  // namespace

void describe_rows(const WholeVariables& of, const RowMajorMatrix& N,
                   std::span<const int> first_units, std::size_t place, base::BytesTo& put) {
  Run run(of, first_units, place);
  run.find_neighbours();
  run.put(N, put);
}

VariableTables described_variables(base::BytesFrom& take) {
  VariableTables out;
  for (int k = take.next<int>(); k != kNoMore; take(k)) {
    out.W[static_cast<std::size_t>(k)] = taken_sparse<SparseMatrix>(take);
  }
  out.nodes.resize(static_cast<std::size_t>(take.next<int>()));
  for (std::array<int, 3>& places : out.nodes) take.take_all(places.data(), places.size());
  out.Ms = taken_sparse<SparseMatrix>(take);
  for (Matrix* columns : {&out.Phi, &out.P, &out.patterns}) {
    const auto rows = take.next<int>();
    columns->resize(rows, take.next<int>());
    take.take_all(columns->data(), static_cast<std::size_t>(columns->size()));
  }
  return out;
}

}  // namespace buckens::linalg

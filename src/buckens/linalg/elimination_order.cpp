// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/elimination_order.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>

#include <amd.h>
#include <metis.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/node_blocks.h"

namespace buckens::linalg {

namespace {

// Below these numbers least degree fills as little and takes less time.
constexpr int kManyColumns = 3000, kManyVertices = 200;

/// The rows of columns of a matrix, each valid until the next is read.
class RowsOfMatrix {
 public:
  explicit RowsOfMatrix(const SparseMatrix& A) : A_(&A) {}
  std::span<const int> of(int column) {
    const int begin = A_->outerIndexPtr()[column];
    const int count = A_->isCompressed() ? A_->outerIndexPtr()[column + 1] - begin
                                         : A_->innerNonZeroPtr()[column];
    return {A_->innerIndexPtr() + begin, static_cast<std::size_t>(count)};
  }

 private:
  const SparseMatrix* A_;
};

class RowsOfSum {
 public:
  explicit RowsOfSum(const MatrixSum& A) : A_(&A) {}
  std::span<const int> of(int column) {
    A_->read_column(column, entries_);
    rows_.clear();
    for (const MatrixSum::Entry& entry : entries_) rows_.push_back(entry.row);
    return rows_;
  }

 private:
  const MatrixSum* A_;
  std::vector<MatrixSum::Entry> entries_;
  std::vector<int> rows_;
};

/// Nodes of the rows of nodes.
class NodesOfBlocks {
 public:
  explicit NodesOfBlocks(const NodeBlocks& A) : A_(&A) {}
  std::span<const int> of(int node) {
    A_->read_nodes(node, nodes_);
    return nodes_;
  }

 private:
  const NodeBlocks* A_;
  std::vector<int> nodes_;
};

/// A number that differs between columns with different rows, nearly always.
std::uint64_t fingerprint(std::span<const int> rows) {
  std::uint64_t sum = rows.size();
  for (const int row : rows) {
    std::uint64_t x = static_cast<std::uint64_t>(row) + 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    sum += x ^ (x >> 31U);
  }
  return sum;
}

/// Vertex of each column. @param marks of the columns @param are_equal whether two columns with the
/// same mark are one vertex
template <class Equal>
std::vector<int> gather_columns(const std::vector<std::uint64_t>& marks, Equal&& are_equal) {
  std::vector<std::pair<std::uint64_t, int>> sorted(marks.size());
  for (std::size_t c = 0; c < marks.size(); ++c) sorted[c] = {marks[c], static_cast<int>(c)};
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> leader(marks.size());  // first column with the same rows
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto [mark, column] = sorted[k];
    int& mine = leader[static_cast<std::size_t>(column)];
    mine = column;
    if (k == 0 || sorted[k - 1].first != mark) continue;
    const int before = leader[static_cast<std::size_t>(sorted[k - 1].second)];
    if (are_equal(before, column)) mine = before;
  }
  std::vector<int> vertex(marks.size());
  int count = 0;
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    const auto first = static_cast<std::size_t>(leader[c]);
    vertex[c] = first == c ? count++ : vertex[first];
  }
  return vertex;
}

/// The columns of each vertex.
ColumnGraph with_columns(const std::vector<int>& vertex) {
  ColumnGraph graph;
  const int count = vertex.empty() ? 0 : *std::max_element(vertex.begin(), vertex.end()) + 1;
  graph.first_column.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const int v : vertex) ++graph.first_column[static_cast<std::size_t>(v) + 1];
  std::partial_sum(graph.first_column.begin(), graph.first_column.end(),
                   graph.first_column.begin());
  graph.columns.resize(vertex.size());
  std::vector<int> next(graph.first_column.begin(), graph.first_column.end() - 1);
  for (std::size_t c = 0; c < vertex.size(); ++c) {
    int& place = next[static_cast<std::size_t>(vertex[c])];
    graph.columns[static_cast<std::size_t>(place++)] = static_cast<int>(c);
  }
  return graph;
}

/// @param lists neighbours of each vertex, some more than once; emptied
void set_neighbours(std::vector<std::vector<int>>& lists, ColumnGraph& graph) {
  graph.begin.push_back(0);
  for (std::vector<int>& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    std::vector<int>().swap(list);
  }
}

/// Lists of vertices, one behind the other: vertex v has entries[begin[v]] …
struct Lists {
  std::vector<int> begin, entries;

  bool operator==(const Lists&) const = default;
  std::span<const int> of(std::size_t v) const {
    return {entries.data() + begin[v], entries.data() + begin[v + 1]};
  }
};

/// The vertices that each vertex is listed by, ascending.
Lists transposed(const Lists& lists) {
  Lists out;
  const std::size_t count = lists.begin.size() - 1;
  out.begin.assign(count + 1, 0);
  for (const int w : lists.entries) ++out.begin[static_cast<std::size_t>(w) + 1];
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.entries.resize(lists.entries.size());
  std::vector<int> next(out.begin.begin(), out.begin.end() - 1);
  for (std::size_t v = 0; v < count; ++v) {
    for (const int w : lists.of(v)) {
      int& place = next[static_cast<std::size_t>(w)];
      out.entries[static_cast<std::size_t>(place++)] = static_cast<int>(v);
    }
  }
  return out;
}

/// Other vertices in the rows of the first column of each vertex.
template <class Rows>
Lists listed_rows(Rows& rows, const std::vector<int>& vertex, const ColumnGraph& graph) {
  Lists out;
  const std::size_t count = graph.first_column.size() - 1;
  std::vector<int> seen(count, -1);
  out.begin.push_back(0);
  for (std::size_t v = 0; v < count; ++v) {
    const auto first = static_cast<std::size_t>(graph.first_column[v]);
    seen[v] = static_cast<int>(v);
    for (const int row : rows.of(graph.columns[first])) {
      const int w = vertex[static_cast<std::size_t>(row)];
      if (std::exchange(seen[static_cast<std::size_t>(w)], static_cast<int>(v)) ==
          static_cast<int>(v))
        continue;
      out.entries.push_back(w);
    }
    out.begin.push_back(static_cast<int>(out.entries.size()));
  }
  return out;
}

/// Neighbours by the rows of the first column of each vertex. Twice transposed lists are sorted,
/// in a third of the time that sorting them takes.
template <class Rows>
void list_neighbours(Rows& rows, const std::vector<int>& vertex, ColumnGraph& graph) {
  Lists listing = transposed(listed_rows(rows, vertex, graph));
  const Lists listed = transposed(listing);
  if (listing == listed) {  // each entry has its mirror image
    graph.begin = std::move(listing.begin);
    graph.neighbours = std::move(listing.entries);
    return;
  }
  graph.begin.push_back(0);
  for (std::size_t v = 0; v + 1 < listed.begin.size(); ++v) {
    std::ranges::set_union(listed.of(v), listing.of(v), std::back_inserter(graph.neighbours));
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
  }
}

std::vector<int> by_least_degree(const ColumnGraph& graph) {
  std::vector<int> order(static_cast<std::size_t>(graph.size()));
  const int status = amd_order(graph.size(), graph.begin.data(), graph.neighbours.data(),
                               order.data(), nullptr, nullptr);
  if (status < AMD_OK) throw NumericalError("the equations could not be ordered (AMD)");
  return order;
}

std::vector<int> by_nested_dissection(const ColumnGraph& graph) {
  std::vector<idx_t> begin(graph.begin.begin(), graph.begin.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> weights;
  for (int v = 0; v < graph.size(); ++v) weights.push_back(graph.weight(v));
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_COMPRESS] = 0;  // done
  options[METIS_OPTION_SEED] = 1;
  idx_t vertices = graph.size();
  std::vector<idx_t> order(weights.size()), place(weights.size());
  // METIS draws its random numbers from a generator that all threads of the process share.
  static std::mutex turn;
  const std::scoped_lock lock(turn);
  const int status = METIS_NodeND(&vertices, begin.data(), neighbours.data(), weights.data(),
                                  options, order.data(), place.data());
  if (status != METIS_OK) throw NumericalError("the equations could not be ordered (METIS)");
  return {order.begin(), order.end()};
}

/// @param rows, others of the same matrix
template <class Rows>
ColumnGraph graph_of_rows(Eigen::Index columns, Rows rows, Rows others) {
  std::vector<std::uint64_t> marks(static_cast<std::size_t>(columns));
  for (std::size_t c = 0; c < marks.size(); ++c) {
    marks[c] = fingerprint(rows.of(static_cast<int>(c)));
  }
  const std::vector<int> vertex = gather_columns(
      marks, [&](int a, int b) { return std::ranges::equal(rows.of(a), others.of(b)); });
  ColumnGraph graph = with_columns(vertex);
  list_neighbours(rows, vertex, graph);
  return graph;
}

/// Whether a term has entries only between nodes that have a block.
bool is_within(const MatrixSum::Term& term, const NodeBlocks& blocks) {
  const NodeBlocks* own_blocks = term.blocks();
  const SparseMatrix* own_nodes = term.nodes();
  if (own_blocks == &blocks) return true;
  if (own_blocks == nullptr && own_nodes == nullptr) return false;
  std::vector<int> nodes, own;
  for (int node = 0; node < blocks.size() / 3; ++node) {
    blocks.read_nodes(node, nodes);
    if (own_blocks != nullptr) {
      own_blocks->read_nodes(node, own);
    } else {
      const int* rows = own_nodes->innerIndexPtr();
      own.assign(rows + own_nodes->outerIndexPtr()[node],
                 rows + own_nodes->outerIndexPtr()[node + 1]);
    }
    if (!std::ranges::includes(nodes, own)) return false;
  }
  return true;
}

/// The term whose blocks are between the same nodes as all entries of the sum; null: there is none.
const NodeBlocks* blocks_of_sum(const MatrixSum& A) {
  const auto& terms = A.terms();
  const auto found = std::ranges::find_if(terms, [](const MatrixSum::Term& term) {
    return term.blocks() != nullptr && term.blocks()->has_whole_blocks();
  });
  if (found == terms.end()) return nullptr;
  const NodeBlocks& blocks = *found->blocks();
  const bool is_all = std::ranges::all_of(
      terms, [&](const MatrixSum::Term& term) { return is_within(term, blocks); });
  return is_all ? &blocks : nullptr;
}

/// Of the columns of nodes. @param graph of nodes
ColumnGraph of_columns(const ColumnGraph& graph) {
  ColumnGraph out = graph;
  for (int& first : out.first_column) first *= 3;
  out.columns.clear();
  for (const int node : graph.columns) {
    for (int k = 0; k < 3; ++k) out.columns.push_back(3 * node + k);
  }
  return out;
}

}  // namespace

ColumnGraph column_graph(const SparseMatrix& A) {
  return graph_of_rows(A.cols(), RowsOfMatrix(A), RowsOfMatrix(A));
}

ColumnGraph column_graph(const MatrixSum& A) {
  if (const NodeBlocks* blocks = blocks_of_sum(A)) {
    const NodesOfBlocks rows(*blocks);
    return of_columns(graph_of_rows(blocks->size() / 3, rows, rows));
  }
  return graph_of_rows(A.size(), RowsOfSum(A), RowsOfSum(A));
}

std::vector<int> vertices_of(const std::vector<std::uint64_t>& marks) {
  return gather_columns(marks, [](int, int) { return true; });
}

ColumnGraph graph_of(const std::vector<int>& vertex, std::span<const int> edges) {
  ColumnGraph graph = with_columns(vertex);
  std::vector<std::vector<int>> others(graph.first_column.size() - 1);
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2) {
    others[static_cast<std::size_t>(edges[k])].push_back(edges[k + 1]);
    others[static_cast<std::size_t>(edges[k + 1])].push_back(edges[k]);
  }
  set_neighbours(others, graph);
  return graph;
}

std::vector<int> elimination_order(const ColumnGraph& graph) {
  if (graph.neighbours.empty()) {
    std::vector<int> order(static_cast<std::size_t>(graph.size()));
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  const bool is_large =
      static_cast<int>(graph.columns.size()) >= kManyColumns && graph.size() >= kManyVertices;
  return is_large ? by_nested_dissection(graph) : by_least_degree(graph);
}

}  // namespace buckens::linalg

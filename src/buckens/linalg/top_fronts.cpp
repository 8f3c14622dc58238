// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/top_fronts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/tile_products.h"

namespace buckens::linalg {

namespace {

constexpr int kMostRows = Trapezoid::kBlock;

std::size_t index_of(int k) { return static_cast<std::size_t>(k); }

/// Bounds of tiles of the rows from `begin` on: those of the blocks of the front, and then equal
/// steps.
std::vector<int> tile_bounds(const Trapezoid& own, int begin) {
  std::vector<int> bounds;
  for (int row = begin; row < own.columns; row += kMostRows) bounds.push_back(row);
  for (int row = own.columns; row < own.rows; row += kMostRows) bounds.push_back(row);
  bounds.push_back(own.rows);
  return bounds;
}

}  // namespace

/// Rows and columns of the products of some blocks of a front, numbered as its rows are.
struct TopFronts::Tile {
  int first_block, end_block;
  int column, columns;
  int row, rows;

  bool is_square() const { return row == column; }

  /// C ← β C − X Yᵀ, of the lower triangle if it is square.
  void subtract(const Front& source, double beta, double* C, int stride) const {
    const Trapezoid& own = source.own();
    for (int q = first_block; q < end_block; ++q, beta = 1.0) {
      const double* X = own.block(source.own_values(), q, row);
      if (is_square()) {
        subtract_square(beta, C, stride, X, own.stride(q), rows, own.width(q));
      } else {
        const double* Y = own.block(source.own_values(), q, column);
        subtract_product(beta, C, stride, X, own.stride(q), Y, own.stride(q), rows, columns,
                         own.width(q));
      }
    }
  }
};

TopFronts::TopFronts(const SupernodeTree& tree, std::function<void(int s, const Front&)> begin,
                     MemoryCount& count)
    : tree_(tree), begin_(std::move(begin)), count_(count), rooms_(count) {}

Front& TopFronts::front(int s, TaskPool* pool) {
  const auto found = open_.find(s);
  if (found != open_.end()) return found->second.front;
  const Front shape(tree_.columns(s), tree_.rows_below(s));
  Open& made = open_.emplace(s, Open{shape, CountedMemory(shape.own_size(), count_)}).first->second;
  made.front.begin(made.memory.data(), nullptr, pool);
  begin_(s, made.front);
  return made.front;
}

/// Rows of the front of s for those from `begin` on of a front below it.
RowRuns TopFronts::runs_in(int s, int begin, const std::vector<int>& rows) const {
  const int first = tree_.first_column[index_of(s)];
  const int columns = tree_.columns(s);
  const int* below = tree_.rows_of(s);
  std::vector<int> places;
  for (std::size_t i = index_of(begin); i < rows.size(); ++i) {
    if (rows[i] < first + columns) {
      places.push_back(rows[i] - first);
      continue;
    }
    while (*below < rows[i]) ++below;
    places.push_back(columns + static_cast<int>(below - tree_.rows_of(s)));
  }
  return RowRuns(places, begin);
}

/// The fronts from s upwards of which the rows from `begin` on are columns.
std::vector<TopFronts::Target> TopFronts::targets(int s, int begin, const std::vector<int>& rows,
                                                  TaskPool* pool) {
  std::vector<Target> out;
  const int count = static_cast<int>(rows.size());
  for (; begin < count; s = tree_.parent[index_of(s)]) {
    const int past = tree_.first_column[index_of(s + 1)];
    int end = begin;
    while (end < count && rows[index_of(end)] < past) ++end;
    if (end == begin) continue;
    out.push_back({begin, end, runs_in(s, begin, rows), &front(s, pool)});
    begin = end;
  }
  return out;
}

void TopFronts::add_rest(int child, const double* rest, TaskPool* pool) {
  const int count = tree_.rows_below(child);
  const std::vector<int> rows(tree_.rows_of(child), tree_.rows_of(child) + count);
  const std::vector<Target> to = targets(tree_.parent[index_of(child)], 0, rows, pool);
  const Trapezoid source{count, count};
  run_tasks(pool, source.blocks(), [&](int p) {
    auto target = to.begin();
    for (int j = p * kMostRows; j < p * kMostRows + source.width(p); ++j) {
      while (target->end <= j) ++target;
      target->runs.add(source.column(rest, j) + j, j, count,
                       target->front->column(target->runs.place(j)));
    }
  });
}

void TopFronts::subtract(int s, int begin, int end, TaskPool* pool) {
  const Front& source = front(s, pool);
  const Trapezoid& own = source.own();
  std::vector<int> rows(index_of(own.columns));
  for (int j = 0; j < own.columns; ++j) rows[index_of(j)] = tree_.first_column[index_of(s)] + j;
  rows.insert(rows.end(), tree_.rows_of(s), tree_.rows_of(s) + tree_.rows_below(s));
  const int first = std::min(end * kMostRows, own.columns);
  const std::vector<Target> to = targets(s, first, rows, pool);
  const std::vector<int> bounds = tile_bounds(own, first);
  std::vector<Tile> tiles;
  for (std::size_t a = 0; a + 1 < bounds.size(); ++a) {
    for (std::size_t b = a; b + 1 < bounds.size(); ++b) {
      tiles.push_back(
          {begin, end, bounds[a], bounds[a + 1] - bounds[a], bounds[b], bounds[b + 1] - bounds[b]});
    }
  }
  run_tasks(pool, static_cast<int>(tiles.size()),
            [&](int k) { subtract_tile(source, tiles[index_of(k)], to); });
}

void TopFronts::subtract_tile(const Front& source, const Tile& tile,
                              const std::vector<Target>& targets) {
  const SingleThread alone;
  const int end = tile.column + tile.columns;
  const int past = tile.row + tile.rows;
  auto to = std::ranges::upper_bound(targets, tile.column, {}, &Target::end);
  if (end <= to->end && to->runs.is_one_run(tile.column, end) &&
      to->runs.is_one_run(tile.row, past)) {
    const Trapezoid& own = to->front->own();
    const int column = to->runs.place(tile.column);
    const int p = column / kMostRows;
    if ((column + tile.columns - 1) / kMostRows == p) {  // the tile is one of the target, too
      tile.subtract(source, 1.0, to->front->column(column) + to->runs.place(tile.row),
                    own.stride(p));
      return;
    }
  }
  CountedMemory room = rooms_.take(std::ptrdiff_t{kMostRows} * kMostRows);
  tile.subtract(source, 0.0, room.data(), tile.rows);
  for (int j = tile.column; j < end; ++j) {
    while (to->end <= j) ++to;
    const int row = std::max(tile.row, j);
    const double* values =
        room.data() + std::ptrdiff_t{j - tile.column} * tile.rows + (row - tile.row);
    to->runs.add(values, row, past, to->front->column(to->runs.place(j)));
  }
  rooms_.give_back(std::move(room));
}

void TopFronts::free(int s, int begin, int end) {
  const auto found = open_.find(s);
  const Trapezoid& own = found->second.front.own();
  if (end == own.blocks()) {
    open_.erase(found);
  } else {
    found->second.memory.give_up(own.offset(begin), own.offset(end));
  }
}

}  // namespace buckens::linalg

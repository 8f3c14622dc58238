// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/multifrontal.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/panel_kernels.h"
#include "buckens/linalg/rooms.h"
#include "buckens/linalg/tree_tasks.h"

namespace buckens::linalg {

namespace {

// Subtrees per thread: enough to even out their work, few enough to leave large ones.
constexpr double kSubtreesPerThread = 6.0;
// Fronts of up to so many products have few tiles: threads are busier with one such front each than
// with sharing one.
constexpr double kFewTiles = 1e9;
// But no such front may take longer than this share of what each thread does: the others would wait
// for it.
constexpr double kLongest = 1.0 / 25.0;
// Products from which sharing a front among threads costs less than it gains.
constexpr double kSharedFront = 2e7;

class Multifrontal {
 public:
  Multifrontal(const MatrixSum& A, const SupernodeTree& tree, const TakeColumns& take,
               TaskPool* pool)
      : A_(A),
        tree_(tree),
        take_(take),
        pool_(pool),
        place_(at(tree.size)),
        failed_(tree.size),
        rest_(at(tree.count)) {
    for (int c = 0; c < tree.size; ++c) place_[at(tree.permutation[at(c)])] = c;
  }

  void run() {
    divide();
    run_tree(pool_, above_, [this](int k) {
      const Part& part = parts_[at(k)];
      part.is_single ? factorise_single(part.root) : factorise_subtree(part.begin, part.root);
    });
    rooms_.clear();
    std::vector<int> local(at(tree_.size));
    for (const int s : shared_) {
      if (is_lost(s)) break;  // so are those after it
      StreamingMemory own(at64(front(s).own_size()));
      factorise_top(s, own.data(), local, work(s) >= kSharedFront ? pool_ : nullptr);
    }
    if (failed_ < tree_.size) {
      throw IndefiniteMatrix(tree_.size, tree_.permutation[at(failed_)]);
    }
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  /// What one thread does: a whole subtree, or a single front above some.
  struct Part {
    int begin, root;
    double work;
    bool is_single;
  };

  Front front(int s) const { return {tree_.columns(s), tree_.rows_below(s)}; }

  double work(int s) const {
    const double columns = tree_.columns(s);
    const double rows = tree_.columns(s) + tree_.rows_below(s);
    return columns * rows * rows;
  }

  /// Parts for single threads, and the supernodes above them, which all threads share.
  void divide() {
    std::vector<double> below(at(tree_.count));
    std::vector<int> begin(at(tree_.count));
    double total = 0.0;
    for (int s = 0; s < tree_.count; ++s) begin[at(s)] = s;
    for (int s = 0; s < tree_.count; ++s) {
      below[at(s)] += work(s);
      total += work(s);
      const int p = tree_.parent[at(s)];
      if (p < 0) continue;
      below[at(p)] += below[at(s)];
      begin[at(p)] = std::min(begin[at(p)], begin[at(s)]);
    }
    const int threads = pool_ == nullptr ? 1 : pool_->threads();
    const double most = total / (kSubtreesPerThread * threads);
    const double heaviest = std::min(kFewTiles, kLongest * total / threads);
    std::vector<Part> singles;
    std::vector<bool> is_shared(at(tree_.count));
    for (int s = 0; s < tree_.count; ++s) {
      const int p = tree_.parent[at(s)];
      if (below[at(s)] <= most) {
        if (p < 0 || below[at(p)] > most) parts_.push_back({begin[at(s)], s, below[at(s)], false});
      } else if (is_shared[at(s)] || work(s) > heaviest) {
        shared_.push_back(s);
        if (p >= 0) is_shared[at(p)] = true;
      } else {
        singles.push_back({s, s, work(s), true});
      }
      if (below[at(s)] > most) top_children_[s];
      if (p >= 0 && below[at(p)] > most) top_children_[p].push_back(s);
    }
    std::ranges::stable_sort(parts_, std::ranges::less{}, &Part::work);
    parts_.insert(parts_.end(), singles.begin(), singles.end());
    connect_parts();
  }

  /// Parts with higher numbers come first where they may: fronts above others, which free memory,
  /// then heavy subtrees, so that light ones even out the work in the end.
  void connect_parts() {
    std::vector<int> part(at(tree_.count), -1);
    for (std::size_t k = 0; k < parts_.size(); ++k) part[at(parts_[k].root)] = static_cast<int>(k);
    for (const Part& p : parts_) {
      const int parent = tree_.parent[at(p.root)];
      above_.push_back(parent < 0 ? -1 : part[at(parent)]);
    }
  }

  /// Numbers that the fronts of a subtree take at most at the same time.
  std::ptrdiff_t room_needed(int begin, int root) const {
    std::vector<std::ptrdiff_t> waiting;
    std::ptrdiff_t used = 0, most = 0;
    std::vector<int> children = count_children(begin, root);
    for (int s = begin; s <= root; ++s) {
      const Front f = front(s);
      most = std::max(most, used + f.rest_size() + f.own_size());
      for (int k = children[at(s - begin)]; k > 0; --k) {
        used -= waiting.back();
        waiting.pop_back();
      }
      waiting.push_back(f.rest_size());
      used += f.rest_size();
    }
    return most;
  }

  std::vector<int> count_children(int begin, int root) const {
    std::vector<int> children(at(root - begin + 1));
    for (int s = begin; s < root; ++s) ++children[at(tree_.parent[at(s)] - begin)];
    return children;
  }

  /// The rests of fronts lie one after the other; a parent comes behind those of its children and
  /// then takes their place.
  void factorise_subtree(int begin, int root) {
    StreamingMemory room = rooms_.take(at64(room_needed(begin, root)));
    std::vector<int> local(at(tree_.size));
    const std::vector<int> children = count_children(begin, root);
    std::vector<std::pair<int, double*>> waiting;
    double* free = room.data();
    for (int s = begin; s <= root; ++s) {
      Front f = front(s);
      f.begin(free + f.rest_size(), free, nullptr);
      number_rows(s, local);
      add_matrix(s, f, local);
      double* to = free;
      const std::size_t first = waiting.size() - at(children[at(s - begin)]);
      for (std::size_t k = first; k < waiting.size(); ++k) {
        add_rest(waiting[k].first, waiting[k].second, f, local, nullptr);
      }
      if (first < waiting.size()) to = waiting[first].second;
      if (!eliminate(s, f, nullptr)) return;
      if (to != free) std::copy(free, free + f.rest_size(), to);
      waiting.resize(first);
      waiting.emplace_back(s, to);
      free = to + f.rest_size();
    }
    keep_rest(root, room.data());
    rooms_.give_back(std::move(room));
  }

  void keep_rest(int s, const double* values) {
    const std::ptrdiff_t size = front(s).rest_size();
    rest_[at(s)] = StreamingMemory(at64(size));
    std::copy(values, values + size, rest_[at(s)].data());
  }

  void factorise_single(int s) {
    if (is_lost(s)) return;
    StreamingMemory own = rooms_.take(at64(front(s).own_size()));
    std::vector<int> local(at(tree_.size));
    factorise_top(s, own.data(), local, nullptr);
    rooms_.give_back(std::move(own));
  }

  /// @param own memory for the columns of s
  void factorise_top(int s, double* own, std::vector<int>& local, TaskPool* pool) {
    Front f = front(s);
    StreamingMemory rest(at64(f.rest_size()));
    f.begin(own, rest.data(), pool);
    number_rows(s, local);
    add_matrix(s, f, local);
    for (const int child : top_children_.at(s)) {
      add_rest(child, rest_[at(child)].data(), f, local, pool);
      rest_[at(child)] = StreamingMemory();
    }
    if (eliminate(s, f, pool)) rest_[at(s)] = std::move(rest);
  }

  /// Whether a pivot in a column before s was not positive. Supernodes before such a column do not
  /// depend on it.
  bool is_lost(int s) {
    const std::scoped_lock lock(failure_);
    return tree_.first_column[at(s)] > failed_;
  }

  /// local[column of L] = row of the front of s.
  void number_rows(int s, std::vector<int>& local) const {
    int row = 0;
    for (int c = tree_.first_column[at(s)]; c < tree_.first_column[at(s + 1)]; ++c) {
      local[at(c)] = row++;
    }
    const int* rows = tree_.rows_of(s);
    for (int k = 0; k < tree_.rows_below(s); ++k) local[at(rows[k])] = row++;
  }

  void add_matrix(int s, const Front& f, const std::vector<int>& local) const {
    const int first = tree_.first_column[at(s)];
    std::vector<MatrixSum::Entry> entries;
    for (int j = 0; j < tree_.columns(s); ++j) {
      double* to = f.column(j);
      A_.read_column(tree_.permutation[at(first + j)], entries);
      for (const auto& [of, value] : entries) {
        const int row = place_[at(of)];
        if (row >= first + j) to[local[at(row)]] += value;
      }
    }
  }

  void add_rest(int child, const double* rest, Front& f, const std::vector<int>& local,
                TaskPool* pool) const {
    std::vector<int> places(at(tree_.rows_below(child)));
    const int* rows = tree_.rows_of(child);
    for (std::size_t k = 0; k < places.size(); ++k) places[k] = local[at(rows[k])];
    f.add(rest, places, pool);
  }

  /// @return false if a pivot is not positive; the first of all such columns is kept
  bool eliminate(int s, Front& f, TaskPool* pool) {
    const int failed = f.eliminate(pool);
    if (failed >= 0) {
      const std::scoped_lock lock(failure_);
      failed_ = std::min(failed_, tree_.first_column[at(s)] + failed);
      return false;
    }
    static_assert(Trapezoid::kBlock % kPanelColumns == 0);
    const int columns = tree_.columns(s);
    run_tasks(pool, (columns + kPanelColumns - 1) / kPanelColumns, [&](int k) {
      const int begin = k * kPanelColumns;
      const int p = begin / Trapezoid::kBlock;
      take_(s, begin, std::min(begin + kPanelColumns, columns),
            f.own().column(f.own_values(), begin) + begin, f.own().stride(p));
    });
    return true;
  }

  static std::size_t at64(std::ptrdiff_t k) { return static_cast<std::size_t>(k); }

  const MatrixSum& A_;
  const SupernodeTree& tree_;
  const TakeColumns& take_;
  TaskPool* pool_;
  std::vector<int> place_;  // column of L of each row of A
  std::mutex failure_;
  int failed_;  // first column of L without a positive pivot, their number if there is none
  std::vector<Part> parts_;
  std::vector<int> above_;                        // part above each, −1 if there is none
  std::vector<int> shared_;                       // supernodes above all parts
  std::map<int, std::vector<int>> top_children_;  // of supernodes that are in no whole subtree
  Rooms rooms_;
  std::vector<StreamingMemory> rest_;  // of fronts whose parents are in no whole subtree
};

}  // namespace

void factorise_fronts(const MatrixSum& A, const SupernodeTree& tree, const TakeColumns& take,
                      TaskPool* pool) {
  Multifrontal(A, tree, take, pool).run();
}

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/multifrontal.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/counted_memory.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/front_entries.h"
#include "buckens/linalg/front_plan.h"
#include "buckens/linalg/panel_kernels.h"
#include "buckens/linalg/rooms.h"
#include "buckens/linalg/top_fronts.h"
#include "buckens/linalg/tree_tasks.h"

namespace buckens::linalg {

namespace {

// Products from which sharing a front among threads costs less than it gains.
constexpr double kSharedFront = 2e7;

class Multifrontal {
 public:
  Multifrontal(const MatrixSum& A, const SupernodeTree& tree, const TakeColumns& take,
               TaskPool* pool)
      : tree_(tree),
        take_(take),
        pool_(pool),
        entries_(A, tree),
        plan_(tree, threads()),
        failed_(tree.size),
        rooms_(count_),
        rest_(at(tree.count)),
        local_(at(tree.size)),
        top_(
            tree, [this](int s, const Front& f) { entries_.add(s, f, local_); }, count_) {}

  double run() {
    const auto part = [this](int k) { factorise_part(k); };
    const auto shared = [this](int s) { share(s); };
    if (threads() == 1) {
      plan_.in_postorder(part, shared);
    } else {
      run_tree(pool_, plan_.above(), part);
      std::ranges::for_each(plan_.shared(), shared);
    }
    if (failed_ < tree_.size) {
      throw IndefiniteMatrix(tree_.size, tree_.permutation[at(failed_)]);
    }
    return static_cast<double>(count_.most());
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  int threads() const { return pool_ == nullptr ? 1 : pool_->threads(); }

  Front front(int s) const { return {tree_.columns(s), tree_.rows_below(s)}; }
  /// Threads that share the front of s.
  TaskPool* pool_for(int s) const { return front_work(tree_, s) >= kSharedFront ? pool_ : nullptr; }

  void factorise_part(int k) {
    const FrontPlan::Part& part = plan_.parts()[at(k)];
    if (is_lost(part.begin)) return;
    part.is_single ? factorise_single(part.root) : factorise_subtree(part.begin, part.root);
  }

  void share(int s) {
    if (is_lost(s)) return;
    rooms_.clear();
    plan_.is_top(s) ? factorise_top(s) : factorise_shared(s);
  }

  /// The rests of fronts lie one after the other; a parent comes behind those of its children and
  /// then takes their place.
  void factorise_subtree(int begin, int root) {
    CountedMemory room = rooms_.take(subtree_room(tree_, begin, root));
    std::vector<int> local(at(tree_.size));
    const std::vector<int> children = count_children(tree_, begin, root);
    std::vector<std::pair<int, double*>> waiting;
    double* free = room.data();
    for (int s = begin; s <= root; ++s) {
      Front f = front(s);
      f.begin(free + f.rest_size(), free, nullptr);
      entries_.add(s, f, local);
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
    rest_[at(s)] = CountedMemory(size, count_);
    std::copy(values, values + size, rest_[at(s)].data());
  }

  void factorise_single(int s) {
    CountedMemory own = rooms_.take(front(s).own_size());
    std::vector<int> local(at(tree_.size));
    factorise_alone(s, own.data(), local, nullptr);
    rooms_.give_back(std::move(own));
  }

  void factorise_shared(int s) {
    CountedMemory own(front(s).own_size(), count_);
    factorise_alone(s, own.data(), local_, pool_for(s));
  }

  /// A front that is in no whole subtree, but no top front. @param own memory for the columns of s
  void factorise_alone(int s, double* own, std::vector<int>& local, TaskPool* pool) {
    Front f = front(s);
    CountedMemory rest(f.rest_size(), count_);
    f.begin(own, rest.data(), pool);
    entries_.add(s, f, local);
    for (const int child : plan_.waiting(s)) {
      add_rest(child, rest_[at(child)].data(), f, local, pool);
      rest_[at(child)] = CountedMemory();
    }
    if (eliminate(s, f, pool)) rest_[at(s)] = std::move(rest);
  }

  void add_rest(int child, const double* rest, Front& f, const std::vector<int>& local,
                TaskPool* pool) const {
    std::vector<int> places(at(tree_.rows_below(child)));
    const int* rows = tree_.rows_of(child);
    for (std::size_t k = 0; k < places.size(); ++k) places[k] = local[at(rows[k])];
    f.add(rest, places, pool);
  }

  /// Some blocks at a time, which are handed over and freed before the next begin.
  void factorise_top(int s) {
    TaskPool* pool = pool_for(s);
    Front& f = top_.front(s, pool);
    for (const int child : plan_.waiting(s)) {
      top_.add_rest(child, rest_[at(child)].data(), pool);
      rest_[at(child)] = CountedMemory();
    }
    const int blocks = f.own().blocks();  // the front is gone with the last of them
    for (int begin = 0, end = 0; begin < blocks; begin = end) {
      end = std::min(begin + TopFronts::kBlocks, blocks);
      if (is_failed(s, f.eliminate_blocks(begin, end, pool))) return;
      top_.subtract(s, begin, end, pool);
      hand_over(s, f, begin, end, pool);
      top_.free(s, begin, end);
    }
  }

  /// @return false if a pivot is not positive
  bool eliminate(int s, Front& f, TaskPool* pool) {
    if (is_failed(s, f.eliminate(pool))) return false;
    hand_over(s, f, 0, f.own().blocks(), pool);
    return true;
  }

  /// Whether a pivot in a column before s was not positive. Supernodes before such a column do not
  /// depend on it.
  bool is_lost(int s) {
    const std::scoped_lock lock(failure_);
    return tree_.first_column[at(s)] > failed_;
  }

  /// Keeps the first of all columns without a positive pivot. @param column of s, −1 if there is
  /// none
  bool is_failed(int s, int column) {
    if (column < 0) return false;
    const std::scoped_lock lock(failure_);
    failed_ = std::min(failed_, tree_.first_column[at(s)] + column);
    return true;
  }

  /// Of finished blocks.
  void hand_over(int s, const Front& f, int first_block, int end_block, TaskPool* pool) {
    static_assert(Trapezoid::kBlock % kPanelColumns == 0);
    const int first = first_block * Trapezoid::kBlock;
    const int past = std::min(end_block * Trapezoid::kBlock, tree_.columns(s));
    const double rows = f.own().rows - 0.5 * (first + past);
    count_.add(static_cast<std::ptrdiff_t>(sizeof(double) * rows * (past - first)));
    run_tasks(pool, (past - first + kPanelColumns - 1) / kPanelColumns, [&](int k) {
      const int begin = first + k * kPanelColumns;
      const int p = begin / Trapezoid::kBlock;
      take_(s, begin, std::min(begin + kPanelColumns, past),
            f.own().column(f.own_values(), begin) + begin, f.own().stride(p));
    });
  }

  const SupernodeTree& tree_;
  const TakeColumns& take_;
  TaskPool* pool_;
  FrontEntries entries_;
  FrontPlan plan_;
  std::mutex failure_;
  int failed_;  // first column of L without a positive pivot, their number if there is none
  MemoryCount count_;
  Rooms rooms_;
  std::vector<CountedMemory> rest_;  // of fronts that are the roots of parts, or shared
  std::vector<int> local_;           // for the fronts that threads share
  TopFronts top_;
};

}  // namespace

double factorise_fronts(const MatrixSum& A, const SupernodeTree& tree, const TakeColumns& take,
                        TaskPool* pool) {
  return Multifrontal(A, tree, take, pool).run();
}

}  // namespace buckens::linalg

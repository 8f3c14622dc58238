// SPDX-License-Identifier: Apache-2.0
// How threads go through a PanelFactor. All of them begin one solve together and meet where one
// needs what another has done; between meetings nobody writes what another one reads.
#include <algorithm>
#include <array>
#include <cstddef>

#include "buckens/linalg/meeting.h"
#include "buckens/linalg/panel_factor.h"

namespace buckens::linalg {

namespace {

// Bytes below the triangle of a panel from which its rows are shared: two meetings cost as much as
// some 20 kB of reading.
constexpr std::ptrdiff_t kSharedRows = std::ptrdiff_t{1} << 18;

// Places that are gathered or scattered together: 16 kB of them with 32 right-hand sides, half of
// the nearest cache.
constexpr int kPlacesAtOnce = 64;

// Right-hand sides that are gathered or scattered together: half of a cache line of what a solve
// works on.
constexpr int kSidesAtOnce = 4;

/// Values of `Count` right-hand sides at some places. @param rows at the places, −1 for none
template <int Count>
void gather_sides(const int* rows, int places, const double* const* from, double* to, int stride) {
  for (int k = 0; k < places; ++k, to += stride) {
    const int row = rows[k];
    for (int r = 0; r < Count; ++r) to[r] = row < 0 ? 0.0 : from[r][row];
  }
}

template <int Count>
void scatter_sides(const int* rows, int places, const double* from, int stride, double* const* to) {
  for (int k = 0; k < places; ++k, from += stride) {
    const int row = rows[k];
    if (row < 0) continue;
    for (int r = 0; r < Count; ++r) to[r][row] = from[r];
  }
}

bool is_shared(const Panel& panel) {
  return static_cast<std::ptrdiff_t>(sizeof(double)) * kPanelRows * panel.row_blocks *
             panel.columns >=
         kSharedRows;
}

}  // namespace

struct PanelFactor::Workspace::Meetings {
  explicit Meetings(std::size_t groups) : of_group(groups) {}
  std::vector<Meeting> of_group;
};

PanelFactor::Workspace::Workspace() = default;
PanelFactor::Workspace::~Workspace() = default;
PanelFactor::Workspace::Workspace(Workspace&&) noexcept = default;
PanelFactor::Workspace& PanelFactor::Workspace::operator=(Workspace&&) noexcept = default;

/// One pass of up to kMostSides right-hand sides.
struct PanelFactor::Solve {
  const double* const* B;
  double* const* X;
  int columns;
  int sides;
  double* x;  // `sides` numbers per place
  Meeting* meetings;

  double* at(int place) const { return x + static_cast<std::ptrdiff_t>(place) * sides; }
};

/// Threads first … first + count − 1, which solve a group; this is thread `me` of them.
struct PanelFactor::Team {
  int first, count, me;

  bool leads() const { return me == first; }
  /// Its part of the numbers 0 … n − 1.
  int begin(int n) const {
    return static_cast<int>(static_cast<std::ptrdiff_t>(n) * (me - first) / count);
  }
  int end(int n) const {
    return static_cast<int>(static_cast<std::ptrdiff_t>(n) * (me - first + 1) / count);
  }
  /// Those that go on with the first, or the second, of the groups below.
  Team half(int k) const {
    const int some = (count + 1) / 2;
    return k == 0 ? Team{first, some, me} : Team{first + some, count - some, me};
  }
  bool includes_me() const { return me >= first && me < first + count; }
  void meet(Meeting& meeting) const {
    if (count > 1) meeting.wait_for(count);
  }
};

void PanelFactor::solve(const double* B, double* X, Eigen::Index columns, Eigen::Index stride,
                        Workspace& work, TaskPool* pool) const {
  std::array<const double*, kMostSides> from{};
  std::array<double*, kMostSides> to{};
  for (Eigen::Index done = 0; done < columns; done += kMostSides) {
    const Eigen::Index some = std::min<Eigen::Index>(kMostSides, columns - done);
    for (Eigen::Index k = 0; k < some; ++k) {
      from[static_cast<std::size_t>(k)] = B + (done + k) * stride;
      to[static_cast<std::size_t>(k)] = X + (done + k) * stride;
    }
    solve_some(from.data(), to.data(), static_cast<int>(some), work, pool);
  }
}

void PanelFactor::solve_in_place(std::span<double* const> vectors, Workspace& work,
                                 TaskPool* pool) const {
  for (std::size_t done = 0; done < vectors.size(); done += kMostSides) {
    const std::size_t some = std::min<std::size_t>(kMostSides, vectors.size() - done);
    double* const* X = vectors.data() + done;
    solve_some(X, X, static_cast<int>(some), work, pool);
  }
}

void PanelFactor::solve_some(const double* const* B, double* const* X, int columns, Workspace& work,
                             TaskPool* pool) const {
  const int unit = side_multiple();
  const int sides = columns == 1 ? 1 : (columns + unit - 1) / unit * unit;
  const auto needed = static_cast<std::size_t>(num_places_) * static_cast<std::size_t>(sides);
  if (work.values_.size() < needed) work.values_ = StreamingMemory(needed);
  if (!work.meetings_ || work.meetings_->of_group.size() < groups_.size()) {
    work.meetings_ = std::make_unique<Workspace::Meetings>(groups_.size());
  }
  const Solve solve{B, X, columns, sides, work.values_.data(), work.meetings_->of_group.data()};
  const int threads = pool == nullptr ? 1 : std::min(pool->available(), num_parts());
  // Threads that wait for each other must all be there: never more than the pool has.
  run_tasks(threads == 1 ? nullptr : pool, threads, [&](int me) {
    const Team all{0, threads, me};
    forward(solve, last_group(), all);
    backward(solve, last_group(), all);
  });
}

void PanelFactor::forward(const Solve& solve, int g, const Team& team) const {
  const Group& own = group(g);
  if (own.is_leaf()) {
    if (!team.leads()) return;
    gather(solve, g);
    const Panel* panels = panels_.data();
    kernels_->forward(panels + own.panels_begin, panels + own.panels_end, solve.x, solve.sides);
    return;
  }
  for (const int k : {0, 1}) {
    const Team some = team.count == 1 ? team : team.half(k);
    if (some.includes_me()) forward(solve, own.below[k], some);
  }
  team.meet(solve.meetings[g]);
  // The first of those below has worked in place.
  const Group& second = group(own.below[1]);
  const int count = own.size() * solve.sides;
  double* to = solve.at(own.first);
  const double* from = solve.at(second.first + second.columns);
  for (int k = team.begin(count); k < team.end(count); ++k) to[k] += from[k];
  team.meet(solve.meetings[g]);
  forward_panels(solve, g, team);
}

void PanelFactor::backward(const Solve& solve, int g, const Team& team) const {
  const Group& own = group(g);
  if (own.is_leaf() && !team.leads()) return;
  const Team some = own.is_leaf() ? Team{team.me, 1, team.me} : team;
  if (own.parent != kNone && group(own.parent).below[1] == g) {
    const double* from = solve.at(group(own.parent).first);
    const int count = own.above * solve.sides;
    double* to = solve.at(own.first + own.columns);
    std::copy(from + some.begin(count), from + some.end(count), to + some.begin(count));
  }
  if (own.is_leaf()) {
    const Panel* panels = panels_.data();
    kernels_->backward(panels + own.panels_begin, panels + own.panels_end, solve.x, solve.sides);
    scatter(solve, g);
    return;
  }
  team.meet(solve.meetings[g]);
  backward_panels(solve, g, team);
  team.meet(solve.meetings[g]);
  for (const int k : {0, 1}) {
    const Team half = team.count == 1 ? team : team.half(k);
    if (half.includes_me()) backward(solve, own.below[k], half);
  }
}

void PanelFactor::forward_panels(const Solve& solve, int g, const Team& team) const {
  const Panel* end = panels_.data() + group(g).panels_end;
  for (const Panel* panel = panels_.data() + group(g).panels_begin; panel != end; ++panel) {
    if (team.count == 1 || !is_shared(*panel)) {
      if (team.leads()) kernels_->forward(panel, panel + 1, solve.x, solve.sides);
      continue;
    }
    if (team.leads()) kernels_->forward_triangle(*panel, solve.x, solve.sides);
    team.meet(solve.meetings[g]);
    const int blocks = panel->row_blocks;
    kernels_->forward_rows(*panel, team.begin(blocks), team.end(blocks), solve.x, solve.sides);
    team.meet(solve.meetings[g]);
  }
}

void PanelFactor::backward_panels(const Solve& solve, int g, const Team& team) const {
  const Panel* begin = panels_.data() + group(g).panels_begin;
  for (const Panel* panel = panels_.data() + group(g).panels_end; panel != begin;) {
    --panel;
    if (team.count == 1 || !is_shared(*panel)) {
      if (team.leads()) kernels_->backward(panel, panel + 1, solve.x, solve.sides);
      continue;
    }
    team.meet(solve.meetings[g]);
    const int columns = panel->columns;
    kernels_->backward_rows(*panel, team.begin(columns), team.end(columns), solve.x, solve.sides);
    team.meet(solve.meetings[g]);
    if (team.leads()) kernels_->backward_triangle(*panel, solve.x, solve.sides);
  }
}

// Some right-hand sides and places at a time: the lines that are read stay in the cache, and those
// of all right-hand sides are written together.
void PanelFactor::gather(const Solve& solve, int g) const {
  const Group& own = group(g);
  const int end = own.first + own.size() + 1;
  for (int p = own.first; p < end; p += kPlacesAtOnce) {
    const int some = std::min(kPlacesAtOnce, end - p);
    const int* rows = origin_.data() + p;
    double* to = solve.at(p);
    int r = 0;
    for (; r + kSidesAtOnce <= solve.columns; r += kSidesAtOnce) {
      gather_sides<kSidesAtOnce>(rows, some, solve.B + r, to + r, solve.sides);
    }
    for (; r < solve.columns; ++r) {
      gather_sides<1>(rows, some, solve.B + r, to + r, solve.sides);
    }
    for (; r < solve.sides; ++r) {
      for (int k = 0; k < some; ++k) to[static_cast<std::ptrdiff_t>(k) * solve.sides + r] = 0.0;
    }
  }
}

void PanelFactor::scatter(const Solve& solve, int g) const {
  const Group& own = group(g);
  const int end = own.first + own.size();
  for (int p = own.first; p < end; p += kPlacesAtOnce) {
    const int some = std::min(kPlacesAtOnce, end - p);
    const int* rows = origin_.data() + p;
    const double* from = solve.at(p);
    int r = 0;
    for (; r + kSidesAtOnce <= solve.columns; r += kSidesAtOnce) {
      scatter_sides<kSidesAtOnce>(rows, some, from + r, solve.sides, solve.X + r);
    }
    for (; r < solve.columns; ++r) {
      scatter_sides<1>(rows, some, from + r, solve.sides, solve.X + r);
    }
  }
}

}  // namespace buckens::linalg

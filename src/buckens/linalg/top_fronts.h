// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/counted_memory.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/rooms.h"
#include "buckens/linalg/row_runs.h"
#include "buckens/linalg/supernode_tree.h"

namespace buckens::linalg {

/// The large fronts near the roots of the tree, which have no rests: what is subtracted from rows
/// below goes to the columns of the fronts above at once ("fan-out", Rothberg and Gupta 1994). The
/// rests of such fronts would take a sixth of the memory of the factor besides; their columns take
/// what they take in it anyway.
///
/// All fronts above a top front are top fronts. Threads share the work on one, tile by tile; the
/// tiles depend on the tree alone.
class TopFronts {
 public:
  /// Blocks of a front that are subtracted from others, and then freed, together: their products
  /// are added up once for all, but both they and the finished columns take memory.
  static constexpr int kBlocks = 2;

  /// @param begin adds the entries of the matrix to the front of a supernode
  TopFronts(const SupernodeTree& tree, std::function<void(int s, const Front&)> begin,
            MemoryCount& count);

  /// The front of s, which begins with the entries of the matrix when it is first needed.
  Front& front(int s, TaskPool* pool);
  /// Adds the rest of a front that is no top front to the fronts above it.
  void add_rest(int child, const double* rest, TaskPool* pool);
  /// Subtracts the products of the blocks begin … end of s, which contain L, from the other columns
  /// of s and those of the fronts above.
  void subtract(int s, int begin, int end, TaskPool* pool);
  /// Frees these blocks, and the front with the last of them.
  void free(int s, int begin, int end);

 private:
  struct Open {
    Front front;
    CountedMemory memory;
  };
  /// A front of which some columns are rows of another front.
  struct Target {
    int begin, end;  ///< these rows
    RowRuns runs;    ///< rows of the target for those rows and all below
    Front* front;
  };
  struct Tile;

  std::vector<Target> targets(int s, int begin, const std::vector<int>& rows, TaskPool* pool);
  RowRuns runs_in(int s, int begin, const std::vector<int>& rows) const;
  void subtract_tile(const Front& source, const Tile& tile, const std::vector<Target>& targets);

  const SupernodeTree& tree_;
  std::function<void(int s, const Front&)> begin_;
  MemoryCount& count_;
  Rooms rooms_;  // for products
  std::map<int, Open> open_;
};

}  // namespace buckens::linalg

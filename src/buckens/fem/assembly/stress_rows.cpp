// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/stress_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "buckens/base/allowed_threads.h"
#include "buckens/fem/assembly/element_pieces.h"
#include "buckens/fem/assembly/made_columns.h"
#include "buckens/fem/assembly/mesh_part.h"
#include "buckens/linalg/counted_entries.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"

namespace buckens::fem {

using linalg::SparseMatrix;

namespace {

using Blocks = std::vector<std::shared_ptr<const ElementBlock>>;

constexpr int kRowsOfSolid = 6, kRowsOfShell = 12;
// Those of fewer are listed within some 10 ms.
constexpr int kManyRows = 12000;

/// Calls visit(block, its first row, rows of each of its elements): solids, then shells. Others
/// have no stresses of this kind.
/// @return the number of rows
template <class Visitor>
int visit_stressed(const Blocks& blocks, Visitor&& visit) {
  int first_row = 0;
  for (const bool of_shells : {false, true}) {
    const int rows = of_shells ? kRowsOfShell : kRowsOfSolid;
    for (const auto& block : blocks) {
      if (of_shells ? !block->is_shell() : !block->is_solid()) continue;
      visit(*block, first_row, rows);
      first_row += rows * block->num_elements();
    }
  }
  return first_row;
}

int num_rows(const Blocks& blocks) {
  return visit_stressed(blocks, [](const ElementBlock&, int, int) {});
}

/// The entries of the rows of a piece, row by row, columns ascending.
/// @param rows of the piece
std::vector<linalg::Triplet> entries_of(const ElementBlock& piece, int rows, const MeshView& mesh) {
  std::vector<linalg::Triplet> listed;
  piece.add_stress_rows(mesh, 0, listed);
  std::vector<std::size_t> next(static_cast<std::size_t>(rows) + 1, 0);
  for (const linalg::Triplet& entry : listed) ++next[static_cast<std::size_t>(entry.row()) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<linalg::Triplet> out(listed.size());
  for (const linalg::Triplet& entry : listed) {
    // Columns of a row are few, and most of them ascend already.
    std::size_t place = next[static_cast<std::size_t>(entry.row())]++;
    for (; place > 0 && out[place - 1].row() == entry.row() && out[place - 1].col() > entry.col();
         --place) {
      out[place] = out[place - 1];
    }
    out[place] = entry;
  }
  return out;
}

/// Calls visit(row, column, value) for the entries, row by row, columns ascending. Of several
/// threads, each visits the rows of other pieces.
/// @param begin,end rows that are wanted; of others there may be some
template <class Visitor>
void visit_entries(const Blocks& blocks, const MeshView& mesh, int begin, int end, TaskPool* pool,
                   Visitor&& visit) {
  visit_stressed(blocks, [&](const ElementBlock& block, int first_row, int rows) {
    const ElementPieces pieces(block, mesh.nodes);
    run_tasks(pool, pieces.count(), [&](int k) {
      const int first_of_piece = first_row + rows * pieces.begin(k);
      const int end_of_piece = first_row + rows * pieces.begin(k + 1);
      if (first_of_piece >= end || end_of_piece <= begin) return;
      pieces.visit(k, [&](const ElementBlock& piece, int) {
        for (const linalg::Triplet& entry :
             entries_of(piece, end_of_piece - first_of_piece, mesh)) {
          visit(first_of_piece + entry.row(), entry.col(), entry.value());
        }
      });
    });
  });
}

linalg::SparseRows::RowMajor rows_of_this_process(const Blocks& blocks, const MeshView& mesh) {
  const int count = num_rows(blocks);
  TaskPool* pool = count >= kManyRows ? base::AllowedThreads::pool() : nullptr;
  linalg::SparseRows::RowMajor out(count, mesh.dofs.num_dofs);
  int* starts = out.outerIndexPtr();
  std::fill_n(starts, out.rows() + 1, 0);
  const auto visit = [&](auto&& entry) { visit_entries(blocks, mesh, 0, count, pool, entry); };
  visit([starts](int row, int, double) { ++starts[row + 1]; });
  std::partial_sum(starts, starts + out.rows() + 1, starts);
  out.resizeNonZeros(starts[out.rows()]);
  std::vector<int> next(starts, starts + out.rows());
  visit([&](int row, int column, double value) {
    const int place = next[static_cast<std::size_t>(row)]++;
    out.innerIndexPtr()[place] = column;
    out.valuePtr()[place] = value;
  });
  return out;
}

}  // namespace

linalg::SparseRows stress_rows(const Blocks& blocks, const MeshView& mesh, const NodeParts& parts) {
  if (!linalg::is_shared_work(mesh.dofs.num_dofs)) {
    return linalg::SparseRows(rows_of_this_process(blocks, mesh));
  }
  const linalg::SharedRowOrder order = stress_row_order(blocks, parts);
  return {num_rows(blocks), mesh.dofs.num_dofs, order, [&](int first, int end) {
            return description_of_stress_rows(blocks, mesh, order, first, end);
          }};
}

linalg::SparseRows::RowMajor stress_rows_of(const Blocks& blocks, const MeshView& mesh,
                                            const std::vector<int>& elements) {
  Blocks some;
  int first = 0;
  visit_stressed(blocks, [&](const ElementBlock& block, int, int) {
    std::vector<int> own;
    for (const int element : elements) {
      if (element >= first && element < first + block.num_elements())
        own.push_back(element - first);
    }
    first += block.num_elements();
    if (!own.empty()) some.push_back(some_elements(block, mesh.nodes, own));
  });
  return rows_of_this_process(some, mesh);
}

linalg::SharedRowOrder stress_row_order(const Blocks& blocks, const NodeParts& parts) {
  if (parts.empty()) return nullptr;
  std::vector<int> of_rows;
  of_rows.reserve(static_cast<std::size_t>(num_rows(blocks)));
  visit_stressed(blocks, [&](const ElementBlock& block, int, int rows) {
    for (int e = 0; e < block.num_elements(); ++e) {
      const auto node = static_cast<std::size_t>(block.nodes(e).front());
      of_rows.insert(of_rows.end(), static_cast<std::size_t>(rows), parts.part[node]);
    }
  });
  return std::make_shared<const linalg::RowOrder>(of_rows, parts.count);
}

std::vector<std::byte> description_of_stress_rows(const Blocks& blocks, const MeshView& mesh,
                                                  const linalg::SharedRowOrder& order, int first,
                                                  int end) {
  base::BytesTo put;
  put(MeshMatrix::stress);
  // The elements to which these rows belong, in their order.
  std::vector<std::vector<int>> elements(blocks.size());
  int first_of_part = -1;
  visit_stressed(blocks, [&](const ElementBlock& block, int first_row, int rows) {
    const auto found = std::find_if(blocks.begin(), blocks.end(),
                                    [&block](const auto& b) { return b.get() == &block; });
    auto& own = elements[static_cast<std::size_t>(found - blocks.begin())];
    for (int e = 0; e < block.num_elements(); ++e) {
      const int listed = first_row + rows * e;
      const int row = order ? order->row(listed) : listed;
      if (row + rows <= first || row >= end) continue;
      if (first_of_part < 0) first_of_part = row;
      own.push_back(e);
    }
  });
  put(first_of_part);
  (void)put_part(blocks, mesh, elements, put);
  return put.take();
}

SparseMatrix made_stress_rows(base::BytesFrom description, int first, int end) {
  const int first_of_part = description.next<int>();
  const MeshPart part = taken_part(description);
  const int begin = first - first_of_part;  // of the part
  const auto visit = [&](auto&& entry) {
    visit_entries(part.blocks, {part.nodes, part.dofs}, begin, begin + end - first, nullptr,
                  [&](int row, int column, double value) {
                    const int wanted = row - begin;
                    if (wanted < 0 || wanted >= end - first) return;
                    entry(part.variables[static_cast<std::size_t>(column)], wanted, value);
                  });
  };
  return linalg::from_counted_entries(part.size, end - first, visit);
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/node_kernels.h"
#include "buckens/linalg/solve_exchange.h"

namespace buckens::linalg {

/// Tables of a body that several bodies read, possibly of other simulations, and how they go
/// through them: together where they meet in an exchange.
struct CommonTable {
  NodeMatrix mass;                    ///< scalar mass matrix of a solid
  const void* table = nullptr;        ///< the same for all that read it
  SolveExchange* exchange = nullptr;  ///< null: alone

  template <class F>
  void for_pieces(const RowParts& rows, TaskPool* pool, F&& f) const {
    if (exchange != nullptr && table != nullptr) {
      exchange->for_pieces(table, rows, pool, PieceFunction(f));
    } else {
      rows.for_pieces(pool, f);
    }
  }
};

}  // namespace buckens::linalg

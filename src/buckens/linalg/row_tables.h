// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Of a solid without constraints, whose inertia acts node by node, what a process needs for its
/// nodes.
struct NodeTables {
  SparseMatrix Ms;  ///< columns of the nodes here; rows are places, see RowTables::beside
  Eigen::Matrix4Xd positions;  ///< and 1
  Eigen::Matrix4Xd first_moments;
};

/// Of any other body what a process needs for its variables; M is a divided matrix.
struct VariableTables {
  /// Of the integral W_ab, at 3a + b, the rows of the variables here, as columns; rows are places.
  std::array<SparseMatrix, 9> W;
  /// Of W_ab = Ms ⊗ E_ab the scalar mass matrix: columns of nodes with variables here; rows are
  /// those of `nodes`.
  SparseMatrix Ms;
  /// Places of the variables of nodes, −1 where there is none: of those with columns, then others.
  std::vector<std::array<int, 3>> nodes;
  /// Rows of the variables here: M-orthonormal rigid motions, their images under M, and patterns,
  /// if there are any.
  Matrix Phi, P, patterns;
};

/// What of a body a process needs for its rows of vectors: a run of units, which are nodes of three
/// variables or single variables, numbered from 0 here.
struct RowTables {
  int width = 3;  ///< variables of a unit
  int first = 0;  ///< unit of the whole body
  int count = 0;  ///< units here
  std::variant<NodeTables, VariableTables> inertia;
  RowMajorMatrix N;             ///< columns of the variables here
  std::vector<int> beside;      ///< units of others, ascending: their places follow those here
  std::vector<int> in_counts;   ///< of these, per process
  std::vector<int> sent;        ///< units here that others have beside theirs, process by process
  std::vector<int> out_counts;  ///< of these, per process
};

/// Of the whole body, what NodeTables are made of.
struct WholeNodes {
  const SparseMatrix* Ms = nullptr;
  const Eigen::Matrix4Xd* positions = nullptr;
  const Eigen::Matrix4Xd* first_moments = nullptr;
  SharedRowOrder order = {};  ///< of the variables, whole nodes; null: as they are
};

/// Of the whole body, what VariableTables are made of.
struct WholeVariables {
  /// W_11, W_22, W_33, W_12, W_13, W_23; matrices without entries may have no size.
  const std::array<SparseMatrix, 6>* W = nullptr;
  const SparseMatrix* Ms = nullptr;  ///< null: none
  const std::vector<std::array<int, 3>>* dofs = nullptr;
  const Matrix *Phi = nullptr, *P = nullptr, *patterns = nullptr;
  SharedRowOrder order = {};  ///< null: as they are
};

/// What belongs to one run of units, numbered in the order of rows.
/// @param first_units of all processes, and the end.
/// @param place of the process
void describe_rows(const WholeNodes& of, const RowMajorMatrix& N, std::span<const int> first_units,
                   std::size_t place, base::BytesTo& put);
void describe_rows(const WholeVariables& of, const RowMajorMatrix& N,
                   std::span<const int> first_units, std::size_t place, base::BytesTo& put);
RowTables described_rows(base::BytesFrom& take);

}  // namespace buckens::linalg

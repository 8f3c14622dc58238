// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::fem {

/// What other processes make: symmetric matrices of a mesh, rows of stresses (stress_rows.h), or
/// the scalar mass matrix, by nodes (solid_inertia.h).
enum class MeshMatrix : int { mass, stiffness, damping, stress, scalar_mass };

/// Variables of a mesh that follow others, d = T x.
using Following = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A matrix A of a mesh, or TᵀAT, whose columns other processes make, each those that it will have.
/// They get the elements that have a variable among their columns, with nodes and properties, and
/// sum in the order of the elements, so that entries have the bits of an assembly in one process.
/// The element matrices of a border are made on both of its sides,
/// and where many variables follow one, those of their elements where the column of that one is.
/// @param order of the rows of the matrix, of which no bit depends on it
/// @param T null: A
/// @pre linalg::is_shared_work()
/// @throws NumericalError if a process cannot, with its reason
linalg::SymmetricMatrix matrix_made_elsewhere(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, const linalg::SharedRowOrder& order, const Following* T = nullptr);

/// What they get for rows `first` to `end` − 1.
/// @param order of the rows; null: they are variables
std::vector<std::byte> description_of_columns(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, int first, int end, const linalg::RowOrder* order = nullptr,
    const Following* T = nullptr);

/// How they do so: linalg::MakeColumns of a program.
linalg::SparseMatrix made_columns(std::span<const std::byte> description, int first, int end);

/// TᵀAT, with the bits of the columns above.
linalg::SparseMatrix condensed(const linalg::SparseMatrix& A, const linalg::SparseMatrix& T);

}  // namespace buckens::fem

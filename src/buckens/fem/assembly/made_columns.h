// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/block.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::fem {

enum class MeshMatrix : int { mass, stiffness, damping };

/// A matrix of a mesh of solids whose columns other processes make, each those that it will have.
/// They get the elements that have a variable among their columns, with nodes and materials, and
/// sum in the order of the elements, so that entries have the bits of an assembly in one process.
/// The element matrices of a border are made on both of its sides.
/// @pre linalg::is_shared_work()
/// @throws NumericalError if a process cannot, with its reason
linalg::SymmetricMatrix matrix_made_elsewhere(MeshMatrix which, const SolidBlock& solids,
                                              const MeshView& mesh);

/// What they get for columns `first` to `end` − 1.
std::vector<std::byte> description_of_columns(MeshMatrix which, const SolidBlock& solids,
                                              const MeshView& mesh, int first, int end);

/// How they do so: linalg::MakeColumns of a program.
linalg::SparseMatrix made_columns(std::span<const std::byte> description, int first, int end);

}  // namespace buckens::fem

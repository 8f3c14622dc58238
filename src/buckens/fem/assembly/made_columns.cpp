// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/made_columns.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "buckens/fem/assembly/inertia_assembly.h"
#include "buckens/fem/assembly/mesh_part.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/fem/assembly/stress_rows.h"
#include "buckens/linalg/counted_entries.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::fem {

using linalg::SparseMatrix;

namespace {

/// Of all variables of a part. Those whose elements are not all here lack something.
SparseMatrix matrix_of(MeshMatrix which, const MeshPart& part) {
  const MeshView mesh{part.nodes, part.dofs};
  if (which == MeshMatrix::mass) {
    AssembledInertia inertia = assemble_inertia(part.blocks, mesh, Eigen::Vector3d::Zero());
    // Only moments depend on the mass centre.
    const int n = part.dofs.num_dofs;
    ShapeIntegrals shape;
    for (std::size_t k = 0; k < 3; ++k) shape.W[k] = taken_matrix(n, inertia.sum.W[k]);
    shape.nodal = {linalg::SharedMatrix(std::move(inertia.scalar_mass)), translations(part.dofs)};
    return mass_entries(shape, taken_matrix(n, inertia.sum.M_flywheel), n);
  }
  SparseMatrix out;
  if (which == MeshMatrix::scalar_mass) {
    AssembledInertia inertia = assemble_inertia(part.blocks, mesh, Eigen::Vector3d::Zero());
    out.swap(inertia.scalar_mass);
    return out;
  }
  StiffnessMatrices stiffness = assemble_stiffness(part.blocks, mesh);
  out.swap(which == MeshMatrix::stiffness ? stiffness.K : stiffness.K_damping);
  return out;
}

/// The variables on which columns depend. @param is_asked of a variable that has a column
template <class IsAsked>
std::vector<bool> variables_behind(int num_dofs, const Following* T, IsAsked&& is_asked) {
  std::vector<bool> out(static_cast<std::size_t>(num_dofs), false);
  for (int row = 0; row < num_dofs; ++row) {
    if (T == nullptr) {
      out[static_cast<std::size_t>(row)] = is_asked(row);
      continue;
    }
    for (Following::InnerIterator it(*T, row); it; ++it) {
      if (is_asked(static_cast<int>(it.col()))) out[static_cast<std::size_t>(row)] = true;
    }
  }
  return out;
}

void put_following(const Following& T, const std::vector<int>& variables, base::BytesTo& put) {
  put(static_cast<int>(T.cols()));
  for (const int row : variables) {
    put(T.outerIndexPtr()[row + 1] - T.outerIndexPtr()[row]);
    for (Following::InnerIterator it(T, row); it; ++it) {
      put(static_cast<int>(it.col()));
      put(it.value());
    }
  }
}

/// Columns of T that these rows have, ascending.
std::vector<int> columns_of(const Following& T, const std::vector<int>& rows) {
  std::vector<int> out;
  for (const int row : rows) {
    for (Following::InnerIterator it(T, row); it; ++it) out.push_back(static_cast<int>(it.col()));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Makes the rows of each column ascend.
void sort_columns(SparseMatrix& A) {
  std::vector<std::pair<int, double>> entries;
  for (Eigen::Index k = 0; k < A.outerSize(); ++k) {
    const int* rows = A.innerIndexPtr();
    if (std::is_sorted(rows + A.outerIndexPtr()[k], rows + A.outerIndexPtr()[k + 1])) continue;
    entries.clear();
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), it.value());
    }
    std::sort(entries.begin(), entries.end());
    int place = A.outerIndexPtr()[k];
    for (const auto& [row, value] : entries) {
      A.innerIndexPtr()[place] = row;
      A.valuePtr()[place++] = value;
    }
  }
}

struct Run {
  int first, end;
};

/// Columns of a run of rows, from the diagonal on, of a matrix given by parts. The entries of A are
/// those of its lower triangle, which are sums as in one process, on whichever side of the diagonal
/// they are by rows.
/// @param rows of the variables of A @param size of all rows
SparseMatrix lower_triangle(const SparseMatrix& A, const std::vector<int>& rows, int size,
                            const Run& run) {
  const auto visit = [&](auto&& entry) {
    for (int k = 0; k < A.outerSize(); ++k) {
      for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
        if (it.row() < k) continue;
        const auto [column, row] = std::minmax(rows[static_cast<std::size_t>(k)],
                                               rows[static_cast<std::size_t>(it.row())]);
        if (column < run.first || column >= run.end) continue;
        entry(row, column - run.first, it.value());
      }
    }
  };
  SparseMatrix out = linalg::from_counted_entries(size, run.end - run.first, visit);
  sort_columns(out);
  return out;
}

/// Rows of T, its columns numbered among those that have entries here.
struct PartFollowing {
  int size = 0;              ///< columns of all of T
  std::vector<int> columns;  ///< of T, ascending, for each of those here
  SparseMatrix T;
};

PartFollowing taken_following(std::size_t rows, base::BytesFrom& take) {
  PartFollowing out;
  take(out.size);
  std::vector<linalg::Triplet> entries;
  for (std::size_t row = 0; row < rows; ++row) {
    for (int left = take.next<int>(); left > 0; --left) {
      const int column = take.next<int>();
      entries.emplace_back(static_cast<int>(row), column, take.next<double>());
      out.columns.push_back(column);
    }
  }
  std::sort(out.columns.begin(), out.columns.end());
  out.columns.erase(std::unique(out.columns.begin(), out.columns.end()), out.columns.end());
  const auto place = [&out](int column) {
    return std::lower_bound(out.columns.begin(), out.columns.end(), column) - out.columns.begin();
  };
  for (linalg::Triplet& entry : entries) {
    entry = {entry.row(), static_cast<int>(place(entry.col())), entry.value()};
  }
  out.T.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(out.columns.size()));
  out.T.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

std::vector<std::byte> description_of_columns(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, int first, int end, const linalg::RowOrder* order, const Following* T) {
  const auto row = [order](int variable) {
    return order != nullptr ? order->row(variable) : variable;
  };
  const auto is_asked = [&](int variable) { return row(variable) >= first && row(variable) < end; };
  base::BytesTo put;
  put(which);
  const std::vector<int> variables =
      put_part(blocks, mesh, variables_behind(mesh.dofs.num_dofs, T, is_asked), put);
  put(T != nullptr);
  if (T != nullptr) put_following(*T, variables, put);
  put(order != nullptr);
  if (order == nullptr) return put.take();
  for (const int variable : T != nullptr ? columns_of(*T, variables) : variables) {
    put(order->row(variable));
  }
  return put.take();
}

linalg::SymmetricMatrix matrix_made_elsewhere(
    MeshMatrix which, const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
    const MeshView& mesh, const linalg::SharedRowOrder& order, const Following* T) {
  const auto describe = [&](int first, int end) {
    return description_of_columns(which, blocks, mesh, first, end, order.get(), T);
  };
  return linalg::SymmetricMatrix(std::make_shared<const linalg::DividedMatrix>(
      T != nullptr ? T->cols() : mesh.dofs.num_dofs, describe, order));
}

SparseMatrix made_columns(std::span<const std::byte> description, int first, int end) {
  base::BytesFrom take(description);
  const auto which = take.next<MeshMatrix>();
  if (which == MeshMatrix::stress) return made_stress_rows(take, first, end);
  const MeshPart part = taken_part(take);
  SparseMatrix A = matrix_of(which, part);
  const bool follows = take.next<bool>();
  PartFollowing following;
  if (follows) {
    following = taken_following(part.variables.size(), take);
    A = condensed(A, following.T);
  }
  std::vector<int> rows = follows ? following.columns : part.variables;
  if (take.next<bool>()) take.take_all(rows.data(), rows.size());
  return lower_triangle(A, rows, follows ? following.size : part.size, {first, end});
}

SparseMatrix condensed(const SparseMatrix& A, const SparseMatrix& T) {
  if (A.nonZeros() == 0) return {T.cols(), T.cols()};
  const SparseMatrix AT = A * T;
  return T.transpose() * AT;
}

}  // namespace buckens::fem

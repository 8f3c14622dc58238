// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "buckens/linalg/matrix_sum.h"

namespace buckens::linalg {

/// The graph of a symmetric matrix in which columns with the same rows, such as the three of a node
/// of a solid mesh, are one vertex: a ninth of the edges, and no fill is overlooked.
struct ColumnGraph {
  std::vector<int> first_column;  ///< vertices + 1: vertex v has columns[first_column[v]] …
  std::vector<int> columns;       ///< of the matrix, ascending within a vertex
  std::vector<int> begin;         ///< vertices + 1: v has neighbours[begin[v]] …
  std::vector<int> neighbours;    ///< each pair twice, no vertex its own neighbour

  int size() const { return static_cast<int>(begin.size()) - 1; }
  int weight(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return first_column[v + 1] - first_column[v];
  }
};

/// @param A square; an entry counts for both triangles
ColumnGraph column_graph(const SparseMatrix& A);
/// The same of a sum whose terms are formed, which is read column by column.
ColumnGraph column_graph(const MatrixSum& A);

/// Vertex of each column, those with the same mark being one; vertices are numbered by their first
/// columns.
std::vector<int> vertices_of(const std::vector<std::uint64_t>& marks);
/// @param vertex of each column @param edges pairs of vertices, each in any order and at least once
ColumnGraph graph_of(const std::vector<int>& vertex, std::span<const int> edges);

/// Order of elimination with little fill: nested dissection (METIS) for large matrices, least
/// degree (AMD) for small ones. The same graph always gets the same order.
/// @return the vertex at each place
std::vector<int> elimination_order(const ColumnGraph& graph);

}  // namespace buckens::linalg

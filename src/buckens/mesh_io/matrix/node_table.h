// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/source_location.h"

namespace buckens::mesh_io {

/// A node of a body given by matrices.
struct TableNode {
  std::int64_t number = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<std::int64_t, 6> rows = {};  ///< from 1; 0: the node has no such variable
  int line = 0;
};

struct MatrixNodeTable {
  std::string file;
  std::vector<TableNode> nodes;
  bool has_rows = false;  ///< the table says which row each variable is

  SourceLocation where(const TableNode& node) const { return {file, node.line, 1}; }
};

/// Reads a CSV table with a heading: node, x, y, z and optionally ux, uy, uz, rx, ry, rz.
/// @throws InputError with file and line, IoError if the file cannot be read
MatrixNodeTable read_matrix_node_table(const std::filesystem::path& path);

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "buckens/base/source_location.h"

namespace buckens::mesh_io {

/// An entry of a matrix in a file: by row and column, or by nodes and their variables.
struct MatrixEntry {
  std::int64_t row = 0;           ///< from 1; or the number of a node
  std::int64_t column = 0;        ///< the same
  signed char row_variable = -1;  ///< 0…5, −1 where rows are counted
  signed char column_variable = -1;
  double value = 0;
  int line = 0;
};

/// A square matrix from a file, in the units of the file.
struct MatrixFile {
  std::string file;
  bool is_labelled = false;  ///< by nodes and variables
  bool is_triangle = false;  ///< off-diagonal entries represent two
  std::int64_t size = 0;     ///< rows; of labelled matrices 0
  std::vector<MatrixEntry> entries;

  SourceLocation where(const MatrixEntry& entry) const { return {file, entry.line, 1}; }
};

/// Reads a matrix: Matrix Market (coordinate or array, real or integer, general or symmetric), or
/// what *MATRIX OUTPUT of Abaqus writes as text (FORMAT=MATRIX INPUT: row node, row variable,
/// column node, column variable, value; FORMAT=COORDINATE: row, column, value), which is also that
/// of CalculiX (.sti, .mas). The format is recognised by the contents.
/// @throws InputError with file and line, IoError if the file cannot be read
MatrixFile read_matrix_file(const std::filesystem::path& path);

}  // namespace buckens::mesh_io

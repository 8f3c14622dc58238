// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/panel_factor.h"

namespace buckens::linalg {

/// Panels as files, for factor_cache.h.
class PanelFile {
 public:
  /// @param A the matrix that the factor belongs to
  /// @param pool shares the work of finding its key, or null
  PanelFile(const std::filesystem::path& folder, const SparseMatrix& A, TaskPool* pool = nullptr);
  /// The same file for the same entries, without forming the sum.
  PanelFile(const std::filesystem::path& folder, const MatrixSum& A, TaskPool* pool = nullptr);

  const std::filesystem::path& path() const { return path_; }

  struct Stored {
    PanelFactor factor;
    double entries = 0;  ///< of L
  };
  /// The factor of the matrix, or nothing: no file, or one that is not complete and unchanged,
  /// which is said in the log.
  /// @throws std::bad_alloc
  std::optional<Stored> read(SimdLevel level) const;
  /// Writes aside and renames. That it fails is said in the log.
  void write(const PanelFactor& factor, double entries) const;

 private:
  struct PlainPanel;
  struct Header;
  struct Runs;

  std::string key_;
  std::filesystem::path path_;
};

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "buckens/body/basis_store.h"

namespace buckens::run_store {

/// Reduced bases in HDF5 files, one per file: `Z` (n×r), `omega`, counts, and the key they belong
/// to.
class BasisFiles : public body::BasisStore {
 public:
  /// What to do with a file that belongs to another mesh, interface or choice.
  enum class Others {
    refuse,
    leave,  ///< unchanged and unused: variants of a model name the same file
  };

  /// @param directory for relative names: that of the model file
  explicit BasisFiles(std::filesystem::path directory, Others others = Others::refuse)
      : directory_(std::move(directory)), others_(others) {}

  /// @throws InputError if the file is not a basis or, unless those are left alone, belongs to
  /// another mesh, interface or choice, IoError if it cannot be read
  std::optional<body::ReducedBasis> find(const std::string& file, std::uint64_t key) override;
  /// Writes under another name first, so that a partial file is never found; does not overwrite
  /// others that are left alone. @throws IoError
  void keep(const std::string& file, std::uint64_t key, const body::ReducedBasis& basis) override;

 private:
  std::filesystem::path directory_;
  Others others_;
};

}  // namespace buckens::run_store

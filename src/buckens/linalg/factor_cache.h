// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace buckens::linalg {

/// While it lives, the large factors that the calling thread needs are looked for in a folder, and
/// those it computes are kept there. May be nested: the inner one counts.
///
/// A file is found by a hash of the whole matrix and checked by one of its own contents; whatever
/// is missing, cut short or changed is computed anew. Files appear under their names when they are
/// complete, so that concurrent runs may share a folder. They are never deleted; incomplete ones
/// that killed processes have left are, when another factor is written.
class FactorCache {
 public:
  /// @param folder made where it is missing; empty: none
  explicit FactorCache(std::filesystem::path folder);
  ~FactorCache();
  FactorCache(const FactorCache&) = delete;
  FactorCache& operator=(const FactorCache&) = delete;

  /// Of the calling thread; empty: none.
  static const std::filesystem::path& folder();

 private:
  std::filesystem::path before_;
};

}  // namespace buckens::linalg

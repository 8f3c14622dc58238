// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "buckens/linalg/grid_plugin.h"

namespace buckens::linalg {

/// What columns `first` to `end` − 1 of a matrix are made of, for MakeColumns.
using DescribeColumns = std::function<std::vector<std::byte>(int first, int end)>;

/// Gives the plug-in what other processes make columns of (BuckensGridDescription).
class ColumnDescriptions {
 public:
  /// @param describe must outlive this object
  explicit ColumnDescriptions(const DescribeColumns& describe) : describe_(&describe) {}

  BuckensGridDescription for_plugin() { return {give, this}; }

 private:
  static int give(void* source, int first, int end, const void** bytes, long* count);

  const DescribeColumns* describe_;
  std::vector<std::byte> last_;
};

}  // namespace buckens::linalg

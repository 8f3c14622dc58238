// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::fem {

/// What a model file or command line asks of a mesh reader.
struct MeshWishes {
  /// Groups of surfaces and lines that become elements even where they lie on others.
  std::vector<std::string> members;
  /// Keywords, cards and element types to leave out although they have mass or stiffness.
  std::vector<std::string> skip;
  /// Element sets, groups, instances or properties to import; empty: everything.
  std::vector<std::string> only;
};

}  // namespace buckens::fem

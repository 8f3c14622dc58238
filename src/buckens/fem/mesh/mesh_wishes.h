// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::fem {

/// What a model file or a command line asks of the reader of a mesh file.
struct MeshWishes {
  /// Groups of surfaces and lines that are elements also where they lie on others.
  std::vector<std::string> members;
  /// Keywords, cards and element types that are left out although they have mass or stiffness.
  std::vector<std::string> skip;
  /// Element sets, groups, instances or properties that alone are taken; empty: everything.
  std::vector<std::string> only;
};

}  // namespace buckens::fem

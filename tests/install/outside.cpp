// SPDX-License-Identifier: Apache-2.0
// Uses the installed package the way a stranger's program would.
#include <cstdio>
#include <cstring>

#include <Eigen/Geometry>

#include "buckens/base/version.h"
#include "buckens/linalg/matrix_types.h"

int main() {
  const buckens::linalg::Matrix identity = buckens::linalg::Matrix::Identity(3, 3);
  if (identity.trace() != 3.0 || std::strlen(buckens::kVersion) == 0) {
    return 1;
  }
  std::printf("outside project runs with buckens %s\n", buckens::kVersion);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/body_lengths.h"

#include <cmath>

namespace buckens::body {

using linalg::Vector;

Vector coordinate_lengths(const Body& body) {
  const FlexiblePart& part = *body.flexible;
  Vector out = Vector::Ones(part.mesh().dofs.num_dofs);
  for (const auto& dofs : part.mesh().dofs.node_dofs) {
    for (std::size_t k = 3; k < 6; ++k) {
      if (dofs[k] >= 0 && dofs[k] < out.size()) out[dofs[k]] = body.length_scale();
    }
  }
  return part.recovery.column_sizes(out);
}

Eigen::VectorXd interface_lengths(const Body& body, double L) {
  const int rows = body.num_interface_rows();
  Eigen::VectorXd out = Eigen::VectorXd::Ones(rows);
  for (const Marker& marker : body.markers) {
    const int first = marker.rotation_row;
    if (first >= 0 && first + 3 <= rows) out.segment<3>(first).setConstant(L);
  }
  if (rows == 0 || body.flexible->num_pattern_rows == 0) return out;
  const Vector inverse = coordinate_lengths(body).cwiseInverse();
  for (int k = rows - body.flexible->num_pattern_rows; k < rows; ++k) {
    double sum = 0.0;
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    for (Rows::InnerIterator it(body.flexible->rows, k); it; ++it) {
      sum += std::abs(it.value()) * inverse[it.col()];
    }
    out[k] = sum > 0.0 ? 1.0 / sum : 1.0;
  }
  return out;
}

}  // namespace buckens::body

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/elastic_compliance.h"

#include "buckens/body/mesh_solver.h"

namespace buckens::analysis {

using linalg::Matrix;
using linalg::SparseMatrix;

ElasticCompliance::ElasticCompliance(const body::Body& body)
    : inverse_(body.name, body.flexible->fe, body.flexible->sieve, body.length_scale(),
               body::solver_of(*body.flexible)) {
  const SparseMatrix N = body.flexible->rows.topRows(body.flexible->num_interface_rows);
  columns_ = inverse_.solve_checked(Matrix(SparseMatrix(N.transpose())));
  interface_ = N * columns_;
  interface_ = 0.5 * (interface_ + interface_.transpose().eval());
}

}  // namespace buckens::analysis

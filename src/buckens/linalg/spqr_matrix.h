// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <SuiteSparseQR.hpp>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Copy of a matrix in the long indices that SPQR takes, with SPQR's workspace.
struct SpqrMatrix {
  explicit SpqrMatrix(const SparseMatrix& A)
      : starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()),
        values(A.valuePtr(), A.valuePtr() + A.nonZeros()) {
    cholmod_l_start(&common);
    common.print = 0;
    view.nrow = static_cast<std::size_t>(A.rows());
    view.ncol = static_cast<std::size_t>(A.cols());
    view.nzmax = values.size();
    view.p = starts.data();
    view.i = rows.data();
    view.x = values.data();
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
  }
  ~SpqrMatrix() { cholmod_l_finish(&common); }
  SpqrMatrix(const SpqrMatrix&) = delete;
  SpqrMatrix& operator=(const SpqrMatrix&) = delete;

  /// Why SPQR failed, and what to do.
  std::string failure() const {
    const std::string size = std::to_string(view.nrow) + " × " + std::to_string(view.ncol);
    if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      return "there is not enough memory for a QR factor of a matrix of size " + size +
             "; use fewer joints or frames";
    }
    return "SPQR refused a matrix of size " + size + " (status " + std::to_string(common.status) +
           "); please report this with the model";
  }

  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;
  cholmod_sparse view{};
  cholmod_common common{};
};

}  // namespace buckens::linalg

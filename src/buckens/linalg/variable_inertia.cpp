// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/variable_inertia.h"

#include "buckens/linalg/row_task.h"

namespace buckens::linalg {

using Eigen::Index;
using Eigen::Map;
using Eigen::Vector3d;

/// What a coupling is formed of, and where it goes.
struct VariableInertia::Task {
  const double *d, *rate, *acceleration;
  Eigen::Matrix3d with_d, with_rate;
  double* load;
  NodeSums* sums;

  /// Adds what row i of W_ab d and of W_ab ḋ contributes, with T_ab(x, y) = xᵀ W_ab y = yᵀ W_ba x.
  void add(int a, int b, int i, double Wd, double Wv) const {
    at(a, b) += d[i] * Wd;
    at(b, 3 + a) += rate[i] * Wd;
    at(b, 6 + a) += acceleration[i] * Wd;
    if (load != nullptr) load[i] += with_d(a, b) * Wd + with_rate(a, b) * Wv;
  }
  double& at(int row, int column) const { return sums->value[4 * column + row]; }
};

void VariableInertia::couple(const std::array<const double*, 3>& vectors, const double* weights,
                             double* load, NodeSums& sums) const {
  const Map<const Eigen::Matrix<double, 4, 6>> of(weights);
  const Task task{vectors[0],           vectors[1], vectors[2], of.topLeftCorner<3, 3>(),
                  of.block<3, 3>(0, 3), load,       &sums};
  couple_by_integrals(task);
  couple_by_nodes(task);
}

void VariableInertia::couple_by_integrals(const Task& task) const {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const SparseMatrix& W = tables_->W[static_cast<std::size_t>(3 * a + b)];
      for (int i = 0; i < W.outerSize(); ++i) {
        double Wd = 0, Wv = 0;
        for (SparseMatrix::InnerIterator it(W, i); it; ++it) {
          Wd += it.value() * task.d[it.row()];
          if (task.load != nullptr) Wv += it.value() * task.rate[it.row()];
        }
        task.add(a, b, i, Wd, Wv);
      }
    }
  }
}

/// W_ab = Ms ⊗ E_ab: row i of W_ab x, i the variable of node j in direction a, is that of Ms in
/// direction b.
void VariableInertia::couple_by_nodes(const Task& task) const {
  const auto at = [](const double* x, const std::array<int, 3>& places) -> Vector3d {
    Vector3d out = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      if (places[k] >= 0) out[static_cast<Index>(k)] = x[places[k]];
    }
    return out;
  };
  const SparseMatrix& Ms = tables_->Ms;
  for (int node = 0; node < Ms.outerSize(); ++node) {
    Vector3d Md = Vector3d::Zero(), Mv = Vector3d::Zero();
    for (SparseMatrix::InnerIterator it(Ms, node); it; ++it) {
      const std::array<int, 3>& places = tables_->nodes[static_cast<std::size_t>(it.row())];
      Md += it.value() * at(task.d, places);
      if (task.load != nullptr) Mv += it.value() * at(task.rate, places);
    }
    const std::array<int, 3>& own = tables_->nodes[static_cast<std::size_t>(node)];
    for (int a = 0; a < 3; ++a) {
      const int i = own[static_cast<std::size_t>(a)];
      if (i < 0 || i >= variables_) continue;
      for (int b = 0; b < 3; ++b) task.add(a, b, i, Md[b], Mv[b]);
    }
  }
}

void VariableInertia::add_products(const Matrix& columns, const double* x, double* sums) const {
  const Map<const Vector> of(x, variables_);
  for (Index k = 0; k < columns.cols(); ++k) sums[k] += columns.col(k).dot(of);
}

void VariableInertia::add_moments(const double* x, double* sums) const {
  add_products(tables_->P, x, sums);
  add_products(tables_->patterns, x, sums + kPatternSums);
}

void VariableInertia::subtract(const double* motion, double* y) const {
  const Matrix& Phi = tables_->Phi;
  Map<Vector>(y, variables_).noalias() -= Phi * Map<const Vector>(motion, Phi.cols());
}

void VariableInertia::add_resultants(const double* f, double* sums) const {
  add_products(tables_->Phi, f, sums);
}

void VariableInertia::subtract_load(const double* motion, double* f) const {
  const auto subtract_columns = [&](const Matrix& columns, const double* weights) {
    Map<Vector>(f, variables_).noalias() -= columns * Map<const Vector>(weights, columns.cols());
  };
  subtract_columns(tables_->P, motion);
  subtract_columns(tables_->patterns, motion + kPatternSums);
}

}  // namespace buckens::linalg

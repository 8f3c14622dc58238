// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/deformation_coupling.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "buckens/body/column_products.h"
#include "buckens/body/nodal_inertia.h"
#include "buckens/body/second_moments.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/spatial/rotation.h"

namespace buckens::body {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

/// T(d, d), T(d, ḋ) and T(d, d̈) with T_ab(x, y) = xᵀ W_ab y.
struct Products {
  Products(const Matrix3d& of_d, const Matrix3d& of_rate, const Matrix3d& of_acceleration)
      : dd(of_d), dv(of_rate), da(of_acceleration) {}
  explicit Products(const linalg::NodeSums& sums) {
    const Eigen::Map<const Eigen::Matrix<double, 4, linalg::NodeSums::kColumns>> sum(sums.value);
    dd = sum.block<3, 3>(0, 0);
    dv = sum.block<3, 3>(0, 3);
    da = sum.block<3, 3>(0, 6);
  }
  /// J₂, J̇₂, l and l̇.
  DeformedMoments moments() const {
    DeformedMoments out;
    out.J = to_inertia(dd);
    out.J_dot = to_inertia(dv + dv.transpose());
    out.l = axial(dv);
    out.l_dot = axial(da);
    return out;
  }

  Matrix3d dd, dv, da;
};

/// One pass over the integrals: T_ab(x, y) = xᵀ W_ab y and the loads.
class Pass {
 public:
  Pass(const Vector& d, const Vector& d_dot, const Vector& d_ddot,
       const DeformationWeights& weights, Vector& load)
      : d_(d), v_(d_dot), a_(d_ddot), weights_(weights), load_(load), loads_(!weights.are_zero()) {}

  /// W_ab with a ≤ b, and W_ba, its transpose.
  void add(const SparseMatrix& W, int a, int b) {
    const bool is_mixed = a != b;
    for (int j = 0; j < W.outerSize(); ++j) {
      double Wd = 0, Wv = 0, Wa = 0;  // row j of Wᵀ times d, ḋ, d̈
      const double spread = weights_.with_d(a, b) * d_[j] + weights_.with_rate(a, b) * v_[j];
      for (SparseMatrix::InnerIterator it(W, j); it; ++it) {
        Wd += it.value() * d_[it.row()];
        Wv += it.value() * v_[it.row()];
        Wa += it.value() * a_[it.row()];
        if (loads_) load_[it.row()] += spread * it.value();
      }
      dd_(a, b) += Wd * d_[j];
      dv_(a, b) += Wd * v_[j];
      da_(a, b) += Wd * a_[j];
      if (!is_mixed) continue;
      dv_(b, a) += Wv * d_[j];
      da_(b, a) += Wa * d_[j];
      if (loads_) load_[j] += weights_.with_d(b, a) * Wd + weights_.with_rate(b, a) * Wv;
    }
    if (is_mixed) dd_(b, a) = dd_(a, b);
  }

  /// The same for an integral without zeros, as reduced bodies have them: two columns at a time.
  void add_full(const SparseMatrix& W, int a, int b) {
    const auto n = static_cast<int>(W.rows());
    for (int j = 0; j < n; j += 2) {
      // The last of an odd number is paired with itself and ignored the second time.
      const int next = std::min(j + 1, n - 1);
      if (a != b) {
        add_mixed_columns(W, a, b, j, next);
      } else {
        add_symmetric_columns(W, a, j, next);
      }
    }
    if (a != b) dd_(b, a) = dd_(a, b);
  }

  /// The share of the scalar mass matrix: Ms ⊗ E_ab for all pairs at once.
  void add(const NodalInertia& nodal, TaskPool* pool) {
    if (nodal.is_regular()) {
      add_regular({nodal.matrix(), nullptr, nullptr}, pool, false);
    } else {
      add_by_lookup(nodal.mass());
    }
  }

  /// The same where the variables are numbered by node.
  /// @param clears the load of each piece before it is formed
  void add_regular(const linalg::CommonTable& common, TaskPool* pool, bool clears) {
    const linalg::NodeMatrix& Ms = common.mass;
    const linalg::NodeKernels& kernels = linalg::node_kernels();
    const std::array<const double*, 3> vectors = {d_.data(), v_.data(), a_.data()};
    const Eigen::Matrix<double, 4, 6> weights = weights_.by_columns();
    const linalg::RowParts rows(d_.size(), 3);
    std::array<linalg::NodeSums, linalg::RowParts::kMostParts> sums;
    common.for_pieces(rows, pool, [&](int part, Eigen::Index first, Eigen::Index size) {
      if (clears) load_.segment(first, size).setZero();
      kernels.couple(Ms, static_cast<int>(first / 3), static_cast<int>(size / 3), vectors.data(),
                     weights.data(), loads_ ? load_.data() : nullptr,
                     sums[static_cast<std::size_t>(part)]);
    });
    for (int part = 0; part < rows.count(); ++part) {
      const Products sum(sums[static_cast<std::size_t>(part)]);
      dd_ += sum.dd;
      dv_ += sum.dv;
      da_ += sum.da;
    }
  }

  DeformedMoments moments() const { return Products{dd_, dv_, da_}.moments(); }

 private:
  static const double* column(const SparseMatrix& W, int j) {
    return W.valuePtr() + static_cast<std::ptrdiff_t>(j) * W.rows();
  }

  void add_mixed_columns(const SparseMatrix& W, int a, int b, int j, int next) {
    const auto spread = [&](int k) {
      return weights_.with_d(a, b) * d_[k] + weights_.with_rate(a, b) * v_[k];
    };
    ColumnPair<3> products;
    products.multiply(column(W, j), column(W, next), static_cast<int>(W.rows()),
                      {d_.data(), v_.data(), a_.data()}, {spread(j), next > j ? spread(next) : 0.0},
                      loads_ ? load_.data() : nullptr);
    for (int k = j; k <= next; ++k) {
      const auto& [Wd, Wv, Wa] = k == j ? products.first : products.second;
      dd_(a, b) += Wd * d_[k];
      dv_(a, b) += Wd * v_[k];
      da_(a, b) += Wd * a_[k];
      dv_(b, a) += Wv * d_[k];
      da_(b, a) += Wa * d_[k];
      if (loads_) load_[k] += weights_.with_d(b, a) * Wd + weights_.with_rate(b, a) * Wv;
    }
  }

  /// Of an integral with equal indices, which is symmetric.
  void add_symmetric_columns(const SparseMatrix& W, int a, int j, int next) {
    ColumnPair<2> products;
    products.multiply(column(W, j), column(W, next), static_cast<int>(W.rows()),
                      {d_.data(), v_.data()}, {0.0, 0.0}, nullptr);
    for (int k = j; k <= next; ++k) {
      const auto& [Wd, Wv] = k == j ? products.first : products.second;
      dd_(a, a) += Wd * d_[k];
      dv_(a, a) += Wd * v_[k];
      da_(a, a) += Wd * a_[k];
      if (loads_) load_[k] += weights_.with_d(a, a) * Wd + weights_.with_rate(a, a) * Wv;
    }
  }

  void add_by_lookup(const fem::NodalMass& mass) {
    const SparseMatrix& Ms = *mass.Ms;
    for (int node = 0; node < Ms.outerSize(); ++node) {
      Vector3d Md = Vector3d::Zero(), Mv = Vector3d::Zero();
      for (SparseMatrix::InnerIterator it(Ms, node); it; ++it) {
        const auto& dofs = mass.dofs[static_cast<std::size_t>(it.row())];
        Md += it.value() * at(d_, dofs);
        if (loads_) Mv += it.value() * at(v_, dofs);
      }
      const auto& dofs = mass.dofs[static_cast<std::size_t>(node)];
      dd_ += Md * at(d_, dofs).transpose();
      dv_ += Md * at(v_, dofs).transpose();
      da_ += Md * at(a_, dofs).transpose();
      if (!loads_) continue;
      const Vector3d f = weights_.with_d * Md + weights_.with_rate * Mv;
      for (std::size_t k = 0; k < 3; ++k) {
        if (dofs[k] >= 0) load_[dofs[k]] += f[static_cast<Eigen::Index>(k)];
      }
    }
  }

  /// Translations of a node, zero where it has no variable.
  static Vector3d at(const Vector& x, const std::array<int, 3>& dofs) {
    return {dofs[0] >= 0 ? x[dofs[0]] : 0.0, dofs[1] >= 0 ? x[dofs[1]] : 0.0,
            dofs[2] >= 0 ? x[dofs[2]] : 0.0};
  }

  const Vector& d_;
  const Vector& v_;
  const Vector& a_;
  const DeformationWeights& weights_;
  Vector& load_;
  const bool loads_;
  Matrix3d dd_ = Matrix3d::Zero();  // T(d, d)
  Matrix3d dv_ = Matrix3d::Zero();  // T(d, ḋ)
  Matrix3d da_ = Matrix3d::Zero();  // T(d, d̈)
};

}  // namespace

DeformedMoments deformed_moments(const linalg::NodeSums& sums) { return Products(sums).moments(); }

Eigen::Matrix<double, 4, 6> DeformationWeights::by_columns() const {
  Eigen::Matrix<double, 4, 6> out = Eigen::Matrix<double, 4, 6>::Zero();
  out.topRows<3>() << with_d, with_rate;
  return out;
}

DeformationWeights DeformationWeights::of_motion(const Vector3d& w, const Vector3d& w_dot,
                                                 const CouplingTerms& kept) {
  // Σ w_a H_a = Σ A_ab W_ab with A = −w×.
  DeformationWeights out;
  if (kept.cent1) out.with_d += w.squaredNorm() * Matrix3d::Identity() - w * w.transpose();
  if (kept.eul_fe) out.with_d -= spatial::skew(w_dot);
  if (kept.cor_fe) out.with_rate = -2.0 * spatial::skew(w);
  return out;
}

DeformedMoments evaluate_deformation(const fem::ShapeIntegrals& shape, const Vector& d,
                                     const Vector& d_dot, const Vector& d_ddot,
                                     const DeformationWeights& weights, Vector& load,
                                     TaskPool* pool, const linalg::CommonTable* common,
                                     bool overwrites) {
  const bool clears = overwrites && !weights.are_zero();
  const bool has_integrals = std::any_of(shape.W.begin(), shape.W.end(),
                                         [](const SparseMatrix& W) { return W.nonZeros() > 0; });
  const bool clears_pieces = clears && common != nullptr && !has_integrals;
  if (clears && !clears_pieces) load.setZero();
  Pass pass(d, d_dot, d_ddot, weights, load);
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const SparseMatrix& W = shape.W[k];
    if (W.nonZeros() == 0) continue;
    if (W.isCompressed() && W.nonZeros() == W.rows() * W.cols()) {
      pass.add_full(W, kPairs[k][0], kPairs[k][1]);
    } else {
      pass.add(W, kPairs[k][0], kPairs[k][1]);
    }
  }
  if (common != nullptr) {
    pass.add_regular(*common, pool, clears_pieces);
  } else if (!shape.nodal.empty()) {
    pass.add(NodalInertia(shape.nodal), pool);
  }
  return pass.moments();
}

}  // namespace buckens::body

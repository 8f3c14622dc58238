// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "buckens/linalg/node_kernels.h"
#include "buckens/linalg/row_tables.h"

namespace buckens::linalg {

/// What the inertia of a body does with the rows of its vectors that a process has. Vectors have
/// the numbers of the units beside after these where it says so.
class RowInertia {
 public:
  virtual ~RowInertia() = default;
  RowInertia(const RowInertia&) = delete;
  RowInertia& operator=(const RowInertia&) = delete;

  /// y = (Ms ⊗ 1) x, x with units beside. Only of bodies for which this is M x.
  virtual void multiply_mass(const double* x, double* y) const;
  /// Moments and load of a deformation as NodeKernels::couple. @param vectors d, ḋ, d̈, the first
  /// two with units beside @param load added to, or null
  virtual void couple(const std::array<const double*, 3>& vectors, const double* weights,
                      double* load, NodeSums& sums) const = 0;
  /// Of nodes NodeKernels::moments, of variables Pᵀx, then from kPatternSums on cᵀx of the
  /// patterns. @param sums kMomentSums, added to
  virtual void add_moments(const double* x, double* sums) const = 0;
  /// y ← y − Φ a. @param motion T as of NodeKernels::subtract for nodes, amplitudes a for variables
  virtual void subtract(const double* motion, double* y) const = 0;
  /// Of loads: of nodes NodeKernels::moments about their positions, of variables Φᵀf.
  /// @param sums kMomentSums, added to
  virtual void add_resultants(const double* f, double* sums) const = 0;
  /// Of nodes f ← f − T (s, m), of variables f ← f − P a − c b, c the patterns. @param motion T as
  /// of NodeKernels::subtract for nodes, a and from kPatternSums on b for variables
  virtual void subtract_load(const double* motion, double* f) const = 0;

 protected:
  RowInertia() = default;
};

/// @param tables lives longer
std::unique_ptr<RowInertia> row_inertia(const RowTables& tables);

}  // namespace buckens::linalg

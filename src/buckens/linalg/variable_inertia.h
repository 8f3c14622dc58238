// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/row_inertia.h"

namespace buckens::linalg {

/// Inertia of a body of any elements and constraints, for the variables that a process has.
class VariableInertia final : public RowInertia {
 public:
  VariableInertia(const VariableTables& tables, int variables)
      : tables_(&tables), variables_(variables) {}

  void couple(const std::array<const double*, 3>& vectors, const double* weights, double* load,
              NodeSums& sums) const override;
  void add_moments(const double* x, double* sums) const override;
  void subtract(const double* motion, double* y) const override;
  void add_resultants(const double* f, double* sums) const override;
  void subtract_load(const double* motion, double* f) const override;

 private:
  struct Task;
  void couple_by_integrals(const Task& task) const;
  void couple_by_nodes(const Task& task) const;
  void add_products(const Matrix& columns, const double* x, double* sums) const;

  const VariableTables* tables_;
  int variables_;
};

}  // namespace buckens::linalg

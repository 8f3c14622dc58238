// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_inertia.h"

#include <limits>

#include "buckens/base/errors.h"
#include "buckens/linalg/row_task.h"
#include "buckens/linalg/variable_inertia.h"

namespace buckens::linalg {

namespace {

class NodeInertia final : public RowInertia {
 public:
  NodeInertia(const NodeTables& tables, int nodes)
      : tables_(&tables),
        nodes_(nodes),
        // No node is the last one: vectors have a number more than their nodes have.
        mass_{tables.Ms.valuePtr(), tables.Ms.innerIndexPtr(), tables.Ms.outerIndexPtr(),
              std::numeric_limits<int>::max()} {}

  void multiply_mass(const double* x, double* y) const override {
    kernels_->multiply(mass_, 0, nodes_, x, y);
  }
  void couple(const std::array<const double*, 3>& vectors, const double* weights, double* load,
              NodeSums& sums) const override {
    kernels_->couple(mass_, 0, nodes_, vectors.data(), weights, load, sums);
  }
  void add_moments(const double* x, double* sums) const override {
    add_products(tables_->first_moments, x, sums);
  }
  void subtract(const double* motion, double* y) const override {
    kernels_->subtract(tables_->positions.data(), 0, nodes_, motion, y);
  }
  void add_resultants(const double* f, double* sums) const override {
    add_products(tables_->positions, f, sums);
  }
  void subtract_load(const double* motion, double* f) const override {
    kernels_->subtract(tables_->first_moments.data(), 0, nodes_, motion, f);
  }

 private:
  void add_products(const Eigen::Matrix4Xd& places, const double* x, double* sums) const {
    NodeSums own;
    kernels_->moments(places.data(), 0, nodes_, x, own);
    for (int k = 0; k < kMomentSums; ++k) sums[k] += own.value[k];
  }

  const NodeKernels* kernels_ = &node_kernels();
  const NodeTables* tables_;
  int nodes_;
  NodeMatrix mass_;
};

}  // namespace

void RowInertia::multiply_mass(const double* /*x*/, double* /*y*/) const {
  throw NumericalError("this mass matrix does not act node by node");
}

std::unique_ptr<RowInertia> row_inertia(const RowTables& tables) {
  if (const auto* nodes = std::get_if<NodeTables>(&tables.inertia)) {
    return std::make_unique<NodeInertia>(*nodes, tables.count);
  }
  return std::make_unique<VariableInertia>(std::get<VariableTables>(tables.inertia), tables.count);
}

}  // namespace buckens::linalg

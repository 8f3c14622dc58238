// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/base/task_pool.h"
#include "buckens/body/body.h"
#include "buckens/body/nodal_inertia.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// β with C = α M + β K, α the mass damping of the body; empty if C is something else or missing.
std::optional<double> stiffness_damping(const body::FlexiblePart& part);

/// The terms M a + C b of a step's right-hand side, FM (37), without a product with K where damping
/// is proportional: C = α M + β K and K̂ = m M + c C + k K give
///
///     K̂⁻¹ C b = β' b + K̂⁻¹ ζ M b,   β' = β/(k + cβ),   ζ = α − β'(m + cα),
///
/// so that b joins a under one product with M and β'b is added after the solve. M itself is applied
/// node by node as scalar mass matrix where that is all of it (solids): a third of the bytes.
class InertialLoad {
 public:
  InertialLoad(const body::FlexiblePart& part, const Scheme& scheme);
  /// Reads a copy of the scalar mass matrix that several bodies have in common.
  void read_mass_from(const linalg::SharedMatrix& copy) {
    if (is_by_node_ && nodal_.is_regular()) nodal_.read_from(copy);
  }

  /// y = M x. Allocates nothing once `y` has its size.
  /// @param pool processes nodes of solids in parallel, with the same result
  void multiply_mass(const linalg::Vector& x, linalg::Vector& y, TaskPool* pool = nullptr) const;
  /// y = M a + C b.
  void multiply(const linalg::Vector& a, const linalg::Vector& b, linalg::Vector& y,
                TaskPool* pool = nullptr) const;
  /// Factor of b added to a: ζ, zero if undamped or not proportionally damped.
  double zeta() const { return zeta_; }
  /// Factor of b added to the solution: β', zero if undamped or not proportionally damped.
  double share() const { return share_; }
  /// Whether b is needed at all.
  bool is_damped() const { return part_->is_damped(); }
  bool is_proportional() const { return is_proportional_; }
  bool is_by_node() const { return is_by_node_; }

 private:
  const body::FlexiblePart* part_;
  body::NodalInertia nodal_;
  bool is_proportional_ = false;
  bool is_by_node_ = false;
  double share_ = 0;
  double zeta_ = 0;
};

}  // namespace buckens::stepping

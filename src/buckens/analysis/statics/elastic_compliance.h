// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/body/elastic_inverse.h"

namespace buckens::analysis {

/// Static response of a free flexible body, d = K⁺ f, with the rigid motion left to its frame, and
/// the responses to unit loads on its interface.
///
/// Needs its own sparse Cholesky factor and one solve per interface row, counted separately from
/// those of the time steps. Theory: docs/theory/06-initial-state.md §3.
class ElasticCompliance {
 public:
  /// @param body a flexible body, must outlive this object
  /// @throws ModelError if the mesh has strain-free motions other than rigid ones
  explicit ElasticCompliance(const body::Body& body);

  /// K⁺ f for a nodal load f.
  linalg::Vector solve(linalg::Vector load) const { return inverse_.solve(std::move(load)); }

  /// K⁺ Nᵀ, one column per interface row, n×rows [m/N, rad/N, …].
  const linalg::Matrix& columns() const { return columns_; }
  /// N K⁺ Nᵀ: interface values per interface load; symmetric, positive semidefinite.
  const linalg::Matrix& interface() const { return interface_; }
  /// Indices of the held variables, as many as there are rigid motions.
  const std::vector<int>& held() const { return inverse_.held(); }
  /// Large solves so far, including those for the columns.
  long num_solves() const { return inverse_.solves(); }

 private:
  body::ElasticInverse inverse_;
  linalg::Matrix columns_, interface_;
};

}  // namespace buckens::analysis

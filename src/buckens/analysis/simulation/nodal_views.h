// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include <Eigen/Core>

#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Nodal values of bodies as tables, one row per node, at fixed addresses.
///
/// The state itself cannot stay in place: a step needs its start and its end at once and swaps the
/// two. So a table is filled from the current state when requested.
class NodalViews {
 public:
  using NodalMatrix = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  using View = Eigen::Map<const NodalMatrix>;

  /// @param model outlives the object
  explicit NodalViews(const model::Model& model) : model_(model) {}

  /// Translations [m] and rotations [rad] of the nodes of a whole body, axes of its frame.
  /// @throws InputError if the body is rigid
  View displacements(std::size_t whole, const model::State& state);
  /// Their rates. @throws InputError if the body is rigid or has several frames
  View velocities(std::size_t whole, const model::State& state);

 private:
  void require_flexible(const model::WholeBody& whole) const;
  View show(NodalMatrix& table, std::size_t body, const linalg::Vector& values) const;

  const model::Model& model_;
  std::map<std::size_t, NodalMatrix> displacements_, velocities_;  // by whole; nodes of a map stay
};

}  // namespace buckens::analysis

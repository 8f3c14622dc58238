// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/stepping/strand/mechanism.h"

namespace buckens::stepping {

/// Loads on bodies of a StrandMechanism, taken one by one: forces, torques and distributed loads by
/// laws of time and their markers. Bodies that carry none cost nothing.
class StrandLoads {
 public:
  /// Whether a load is of this kind: nothing but time and its two markers, and no tangent.
  static bool suits(const model::Load& load);

  StrandLoads(const model::Model& model, StrandMechanism& mechanism);

  bool empty() const { return bodies_.empty(); }
  /// Loads at the motion in the tables go into their rows `given`.
  /// @param start of the step, @param t when the loads act
  void evaluate(const model::State& start, double t);

 private:
  template <class S>
  void evaluate_in(const model::State& start, double t);
  template <class S>
  void read_motion(const model::State& start, std::size_t b);
  template <class S>
  void write_loads(std::size_t b);

  const model::Model& model_;
  StrandMechanism& mechanism_;
  std::vector<std::size_t> bodies_;  // all in blocks with a load
  std::vector<dynamics::BodyMotion> motions_;
  dynamics::Forces forces_;
  linalg::Vector values_;  // scratch, of the nodal variables of a part
};

}  // namespace buckens::stepping

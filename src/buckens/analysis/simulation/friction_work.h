// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/joint_rub.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/friction_of_step.h"

namespace buckens::analysis {

/// Energy lost by dry friction in joints, step by step, as the method counts its forces.
///
/// A method moves velocities by h ((1 − s) a + s a⁺), a⁺ made of the accelerations by its
/// recursion. The same recursion, applied to the force of one law alone, gives φ, and what this
/// force has done is W = h ½ (ξ̇ + ξ̇⁺) ((1 − s) φ + s φ⁺): exactly its share of the change of
/// kinetic energy. What is not stored by the law afterwards is lost. Theory:
/// docs/theory/23-impacts.md §5.
class FrictionWork {
 public:
  FrictionWork(const model::Model& model, const model::State& start,
               const std::vector<dynamics::LoadPower>& of_loads);

  /// Impacts of a step.
  struct Blows {
    const model::State& before;  ///< at its start
    double rest;                 ///< stepping::StepReport::impact_rest [s]
  };
  /// Adds a step. @return energy lost in each law, in the order of loads() [J]
  /// @param h its length [s], @param end at its end, where impacts may have changed rates
  /// @param of_loads what the laws hold there
  /// @param blows not null: impacts have displaced bodies, and their loss is without the work of
  ///        forces along that way
  std::span<const double> add(const stepping::FrictionOfStep& step, double h,
                              const model::State& end,
                              const std::vector<dynamics::LoadPower>& of_loads,
                              const Blows* blows = nullptr);
  /// To be called where accelerations have jumped with forces, see ForceJump.
  /// @param signals t and the values of all signals before the jump; the state has those after it
  void jump(const model::State& state, const std::vector<double>& signals);
  /// To be called where accelerations of a state have been found anew.
  void restart(const model::State& state, const std::vector<dynamics::LoadPower>& of_loads);

  /// Indices into Model::loads, ascending.
  const std::vector<std::size_t>& loads() const { return loads_; }

  /// Saves or restores what later values depend on. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// One law at the last state.
  struct Past {
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    Eigen::Vector3d carried = Eigen::Vector3d::Zero();      // as the accelerations
    Eigen::Vector3d algorithmic = Eigen::Vector3d::Zero();  // as the algorithmic ones
    double stored = 0;                                      // [J]
  };
  /// Accelerations begin with the forces of a state.
  void begin_at(const model::State& state);
  /// Way of a law in a step with impacts that displace bodies, h times its mean rate. @param n
  /// which
  Eigen::Vector3d displacement(std::size_t n, const model::State& before, const model::State& end,
                               double h) const;
  /// Work of what its force has become after the impacts, in the time that is left of the step, as
  /// settle_after_impact() applies it. @param force of the step
  double work_after(std::size_t n, const Eigen::Vector3d& force, const model::State& end,
                    double rest) const;

  const model::Model& model_;
  std::vector<std::size_t> loads_;
  std::vector<Past> past_;
  double h_ = 0;  // of the last step; 0: accelerations have begun anew
  std::vector<double> lost_;
};

}  // namespace buckens::analysis

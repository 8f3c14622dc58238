// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "buckens/base/saved_values.h"
#include "buckens/dynamics/forces.h"
#include "buckens/linalg/nodal_vector.h"
#include "buckens/linalg/row_program.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/inertial_load.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::analysis {

/// Whether rates follow from the accelerations within a step, or impacts have changed them at its
/// end.
enum class RatesAtEnd { are_smooth, have_jumped };

/// Energy dissipated by the structural damping of one flexible body, step by step.
///
/// Where C = α M + β K and states satisfy the equations of motion (generalised-α, HHT), no product
/// with K is needed: K d follows from the loads on the body,
///
///     K (d + β ḋ) = F + Nᵀf − M (d̈ + α ḋ)      up to the span of P, to which d has no component,
///
/// and with the rate of K d by two-step backward differences this gives K d to order h². The step
/// then dissipates h α ḋᵀM ḋ + β/h Δᵀ K Δ, Δ = d⁺ − d. The rate of K d jumps where ḋ does: there K
/// d is formed, and the differences begin anew; in models with rigid rows, whose blows and releases
/// leave vibrations that no difference follows, it is formed in each step. Blows whose loss is all
/// that bodies have less of after them have in it what the jump of the shape damps: the step then
/// damps the motion before them. Otherwise, and for reduced bodies, h v̄ᵀC v̄ is formed with the mean
/// v̄ of the rates at both ends: what Newmark's method dissipates exactly, also of vibrations that
/// the step does not resolve. Theory: docs/theory/05-time-integration.md §6.
///
/// Where other processes have the vectors of the body, they form all of these, and sums come here
/// (damping_work_divided.cpp).
class DampingWork {
 public:
  /// @param holds_at_states whether states satisfy the equations of motion: not those of methods
  ///        that satisfy them within the step
  DampingWork(const model::Model& model, std::size_t body, const model::State& start,
              bool holds_at_states);

  /// Energy dissipated between the last state and this one [J].
  /// @param forces at this state, including those of joints
  double add(const model::State& state, const dynamics::Forces& forces,
             RatesAtEnd rates = RatesAtEnd::are_smooth);
  /// The same where blows have moved the body at the end of the step.
  /// @param before what it had there before them
  double add_before_blows(const stepping::ShapeAndRates& before, const model::State& state);
  /// To be called when something else than a step has changed the last state.
  void start(const model::State& state);

  std::size_t body() const { return index_; }
  /// Number of products with C or K so far.
  long num_products() const { return products_; }

  /// Saves or restores what later values depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// Starts from a state with other rates.
  void begin_at(const model::BodyState& s);
  /// h v̄ᵀC v̄ of the step to this state.
  /// @param d_dot rates at its end
  double direct_work(const linalg::NodalVector& d_dot, double h);
  double mass_power(const linalg::Vector& d_dot);
  /// Taken by C = α M + β K. @param elastic K d at the end of the step, @param power by α M there
  double proportional_work(const linalg::Vector& d, const linalg::Vector& elastic, double power,
                           double h);
  /// K d at the state from the balance of loads.
  void find_elastic_load(const model::State& state, const dynamics::Forces& forces, double h,
                         linalg::Vector& out);
  bool knows_rate(double h) const;
  /// Notes the end of a step. @param elastic K d there, replaced
  void go_on(linalg::NodalVector& elastic, double power, double step);

  // Of vectors that other processes have.
  struct Columns;
  const Columns& columns(const std::shared_ptr<linalg::DividedVectors>& of);
  void begin_there(const model::BodyState& s, const std::shared_ptr<linalg::DividedVectors>& of);
  double direct_work_there(const linalg::NodalVector& d_dot, double h,
                           const std::shared_ptr<linalg::DividedVectors>& of);
  double work_there(const model::State& state, const dynamics::Forces& forces, bool is_formed,
                    double h, const std::shared_ptr<linalg::DividedVectors>& of);
  linalg::DividedVector elastic_load_there(const model::State& state,
                                           const dynamics::Forces& forces, double h,
                                           const Columns& columns, linalg::RowProgram& program);

  const body::Body* body_;
  std::size_t index_;
  bool is_direct_ = true;
  bool forms_elastic_load_ = false;  // in each step, in place of the differences
  double beta_ = 0;
  std::optional<stepping::InertialLoad> mass_;
  double power_ = 0;                                  // of α M at the last state [W]
  double t_ = 0, last_step_ = 0;                      // 0: nothing is known of the rate of K d
  linalg::NodalVector rates_;                         // at the last state, where C is used
  linalg::NodalVector d_, elastic_, elastic_before_;  // K d at the last state and the one before
  linalg::NodalVector now_;                           // scratch
  linalg::Vector motion_, image_;                     // scratch
  std::shared_ptr<const Columns> columns_;
  long products_ = 0;
};

}  // namespace buckens::analysis

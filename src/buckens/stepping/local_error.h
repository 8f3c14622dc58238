// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/linalg/divided_vectors.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// Admissible total error of all steps. Both are dimensionless fractions.
struct ErrorTolerance {
  double relative = 1e-3;  ///< of the mechanism's size, of 1 rad, of a body's largest deformation
  double absolute = 1e-9;  ///< of the mechanism's size, additionally admissible for deformations
};

/// Error of one step relative to the admissible one.
struct ErrorEstimate {
  enum class Quantity { position, rotation, deformation };
  double ratio = 0;  ///< 1: just admissible
  std::size_t body = 0;
  Quantity quantity = Quantity::position;
};

/// Name of the quantity for messages.
const char* to_string(ErrorEstimate::Quantity quantity);

/// Estimates the error of a step from the method's own error term κ h³ x‴ (Scheme::error_constant).
///
/// x‴ is the third divided difference of positions over four instants; where the motion begins, its
/// rates stand in for missing instants. Accelerations are not used: those of stiff vibrations are
/// (ωh)² times larger than the motion, and would require steps that resolve every one of them.
/// Undamped vibrations of a mesh may instead err by a tenth of the tolerance per radian, κ h² x″:
/// errors that add up over the run would resolve all of its modes. Theory:
/// docs/theory/05-time-integration.md §10.
class LocalError {
 public:
  LocalError(const model::Model& model, const ErrorTolerance& tolerance);

  /// Discards the past: the motion starts here.
  void start(const model::State& state);
  bool has_begun() const { return !past_.empty(); }
  /// Error of the step from the last accepted state to `end`.
  /// @param share of the total tolerance that this step may use
  ErrorEstimate estimate(const model::State& end, const Scheme& scheme, double share);
  /// Takes `end` as the next point of the motion.
  void accept(const model::State& end);

  /// Saves or restores what later steps depend on.
  /// @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// Positions at one instant.
  struct Point {
    double t = 0;
    std::vector<spatial::Pose> poses;
    std::vector<linalg::NodalVector> d;
  };
  /// Rates at the instant where the motion began.
  struct Start {
    std::vector<Eigen::Vector3d> v, w, v_dot, w_dot;
    std::vector<linalg::NodalVector> d_dot;
  };
  /// Factors of positions (first the candidate, then the past from young to old) and start rates.
  struct Difference {
    std::vector<double> position;
    double rate = 0, acceleration = 0;
  };
  Difference third_difference(double t) const;
  Difference second_difference(double t) const;
  Point point_of(const model::State& state) const;
  /// Weighted deformations of a body.
  using Terms = std::vector<std::pair<double, const linalg::NodalVector*>>;
  /// Largest length of Σ weight d [m], where other processes have them there.
  double size_of(std::size_t b, const Terms& terms);
  double size_of(std::size_t b, const linalg::NodalVector& d) {
    return size_of(b, Terms{{1.0, &d}});
  }
  double size_there(std::size_t b, const Terms& terms,
                    const std::shared_ptr<linalg::DividedVectors>& of);
  /// Size of a divided difference of the deformation [m/sⁿ].
  double difference_of(std::size_t b, const model::BodyState& end, const Difference& f);
  /// Error of the deformation relative to the admissible one. @param t instant of the end
  double deformation_ratio(std::size_t b, const model::BodyState& end, const Scheme& scheme,
                           double t, double share);

  const model::Model& model_;
  ErrorTolerance tolerance_;
  std::vector<linalg::Vector> scale_;  ///< per body and nodal variable: converts it to a length
  /// The same, for vectors that other processes have.
  struct ScaleThere {
    std::shared_ptr<linalg::DividedVectors> of;
    linalg::DividedVector scale, zero;
  };
  std::vector<ScaleThere> scale_there_;
  std::deque<Point> past_;  ///< last point first, at most three
  Start start_;
  std::vector<double> largest_;   ///< deformation so far, per body [m]
  std::vector<double> expected_;  ///< from the very first trial, per body [m]
  bool is_first_trial_ = true;
};

}  // namespace buckens::stepping

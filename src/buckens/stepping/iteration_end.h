// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/joint_set.h"
#include "buckens/stepping/step_settings.h"

namespace buckens::stepping {

/// Rows whose pivots have fallen below this hold their bodies by a short lever, the root of the
/// pivot; rounding moves these bodies by its inverse more.
inline constexpr double kWeaklyHeld = 1e-6;

/// Tells when the small Newton of a step has converged, on every route through the step
/// (docs/theory/05-time-integration.md, section 3).
class IterationEnd {
 public:
  struct Change {
    double size = 0;    ///< largest change of an iteration [m]
    double motion = 0;  ///< largest motion of the step [m]
  };

  /// @param length of the model [m], @param lever the shortest that turns a body [m]
  IterationEnd(const StepSettings& settings, double length, double lever);

  /// A step begins. @param rounding_length to which positions are rounded [m]
  void begin(double rounding_length);
  /// The iteration goes on with another matrix or other forces, and converges at its own rate.
  void begin_anew() { contraction_ = 1.0; }
  /// Whether the last change was small enough, or as small as rounding lets it be.
  /// @param before the change before it, of size 0 if there is none
  /// @param pivots ratio of the smallest pivot to its diagonal entry; 0: no rows
  bool is_settled(const Change& change, const Change& before, double pivots);
  /// Whether another round with another coupling load may go on from here: what is left open is
  /// closed there. @param before size of the change before it, 0 if there is none [m]
  bool is_near(const Change& change, double before) const;
  /// Whether a change is within the rounding of positions, whatever the tolerance.
  bool is_rounding(const Change& change) const;
  /// What residuals may leave to be moved, so that no iteration is needed to tell [m].
  /// @param motion of the step [m]
  double negligible(double motion) const;

 private:
  double tolerance_;
  double near_;  // what may be left open for another round, relative to the motion
  bool keeps_rounding_;
  double length_;
  double leverage_;  // change of a body that a position turns by its rounding, over that rounding
  double rounding_length_;
  double contraction_ = 1;  // of the last two changes in this step
};

/// Reports the largest residuals of rows.
void record_residuals(const dynamics::JointResiduals& residuals, StepReport& report);

}  // namespace buckens::stepping

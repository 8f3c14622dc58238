// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/joints/constraint_row.h"

namespace buckens::dynamics {

/// A slider and the point of its beam where it is at one instant.
///
///     g = e·(p_M − c(s)),   (p_M − c(s))·c′(s) = 0 (R16)
///
/// s is sought in every evaluation from where the slider was at the start of the step. At the
/// nearest point changes of s do not change g, so a row acts as the force e on the slider and −e on
/// the point of the beam: through Hermite's shapes on the two nodes beside it. Their responses are
/// columns of the body's interface, so nothing is factorised when the slider passes a node.
class Travel {
 public:
  /// @param joint one with a track; both outlive the object
  /// @param memory null: the slider is sought along the whole beam
  Travel(const model::Model& model, const model::Joint& joint,
         const std::vector<BodyMotion>& motions, const model::RowMemory* memory)
      : Travel(model, joint, motions, states_of(joint, memory)) {}
  /// @param states of the joint as at the start of the step, where signals drive it told where to
  /// be at its end; null: not known; they outlive the object
  Travel(const model::Model& model, const model::Joint& joint,
         const std::vector<BodyMotion>& motions, const double* states);

  const joints::TrackPoint& point() const { return at_; }
  /// Displacement along the undeformed beam from the place as placed [m], and its rate.
  double displacement() const { return at_.s - joint_.track->placed; }
  double rate() const;
  /// The same for a law on this coordinate. @param coordinate index into Model::coordinates
  loads::CoordinateMotion coordinate(std::size_t coordinate, const model::RowMemory* memory) const;
  /// Derivative of the displacement by one of the slider against the beam.
  Eigen::Vector3d along() const { return at_.tangent / at_.tangent.squaredNorm(); }
  /// What the multipliers do to the slider.
  spatial::Wrench reaction(double t, const linalg::Vector& lambda) const;
  const body::MarkerKinematics& slider() const { return slider_; }
  /// Motion of the point of the beam, its x axis along the tangent.
  spatial::MarkerMotion beam_motion() const;

  /// Of the joint's rows: residual, its partial derivative and e, the force of a unit multiplier on
  /// the slider.
  struct Row {
    double g, g_t;
    Eigen::Vector3d e;
  };
  Row row(const joints::ConstraintRow& row, double t) const;
  /// ġ of such a row.
  double rate_of(const Row& row) const;
  /// Number of shares of its rows.
  static std::size_t num_parts(const model::Joint& joint) {
    return 2 * joint.track->bodies.size() + 1;
  }
  /// Its shares. Their bodies are always the same, their marker rows are those of the nodes beside
  /// the slider; of other parts of a divided beam the shares are zero.
  /// @param number of the row among those that travel, the same in every evaluation
  void derive(const Row& row, int number, SystemRow& out) const;
  /// Adds a force on the slider, and the opposite one on the beam.
  void add_force(const Eigen::Vector3d& force, Forces& out) const;
  /// Part of g̈ without accelerations of coordinates.
  double bias(const joints::ConstraintRow& constraint, double t) const;
  /// The same of the displacement along the beam.
  double coordinate_bias() const { return bias_along(along()); }

 private:
  double bias_along(const Eigen::Vector3d& e) const;
  const model::MarkerId& node(std::size_t k) const { return joint_.track->nodes[k]; }
  /// States of the row along the beam, behind those of the place; may be null.
  const double* drive() const { return states_ == nullptr ? nullptr : states_ + 2; }

  const model::Model& model_;
  const model::Joint& joint_;
  const std::vector<BodyMotion>& motions_;
  const double* states_;
  body::MarkerKinematics slider_;
  joints::TrackPoint at_;
};

/// The joint of a coordinate if it is a slider on a beam, else null. Ropes have no joint.
const model::Joint* slider_of(const model::Model& model, const model::Coordinate& coordinate);

/// All markers of a load. The first of a law on a slider's coordinate is a point of the beam.
///
/// Room for the markers behind the second is handed on from one object to the next, so that steps
/// allocate nothing.
struct LoadEnds {
  LoadEnds() = default;
  LoadEnds(LoadEnds&&) = default;
  LoadEnds(const LoadEnds&) = delete;
  LoadEnds& operator=(const LoadEnds&) = delete;
  LoadEnds& operator=(LoadEnds&&) = delete;
  ~LoadEnds();
  /// Takes room that another object has left.
  void take_room();

  std::optional<Travel> travel;  ///< of a law on a slider's coordinate
  body::MarkerKinematics first, second;
  std::vector<body::MarkerKinematics> others;  ///< one per Load::others
  std::vector<spatial::MarkerMotion> other_motions;
  const Travel* travels() const { return travel ? &*travel : nullptr; }
};
LoadEnds ends_of(const model::Model& model, const model::Load& load,
                 const std::vector<BodyMotion>& motions, const model::RowMemory* memory);

/// Derivatives of a scalar between the first two markers of a load.
/// @param J by their twists; along a beam only its part of the slider's velocity counts
/// @param out shares of another row, whose room is used
void row_of(const model::Model& model, const model::Load& load, const LoadEnds& ends,
            const spatial::PairRow& J, SystemRow& out);

/// Ends of loads one after the other. Loads of the same two markers that follow each other share
/// them, as the many places of two shapes that touch.
class EndsInTurn {
 public:
  /// All arguments must outlive this object.
  EndsInTurn(const model::Model& model, const std::vector<BodyMotion>& motions,
             const model::RowMemory* memory)
      : model_(model), motions_(motions), memory_(memory) {}
  /// Good until the next call.
  const LoadEnds& of(const model::Load& load);

 private:
  bool are_of(const model::Load& load) const;

  const model::Model& model_;
  const std::vector<BodyMotion>& motions_;
  const model::RowMemory* memory_;
  const model::Load* last_ = nullptr;
  std::optional<LoadEnds> ends_;
};

/// All that a load may see. @param load index into Model::loads, @param ends its markers, to
/// outlive what is returned
loads::Sight sight_of(const model::Model& model, std::size_t load, double t,
                      const Circumstances& around, const LoadEnds& ends);
/// The effect of one load on its first two markers. @param load index into Model::loads
loads::Action action_of(const model::Model& model, std::size_t load, double t,
                        const Circumstances& around, const LoadEnds& ends);
/// What it does to those behind them. @param wrenches one per Load::others
void add_to_others(const model::Model& model, std::size_t load, double t,
                   const Circumstances& around, const LoadEnds& ends,
                   std::span<spatial::Wrench> wrenches);

/// Motion of a joint coordinate of any joint. @param t of these motions
loads::CoordinateMotion coordinate_motion(const model::Model& model, std::size_t coordinate,
                                          double t, const model::RowMemory* memory,
                                          const std::vector<BodyMotion>& motions);

}  // namespace buckens::dynamics

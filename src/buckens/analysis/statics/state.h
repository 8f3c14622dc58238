// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/analysis/statics/system.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Static responses K⁺ of all flexible bodies of a model that outlives this object.
struct Compliances {
  std::vector<std::unique_ptr<ElasticCompliance>> owned;
  std::vector<const ElasticCompliance*> of_body;  ///< one per body, null for rigid ones

  explicit Compliances(const model::Model& model);
};

/// Unknowns of the static problem at a state, multipliers zero, load factor one, rows closed where
/// they touch.
StaticPoint static_point(const model::Model& model, const RestRows& rest,
                         const model::State& state);

/// The state at rest in a configuration: poses, nodal variables d = K⁺f, multipliers, and the
/// stands of RestRows in its memory.
/// @param state keeps its time
void set_static_state(const StaticPoint& point, const RestRows& rest, const StaticBalance& balance,
                      const Compliances& compliances, model::State& state);

/// Largest rotation of a node in the body frame [rad]; zero for rigid bodies or without rotations.
double largest_nodal_rotation(const body::Body& body, const linalg::Vector& d);

/// Nodal rotation beyond which linear elasticity in one frame is doubtful [rad].
inline constexpr double kLargestNodalRotation = 0.1;

/// Fraction of the model's length (of 1 rad) to which joints close in a configuration: kClosed, or
/// rounding far from the origin.
double closed_share(const model::Model& model, const StaticPoint& point);

/// Force in the springs of a model due to rounding of positions [N].
double spring_rounding(const model::Model& model, const std::vector<dynamics::BodyMotion>& motions);

/// Largest single force that acts in a configuration [N]: weights, loads, joints, rows at rest;
/// torques count divided by the model's length.
double strongest_load(const model::Model& model, const RestRows& rest, const StaticPoint& point,
                      double t);

}  // namespace buckens::analysis

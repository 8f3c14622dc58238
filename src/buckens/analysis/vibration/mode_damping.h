// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/vibration/vibration.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Share of critical damping that a vibration of the assembled system has in a run:
///
///     ζ = φᵀCφ / (2ω φᵀMφ)
///
/// C as it acts: that of meshes on deformation in the body frame, and dampers and bushings. What C
/// couples of different vibrations is left out; right to the order ζ where frequencies lie apart.
/// @param vibration of the system, about `position`
/// @return 0 where ω is
double damping_ratio(const model::Model& model, const model::State& position,
                     const Vibration& vibration);

/// Whether anything in a model damps vibrations.
bool has_damping(const model::Model& model, const model::State& position);

/// What a vibration has of the damping ratio that the model file asks for.
struct ModeDamping {
  double frequency = 0;         ///< [Hz]
  double ratio = 0;             ///< achieved
  std::string body;             ///< with most of the elastic energy; "joints and loads"
  double share = 0;             ///< of this body in the elastic energy
  std::optional<double> asked;  ///< where the body has a `ratio` that covers this frequency
};

/// The lowest vibrations of the system as assembled, with damping.
struct ModeDampingReport {
  std::vector<ModeDamping> modes;  ///< frequency ascending; empty: nothing is damped
  std::vector<std::string> notes;  ///< where they have much more or less than what is asked for
};

/// @throws nothing but what is no matter of vibrations: where they cannot be had a note says why
ModeDampingReport report_mode_damping(const model::BuiltModel& built,
                                      const model::State& assembled);

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/vibration/vibration.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Fraction of critical damping of a vibration of the assembled system in a run:
///
///     ζ = φᵀCφ / (2ω φᵀMφ)
///
/// C as it acts: that of meshes on deformation in the body frame, and dampers and bushings.
/// Coupling of vibrations by C is neglected; correct to order ζ if frequencies are well apart.
/// @param vibration of the system, about `position`
/// @return 0 if ω is 0
double damping_ratio(const model::Model& model, const model::State& position,
                     const Vibration& vibration);

/// Whether anything in a model damps vibrations.
bool has_damping(const model::Model& model, const model::State& position);

/// Damping of a vibration compared with the ratio requested in the model file.
struct ModeDamping {
  double frequency = 0;         ///< [Hz]
  double ratio = 0;             ///< achieved
  std::string body;             ///< with most of the elastic energy; or "joints and loads"
  double share = 0;             ///< share of this body in the elastic energy
  std::optional<double> asked;  ///< if the body has a `ratio` that covers this frequency
};

/// The lowest vibrations of the system as assembled, with damping.
struct ModeDampingReport {
  std::vector<ModeDamping> modes;  ///< frequency ascending; empty: nothing is damped
  std::vector<std::string> notes;  ///< if they have much more or less than requested
};

/// @throws nothing related to vibrations: if they cannot be computed, a note says why
ModeDampingReport report_mode_damping(const model::BuiltModel& built,
                                      const model::State& assembled);

}  // namespace buckens::analysis

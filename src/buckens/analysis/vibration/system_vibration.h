// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/analysis/vibration/vibration.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Position about which a system vibrates.
enum class RestPosition {
  /// As assembled: without loads, springs have their stiffness, joints no forces.
  initial,
  /// Static equilibrium under gravity and loads, including their change with the motion.
  static_equilibrium
};

constexpr std::array<const char*, 2> choice_names(RestPosition) { return {"initial", "static"}; }

struct SystemVibrationSettings {
  int count = 10;
  RestPosition about = RestPosition::initial;
  double tolerance = 1e-9;  ///< as body::FreeModesSettings::tolerance
};

/// Undamped vibrations of the assembled system: full meshes, joints included, with effective
/// masses and the shares of the bodies in the potential energy. Motions without resistance
/// (mechanisms, free bodies) are counted separately. Theory: docs/theory/04-free-vibration.md §5.
/// @throws ModelError if the system cannot be assembled or has no equilibrium
/// @throws NumericalError if the iteration does not converge
VibrationReport system_vibrations(const model::BuiltModel& built,
                                  const SystemVibrationSettings& settings);

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/body/free_modes.h"
#include "buckens/model/model.h"

namespace buckens::analysis {

/// Elastic vibrations of a flexible body that joints and loads excite [rad/s].
struct ExcitedBand {
  double first = 0;  ///< lowest of all elastic vibrations, excited or not
  double highest = 0;
  std::vector<double> excited;  ///< ascending
};

/// Number of free vibrations in a report and used by excited_band().
inline constexpr int kReportedModes = 10;

/// The lowest free vibrations of a body of the model file, of its undivided mesh; none if rigid. A
/// reduced body has those of its basis, a quasi-static one those its mesh would have. Cost: one
/// dense eigenproblem up to 600 DOF, a factorisation of its own above.
body::FreeModes reported_modes(const model::Model& model, const model::WholeBody& whole);

/// From the ten lowest free vibrations: a mode counts as excited if it gives more than 1 % of the
/// compliance against forces that these modes have at the interface. Zero for bodies without
/// interface.
ExcitedBand excited_band(const body::Body& body);
/// The same of a divided body, with its undivided mesh and the nodes that joints and loads use.
ExcitedBand excited_band(const model::Model& model, const model::WholeBody& whole);
/// The same of any body where its reported_modes() are known already.
ExcitedBand excited_band(const model::Model& model, const model::WholeBody& whole,
                         const body::FreeModes& modes);

/// Advice on a step: whether a band is resolved (twelve steps per period), damped in its upper
/// part, or not resolved at all. Empty if all is well.
///
/// Only vibrations that the records can show count, those with at least two records per period: the
/// effect of faster ones on slow motion is static, which a long step also gives.
/// @param h step [s], @param every time between records [s]
std::string judge_step(const std::string& body, const ExcitedBand& band, double h, double every);

/// A warning about a lowest free vibration above 1 MHz, which no machine part has: usually a
/// length, a density or a modulus is in the wrong unit. Empty: none.
/// @param omega [rad/s]
std::string judge_frequency(const std::string& body, double omega);

}  // namespace buckens::analysis

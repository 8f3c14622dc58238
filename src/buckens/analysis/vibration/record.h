// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/vibration/vibration.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/record_sink.h"

namespace buckens::analysis {

/// Writes vibrations to a sink like the instants of a run: record k (at "time" k) is the k-th
/// vibration of all reports in order. Channels:
///
///     modes/body              {}      number of the free body in /geometry, −1: the system
///     modes/number            {}      of the vibration in its report, from 1
///     modes/frequency         {}      [Hz]
///     modes/generalised_mass  {}      [kg]
///     modes/error             {}      bound of the relative error of ω² + μ
///     modes/effective_mass    {3}     along x, y, z [kg]; zero for free bodies
///     bodies/<body>/pose          {7}     pose of the body at rest
///     bodies/<body>/motion        {6}     rotation of its frame [rad], body axes; translation [m]
///     bodies/<body>/displacement  {N, 6}  nodal motion in body axes [m, rad]
///
/// Shapes are scaled as in Vibration.
/// @throws IoError from the sink
void record_vibrations(const model::BuiltModel& built, const std::vector<VibrationReport>& reports,
                       results::RecordSink& sink);

}  // namespace buckens::analysis

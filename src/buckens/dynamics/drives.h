// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/signals.h"

namespace buckens::dynamics {

/// Writes where the drives that follow signals are to be, and how fast, into the states of their
/// rows. Rates and accelerations of signals follow from the rates of the states of blocks and the
/// velocities of bodies. Theory: docs/theory/24-control.md §6.
/// @param around with the memory at the start of the step, @param signals at the instant
/// @param rows RowMemory::rows
void write_drives(const model::Model& model, const std::vector<BodyMotion>& motions,
                  const Circumstances& around, const SignalValues& signals, linalg::Vector& rows);

/// Evaluates the signals at t and writes the drives there into a memory, the rest of which belongs
/// to the start of the step. Nothing without drives.
/// @param signals scratch
void steer_drives(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                  const Circumstances& around, SignalValues& signals, model::RowMemory& memory);

}  // namespace buckens::dynamics

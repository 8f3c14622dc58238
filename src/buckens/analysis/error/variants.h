// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/analysis/error/sensor_curves.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/error_statement.h"

namespace buckens::analysis {

/// A model that differs from another one in one respect, to assess its effect.
struct ErrorVariant {
  results::ErrorSource source;
  model::ModelDescription description;
};

/// The variants of a model, and those that are not possible.
struct ErrorVariants {
  std::vector<ErrorVariant> variants;
  std::vector<std::string> notes;
};

/// Remeshes the parts of STEP files.
/// @param bodies names with the size of elements [m]
/// @return the same model with these meshes
using Remesh = std::function<model::ModelDescription(
    const std::vector<std::pair<std::string, double>>& bodies)>;

/// @throws InputError if a model has no sensors, so that there are no errors to state
void require_sensors(const model::ModelDescription& description);

/// Variants that show the reliability of a run, each with one thing improved:
///
///     time step  half the step; with step control an eighth of the tolerance
///     mesh       beams, blocks, round solids and plates divided twice as finely, parts of STEP
///                files with elements of two thirds; if that is too large, half as finely
///     frames     twice as many body frames on beams
///     coupling   `full`, where a body has less
///     modes      full meshes instead of reduced ones, or twice as many modes
///
/// Meshes of solids from files get the stiffness that follows from their strains (variant of the
/// source "mesh of files"). All record at the same times.
/// @param remesh null: parts of STEP files are not remeshed
/// @param run of the model, with the deformations of bodies_to_watch()
ErrorVariants error_variants(const model::BuiltModel& built, const SensorCurves& run,
                             const Remesh& remesh);

/// Bodies whose largest deformation an error statement needs: those with mesh files.
std::vector<std::string> bodies_to_watch(const model::ModelDescription& description);

}  // namespace buckens::analysis

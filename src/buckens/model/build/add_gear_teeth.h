// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/joints/meshing_specs.h"
#include "buckens/joints/placed_mesh.h"
#include "buckens/loads/elastic_gear_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers and the force law of two gears with
/// elastic teeth.
/// @param load with its name
/// @throws InputError, ModelError naming the load and its place in the file
void set_gear_teeth(const loads::ElasticGearSpec& spec, MarkerFinder& find, Load& load,
                    const SourceLocation& where);

/// Adds the flanks of rigid teeth with play, two one-sided rows in place of that of a joint.
/// @param joint with its name, type, markers and axis, and without a place in λ
/// @throws ModelError as joints::make_flank_gaps()
void add_flanks(const joints::ToothPlay& spec, const Joint& joint,
                const joints::Placement& placement, Model& model);

/// @throws ModelError naming a gear, elastic or not, whose wheels nothing else connects: gears hold
///         no centres
void require_common_carriers(const Model& model);

}  // namespace buckens::model

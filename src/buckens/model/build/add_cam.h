// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/cam_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers, the gap and the force law of a cam.
/// @param load with its name
/// @throws InputError, ModelError naming the cam and its place in the file
void set_cam(const loads::CamSpec& spec, MarkerFinder& find, Load& load,
             const SourceLocation& where);

}  // namespace buckens::model

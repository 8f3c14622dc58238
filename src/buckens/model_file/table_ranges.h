// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/spec/model_description.h"

namespace buckens::model_file {

/// Tables that refuse extrapolation must cover the simulation, or t = 0 if there is none.
/// @throws InputError at the table
void check_table_ranges(const model::ModelDescription& model);

}  // namespace buckens::model_file

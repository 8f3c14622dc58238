// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/load_spec.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// Reads the STL files that shapes of contact are made of; other loads are unchanged.
/// @throws InputError with the place of the shape if one cannot be read
void load_contact_files(loads::LoadSpec& load, const ReadContext& context);

}  // namespace buckens::model_file

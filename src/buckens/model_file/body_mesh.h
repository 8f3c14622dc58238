// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body_spec.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// Reads the file of a `mesh` or those of `matrices` and converts them to SI units; other bodies
/// are unchanged.
/// @throws InputError with the place of the file name if it cannot be read
void load_body_mesh(body::BodySpec& body, const ReadContext& context);

}  // namespace buckens::model_file

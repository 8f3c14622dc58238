// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body_spec.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// Reads the file of a `mesh` or those of `matrices` and turns them into SI units; other bodies
/// stay as they are.
/// @throws InputError with the place of the file name where it cannot be read
void load_body_mesh(body::BodySpec& body, const ReadContext& context);

}  // namespace buckens::model_file

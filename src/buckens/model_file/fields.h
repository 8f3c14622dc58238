// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/member.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// Reads a map into a spec by its field list, or the single value that abbreviates it. Unknown and
/// missing keys are errors, and so is what the spec's own rules find afterwards.
/// @throws InputError with file, line and column
void read_record(const ReadPlace& place, ReadContext& context, const base::Member& record);

}  // namespace buckens::model_file

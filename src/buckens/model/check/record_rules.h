// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/member.h"
#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// What is wrong with a record whose fields are each valid, as it stands in the model file; field
/// paths start in the record.
/// @param model what the record may refer to: everything before it in the model file
Found written_problem(const base::Member& record, const ModelDescription& model);

/// The same, and what can be said only when the description is complete: meshes read, `like`
/// resolved.
Found record_problem(const base::Member& record, const ModelDescription& model);

}  // namespace buckens::model

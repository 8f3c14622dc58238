// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/member.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// The whole description as a member, to walk through its field lists.
base::Member description_member(ModelDescription& description);
/// The same to look at only.
base::Member description_member(const ModelDescription& description);

/// The member that the field of that key fills.
/// @throws std::logic_error if the record has no such field
base::Member field_member(const base::Member& record, const char* key);

/// The kind that a load or joint holds: the alternative of its variant.
base::Member kind_member(const base::Member& entry);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::fem {

GroupMaterials::GroupMaterials() = default;
GroupMaterials::GroupMaterials(const GroupMaterials&) = default;
GroupMaterials::GroupMaterials(GroupMaterials&&) noexcept = default;
GroupMaterials& GroupMaterials::operator=(const GroupMaterials&) = default;
GroupMaterials& GroupMaterials::operator=(GroupMaterials&&) noexcept = default;
GroupMaterials::~GroupMaterials() = default;

}  // namespace buckens::fem

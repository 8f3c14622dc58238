// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/structure_spec.h"

namespace buckens::fem {

StructureSpec::StructureSpec() = default;
StructureSpec::StructureSpec(const StructureSpec&) = default;
StructureSpec::StructureSpec(StructureSpec&&) noexcept = default;
StructureSpec& StructureSpec::operator=(const StructureSpec&) = default;
StructureSpec& StructureSpec::operator=(StructureSpec&&) noexcept = default;
StructureSpec::~StructureSpec() = default;

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/material.h"
#include "buckens/fem/material_spec.h"
#include "buckens/fem/section.h"
#include "buckens/fem/section_spec.h"

namespace buckens::model {

/// @param of_body damping of the whole body; stands above that of the material
fem::Material make_material(const fem::MaterialSpec& spec,
                            const std::optional<fem::DampingSpec>& of_body);

/// @throws InputError with the place of the section in the file
fem::Section make_section(const fem::SectionSpec& spec);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/element/material.h"
#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/line/section.h"
#include "buckens/fem/line/section_spec.h"
#include "buckens/fem/line/section_taper.h"

namespace buckens::model {

/// @param of_body damping of the whole body; overrides that of the material
fem::Material make_material(const fem::MaterialSpec& spec,
                            const std::optional<fem::DampingSpec>& of_body);

/// @throws InputError with the place of the section in the file
fem::Section make_section(const fem::SectionSpec& spec);

/// Section of a tapered beam. The dimensions of a shape vary linearly from end to end; for a
/// general section its constants and stress points do.
/// @throws InputError with the place of the section at fault if one is impossible or the two have
/// different shapes
fem::SectionLaw make_taper(const fem::SectionSpec& first, const fem::SectionSpec& last);

}  // namespace buckens::model

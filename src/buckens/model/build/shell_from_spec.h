// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/shell/section.h"
#include "buckens/fem/shell/spec.h"

namespace buckens::model {

/// The section of a shell of a model file.
/// @param material of layers without one of their own
/// @param of_body damping of the whole body; overrides that of the materials
fem::ShellSection make_shell_section(const fem::ShellPropertySpec& spec,
                                     const fem::MaterialSpec& material,
                                     const std::optional<fem::DampingSpec>& of_body);

}  // namespace buckens::model

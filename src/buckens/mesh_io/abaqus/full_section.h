// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/line/section_spec.h"

namespace buckens::mesh_io {

/// A full rectangle with sides a along y and b along z, or an ellipse with these diameters.
fem::SectionSpec full_section(bool is_round, double a, double b);

}  // namespace buckens::mesh_io

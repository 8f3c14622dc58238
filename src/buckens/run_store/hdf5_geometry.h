// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/results/geometry.h"
#include "buckens/run_store/hdf5_file.h"

namespace buckens::run_store {

/// Writes the group `/geometry` of results.h5:
///
///     /geometry                        attributes gravity [m/s²], planar
///     /geometry/bodies/<body>          attributes index, kind
///         nodes [N×3], elements [E×2], radius [E×2]          body frame, m; beams and bars
///         faces [F×4], face_elements [F]       surface of solids only; fourth node −1 in triangles
///         cell_kinds [S], cell_nodes           solid elements; attribute `kinds` names the kinds
///         field_nodes [P], field_elements [S'], face_places [F×4], cell_places       fields, if
///         any marker_names [M], marker_nodes [M], marker_positions [M×3], marker_orientations
///         [M×4]
///     /geometry/joints/<joint>         attributes index, type, axis [3], bodies [2], markers [2]
///         (names; the ground is "ground", no marker is ""), positions [2×3]
/// @param in_tables bodies and joints stand in tables (hdf5_geometry_tables.h); all bodies are then
/// rigid
/// @throws IoError
void write_geometry(const Hdf5File& file, const results::Geometry& geometry,
                    bool in_tables = false);

/// Reads what write_geometry wrote. @throws IoError
results::Geometry read_geometry(const Hdf5File& file);

}  // namespace buckens::run_store

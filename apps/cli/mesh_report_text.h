// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "buckens/body/body_spec.h"
#include "buckens/fem/mesh/report.h"

namespace buckens::cli {

/// A mesh and its report, for `buckens mesh-info`.
std::string mesh_report_text(const fem::ImportedMesh& mesh, const fem::MeshReport& report);
nlohmann::ordered_json mesh_report_json(const fem::ImportedMesh& mesh,
                                        const fem::MeshReport& report);

/// A note of a reader: what was done with something, how often and where.
std::string note_text(const fem::ImportNote& note);

/// The same in a few lines; empty for bodies whose mesh is no file.
struct MeshNotes {
  std::string summary;
  std::vector<std::string> complaints;  ///< probable faults, and what the body lacks
};
MeshNotes mesh_notes(const body::BodySpec& body);

}  // namespace buckens::cli

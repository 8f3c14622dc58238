// SPDX-License-Identifier: Apache-2.0
#include "cli/build.h"

#include <filesystem>
#include <utility>

#include "cli/mesh_report_text.h"

#include "buckens/analysis/simulation/choose_modes.h"
#include "buckens/base/log.h"
#include "buckens/model_file/model_file.h"
#include "buckens/run_store/basis_files.h"

namespace buckens::cli {

std::unique_ptr<model::BuiltModel> build(model::ModelDescription description,
                                         std::vector<std::string>* meshes) {
  std::vector<std::string> notes;
  analysis::choose_modes(description, notes,
                         [](const std::string& text) { base::log(base::LogLevel::info, text); });
  for (const body::BodySpec& body : description.bodies) {
    const MeshNotes of_mesh = mesh_notes(body);
    if (!of_mesh.summary.empty() && meshes != nullptr) meshes->push_back(of_mesh.summary);
    if (!of_mesh.summary.empty() && meshes == nullptr) {
      base::log(base::LogLevel::info, of_mesh.summary);
    }
    notes.insert(notes.end(), of_mesh.complaints.begin(), of_mesh.complaints.end());
  }
  run_store::BasisFiles bases(description.directory);
  auto built = model::build_model(std::move(description), &bases);
  built->model.notes.insert(built->model.notes.end(), notes.begin(), notes.end());
  return built;
}

std::unique_ptr<model::BuiltModel> read_and_build(const std::string& model,
                                                  const std::vector<std::string>& overrides,
                                                  std::vector<std::string>* meshes) {
  return build(model_file::read_model_file(model, overrides), meshes);
}

}  // namespace buckens::cli

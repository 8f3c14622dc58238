// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/body_mesh.h"

#include <algorithm>
#include <memory>

#include "buckens/base/errors.h"
#include "buckens/fem/node_number.h"
#include "buckens/io/mesh_file.h"
#include "buckens/io/step_mesh.h"

namespace buckens::io {

namespace {

/// Files of other programs are found from the directory of the model file.
std::filesystem::path full_path(const std::string& name, const ReadContext& context) {
  return context.directory / name;
}

const fem::ImportedMesh* imported_mesh(const body::BodySpec& body) {
  if (const auto* mesh = std::get_if<fem::MeshSpec>(&body.kind)) return mesh->imported.get();
  if (const auto* part = std::get_if<fem::GeometrySpec>(&body.kind)) return part->imported.get();
  return nullptr;
}

void load_geometry(fem::GeometrySpec& part, const ReadContext& context) {
  try {
    part.imported = std::make_shared<const fem::ImportedMesh>(
        mesh_step(full_path(part.step, context), part));
  } catch (const IoError& error) {
    throw InputError(part.where, error.what());
  }
}

}  // namespace

void load_body_mesh(body::BodySpec& body, const ReadContext& context) {
  if (auto* part = std::get_if<fem::GeometrySpec>(&body.kind)) {
    if (!part->imported) load_geometry(*part, context);
    return;
  }
  auto* mesh = std::get_if<fem::MeshSpec>(&body.kind);
  if (mesh == nullptr || !mesh->is_file() || mesh->imported) return;
  const auto& source = std::get<fem::MeshFileSpec>(mesh->shape);
  try {
    fem::ImportedMesh read = read_mesh_file(full_path(source.path, context));
    mesh->imported = std::make_shared<const fem::ImportedMesh>(fem::in_si(
        std::move(read), fem::size_of(mesh->unit_of_length()), fem::size_of(mesh->unit_of_mass())));
  } catch (const IoError& error) {
    throw InputError(source.where, error.what());
  }
}

bool is_numbered_node(const body::BodySpec& body, const std::string& name) {
  const fem::ImportedMesh* mesh = imported_mesh(body);
  const auto number = fem::node_number(name);
  if (mesh == nullptr || !number) return false;
  return std::find(mesh->node_ids.begin(), mesh->node_ids.end(), *number) != mesh->node_ids.end();
}

}  // namespace buckens::io

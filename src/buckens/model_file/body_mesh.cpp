// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/body_mesh.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/matrix/body.h"
#include "buckens/mesh_io/mesh_file.h"
#include "buckens/model_file/step_mesh_cache.h"

namespace buckens::model_file {

namespace {

/// Files of other programs are found from the directory of the model file.
std::filesystem::path full_path(const std::string& name, const ReadContext& context) {
  return context.directory / name;
}

/// Key of the file of matrices or nodes that an error is about, as in a path: ".mass".
std::string key_of(const fem::MatricesSpec& matrices, const std::string& file,
                   const ReadContext& context) {
  for (const auto& [key, name] :
       {std::pair(".mass", &matrices.mass), std::pair(".stiffness", &matrices.stiffness),
        std::pair(".damping", &matrices.damping), std::pair(".nodes", &matrices.nodes)}) {
    if (!name->empty() && full_path(*name, context).string() == file) return key;
  }
  return "";
}

void load_matrices(fem::MatricesSpec& matrices, const std::string& body,
                   const ReadContext& context) {
  if (matrices.imported) return;
  try {
    matrices.imported = mesh_io::read_body_matrices(matrices, context.directory);
  } catch (const IoError& error) {
    throw InputError(matrices.where, error.what());
  } catch (const InputError& error) {
    throw InputError(error.where(),
                     fmt::format("bodies.{}.matrices{}: {}", body,
                                 key_of(matrices, error.where().file, context), error.text()));
  }
}

void load_geometry(fem::GeometrySpec& part, const ReadContext& context) {
  try {
    StepMeshCache only_here;
    StepMeshCache& meshes = context.step_meshes != nullptr ? *context.step_meshes : only_here;
    part.imported = meshes.mesh(full_path(part.step, context), part);
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
  if (auto* matrices = std::get_if<fem::MatricesSpec>(&body.kind)) {
    return load_matrices(*matrices, body.name, context);
  }
  auto* mesh = std::get_if<fem::MeshSpec>(&body.kind);
  if (mesh == nullptr || !mesh->is_file() || mesh->imported) return;
  const auto& source = std::get<fem::MeshFileSpec>(mesh->shape);
  try {
    fem::MeshWishes wishes{{}, mesh->skip, mesh->only};
    for (const fem::GroupSectionSpec& section : mesh->sections) {
      wishes.members.push_back(section.name);
    }
    fem::ImportedMesh read = mesh_io::read_mesh_file(full_path(source.path, context), wishes);
    mesh->imported = std::make_shared<const fem::ImportedMesh>(fem::in_si(
        std::move(read), fem::size_of(mesh->unit_of_length()), fem::size_of(mesh->unit_of_mass())));
  } catch (const IoError& error) {
    throw InputError(source.where, error.what());
  } catch (const InputError& error) {
    if (error.where().line > 0) throw;  // a place in the mesh file says more
    throw InputError(source.where, error.what());
  }
}

}  // namespace buckens::model_file

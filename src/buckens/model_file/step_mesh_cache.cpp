// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/step_mesh_cache.h"

#include <algorithm>
#include <functional>

#include "buckens/files/text_file.h"

namespace buckens::model_file {

std::shared_ptr<const fem::ImportedMesh> StepMeshCache::mesh(const std::filesystem::path& path,
                                                             fem::GeometrySpec& spec) {
  const std::string text = files::read_text_file(path, "STEP file");
  Entry wanted{path.string(), text.size(), std::hash<std::string>{}(text), spec.size, spec.order,
               spec.solid,    nullptr};
  const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.file == wanted.file && entry.length == wanted.length &&
           entry.hash == wanted.hash && entry.size == wanted.size && entry.order == wanted.order &&
           entry.solid == wanted.solid;
  });
  if (known != entries_.end()) {
    wanted.part = known->part;
    entries_.erase(known);
  } else {
    wanted.part = std::make_shared<const mesh_io::StepMesh>(
        mesh_io::mesh_step(path, text, {spec.size, spec.order, spec.solid}));
    ++num_meshed_;
  }
  entries_.push_front(wanted);
  if (entries_.size() > kKept) entries_.pop_back();
  if (!spec.size) spec.size = wanted.part->size;
  if (spec.faces.empty()) return {wanted.part, &wanted.part->mesh};
  return std::make_shared<const fem::ImportedMesh>(
      mesh_io::with_face_names(*wanted.part, spec.faces));
}

}  // namespace buckens::model_file

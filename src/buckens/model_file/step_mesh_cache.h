// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/mesh_io/step/mesh.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model_file {

/// Recently made meshes of STEP files. Bodies of one part, and variants of a model
/// that differ elsewhere, are meshed once; they share the mesh itself if they name no
/// faces.
///
/// The last kKept meshes are kept. A mesh is reused if the file has the same name and contents, and
/// solid, size and order are the same.
class StepMeshCache {
 public:
  static constexpr std::size_t kKept = 4;

  /// @param spec its size is set to the chosen one if it has none
  /// @throws as mesh_step() and with_face_names()
  std::shared_ptr<const fem::ImportedMesh> mesh(const std::filesystem::path& path,
                                                fem::GeometrySpec& spec);
  /// How often a part was actually meshed.
  int num_meshed() const { return num_meshed_; }

 private:
  struct Entry {
    std::string file;
    std::size_t length, hash;  // of the contents
    std::optional<double> size;
    int order;
    std::string solid;
    std::shared_ptr<const mesh_io::StepMesh> part;
  };

  std::deque<Entry> entries_;  // the newest first
  int num_meshed_ = 0;
};

/// read_model_file() of model_file.h with meshes from a cache.
model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides,
                                        StepMeshCache& meshes);
/// The same of read_model_text().
model::ModelDescription read_model_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides,
                                        StepMeshCache& meshes);

}  // namespace buckens::model_file

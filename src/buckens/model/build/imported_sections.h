// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::model {

/// The shells and lines of a mesh file whose section comes from the model file. In order of
/// precedence: `sections` by the name of an element set (the last one wins), then by that of the
/// property; `section` where the file gives none.
class ImportedSections {
 public:
  /// @throws InputError if a name in `sections` is neither a property nor an element set, or has
  /// no elements to which the section fits
  ImportedSections(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given);

  /// Null where the file's own section applies, if there is one.
  /// @param element index through all blocks
  const fem::GroupSectionSpec* of(int element) const {
    return chosen_.empty() ? nullptr : chosen_.at(static_cast<std::size_t>(element));
  }

 private:
  void choose_for_all(const fem::GroupSectionSpec& section);
  void choose_by_property(const fem::GroupSectionSpec& section);
  void choose_by_set(const fem::GroupSectionSpec& section);
  void check(const fem::GroupSectionSpec& section) const;

  const fem::ImportedMesh& mesh_;
  std::vector<const fem::ImportedBlock*> blocks_;  // per element
  std::vector<const fem::GroupSectionSpec*> chosen_;
};

}  // namespace buckens::model

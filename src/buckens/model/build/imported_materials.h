// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/fem/element/material.h"
#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::model {

/// The material of each element of a mesh file. In order of precedence: `materials` by the
/// name of an element set, then by that of the property, then by that of the file's material; the
/// file's own material if it has elastic constants; `material`.
///
/// Orthotropic materials of solids use the axes that the file gives the property; so do those of
/// the model file unless they have their own axes. (Shells have a direction per section.)
class ImportedMaterials {
 public:
  /// @throws InputError if a name in `materials` is not a property, element set or material of the
  /// file
  ImportedMaterials(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given,
                    const std::optional<fem::DampingSpec>& damping, const SourceLocation& where);

  /// Elements with the same number have the same material.
  /// @param element index through all blocks
  /// @throws InputError if it has none, or one without elastic constants
  int number(const fem::ImportedBlock& block, int element);
  /// The same as given in the model or mesh file, null if there is none.
  const fem::MaterialSpec* find(const fem::ImportedBlock& block, int element) const;
  /// What number() makes into a material. @throws InputError as number()
  const fem::MaterialSpec& spec(const fem::ImportedBlock& block, int element) const;
  /// Number of a material of the file, for the layers of a laminate.
  int number(const std::string& name);

  const fem::Material& material(int number) const {
    return materials_[static_cast<std::size_t>(number)];
  }

 private:
  /// What the model file or the mesh file gives for a material of the mesh file; one without
  /// elastic constants only if there is nothing else. Null if the file has none of this name.
  const fem::MaterialSpec* named(const std::string& name) const;
  [[noreturn]] void refuse(const fem::ImportedBlock& block, const std::string& what) const;
  /// Property whose axes orient the material, −1: none.
  int turning_property(const fem::ImportedBlock& block, const fem::MaterialSpec& spec) const;
  int number_of(const fem::MaterialSpec& spec, int property);

  const fem::ImportedMesh& mesh_;
  const fem::GroupMaterials& given_;
  const std::optional<fem::DampingSpec>& damping_;
  SourceLocation where_;
  std::vector<const fem::MaterialSpec*> by_set_;  // per element, null where no set names one
  /// By material and the property that orients it.
  std::map<std::pair<const fem::MaterialSpec*, int>, int> numbers_;
  std::vector<fem::Material> materials_;
};

}  // namespace buckens::model

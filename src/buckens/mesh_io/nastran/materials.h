// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/fem/element/material_spec.h"
#include "buckens/mesh_io/nastran/bulk.h"
#include "buckens/mesh_io/nastran/names.h"

namespace buckens::mesh_io {

/// The materials of a deck, taken over when something is made of them.
///
/// MAT1 becomes isotropic; MAT8 orthotropic with E3 = E2 and without contraction across, which thin
/// shells do not feel; MAT9 orthotropic if it is that in its axes, else it is refused.
class NastranMaterials {
 public:
  /// What an element can be made of.
  enum class Use { solid, shell, line };

  /// @throws InputError if two cards have one number
  NastranMaterials(const NastranBulk& bulk, const NastranNames& names, NastranNotes& notes);

  /// Name of the material with this number.
  /// @param user says what is made of it
  /// @throws InputError if it is missing or cannot be used for that
  std::string name(std::int64_t id, Use use, const std::string& user, const NastranPlace& place);
  /// Whether directions matter in it; false if it is missing.
  bool has_directions(std::int64_t id) const;

  /// Those taken over, densities times PARAM,WTMASS.
  std::vector<fem::MaterialSpec> take() { return std::move(specs_); }

 private:
  fem::MaterialSpec convert(const NastranCard& card);
  std::string unique_name(const NastranCard& card);

  std::unordered_map<std::int64_t, const NastranCard*> cards_;
  std::unordered_map<std::int64_t, std::size_t> taken_;
  std::vector<fem::MaterialSpec> specs_;
  std::set<std::string> used_names_;
  const NastranNames* names_;
  NastranNotes* notes_;
  double weight_to_mass_ = 1;
};

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "buckens/fem/element/material_spec.h"
#include "buckens/mesh_io/nastran/bulk.h"
#include "buckens/mesh_io/nastran/names.h"

namespace buckens::mesh_io {

/// The materials of a deck, imported when used.
///
/// MAT1 becomes isotropic. Solids and shells have the G of its E and NU, as in Nastran; where that
/// of the deck differs, beams use it in a separate material. MAT8 becomes orthotropic with E3 = E2
/// and without transverse contraction, which does not affect thin shells; so does MAT2 if it is
/// orthotropic in its axes, and MAT9 for solids, in any axes. Others are left to the model file.
class NastranMaterials {
 public:
  /// What a material is used for.
  enum class Use { solid, shell, beam, bar };

  /// @throws InputError if two cards have the same number
  NastranMaterials(const NastranBulk& bulk, const NastranNames& names, NastranNotes& notes);

  bool has(std::int64_t id) const { return cards_.contains(id); }
  /// Why the material with this number cannot be used for this, "" if it can.
  /// @param user says what is made of it
  std::string lack(std::int64_t id, Use use, const std::string& user) const;
  /// Name of the material with this number.
  /// @throws InputError if it is missing or cannot be used for this
  std::string name(std::int64_t id, Use use, const std::string& user, const NastranPlace& place);
  /// Whether it depends on direction; false if it is missing.
  bool has_directions(std::int64_t id) const;

  /// Whether the planes of symmetry of an imported material are not those of its axes.
  bool is_turned(const std::string& name) const;

  /// Imported materials, densities times PARAM,WTMASS.
  std::vector<fem::MaterialSpec> take() { return std::move(specs_); }

 private:
  fem::MaterialSpec convert(const NastranCard& card, Use use);
  void set_moduli(const NastranCard& card, Use use, fem::MaterialSpec& out);
  std::string unique_name(const NastranCard& card);
  static bool is_turned(const fem::MaterialSpec& material);

  std::unordered_map<std::int64_t, const NastranCard*> cards_;
  /// One card may become several materials.
  enum class Variant { usual, own_G, without_nu };
  Variant variant(const NastranCard& card, Use use) const;
  std::map<std::pair<std::int64_t, Variant>, std::size_t> taken_;
  std::vector<fem::MaterialSpec> specs_;
  std::set<std::string> used_names_;
  const NastranNames* names_;
  NastranNotes* notes_;
  double weight_to_mass_ = 1;
};

}  // namespace buckens::mesh_io

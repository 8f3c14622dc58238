// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/field_quantity_note.h"

#include <algorithm>

namespace buckens::results {

using model::FieldQuantity;

bool is_motion(FieldQuantity quantity) { return quantity <= FieldQuantity::acceleration; }

bool has_tensors(const std::vector<FieldQuantity>& quantities) {
  return !std::all_of(quantities.begin(), quantities.end(), is_motion);
}

QuantityNote note_of(FieldQuantity quantity) {
  const std::vector<std::string> xyz = {"x", "y", "z"};
  const std::vector<std::string> tensor = {"xx", "yy", "zz", "xy", "yz", "zx"};
  switch (quantity) {
    case FieldQuantity::displacement:
      return {"displacement", "m", "from the undeformed place, body axes", xyz};
    case FieldQuantity::velocity:
      return {"velocity", "m/s", "in the world, world axes", xyz};
    case FieldQuantity::acceleration:
      return {"acceleration", "m/s^2", "in the world, world axes", xyz};
    case FieldQuantity::stress:
      return {"stress", "Pa", "body axes", tensor};
    case FieldQuantity::strain:
      return {"strain", "1", "body axes, shear strains as twice the tensor's", tensor};
    case FieldQuantity::von_mises:
      return {"von_mises", "Pa", "equivalent stress", {}};
    case FieldQuantity::principal_stress:
      return {"principal_stress", "Pa", "falling", {"1", "2", "3"}};
    case FieldQuantity::strain_energy_density:
    case FieldQuantity::interface_load:  // none of a mesh
      break;
  }
  return {"strain_energy_density", "J/m^3", "half of stress times strain", {}};
}

int volume_elements(const fem::FeModel& mesh) {
  int count = 0;
  for (const auto& block : mesh.blocks) {
    if (block->is_solid()) count += block->num_elements();
  }
  return count;
}

}  // namespace buckens::results

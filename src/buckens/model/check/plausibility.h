// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// A value that is possible but probably not intended, usually because a unit was left out.
struct Doubt {
  std::string path;      ///< of the field: "materials.steel.E"
  SourceLocation where;  ///< of the entry that holds it
  std::string text;      ///< "0.21 MPa is below what solids have (1 MPa to 2 TPa)"
  /// What was probably meant, only used if no unit was written: "210000 MPa"; may be
  /// empty.
  std::string likely;
  bool only_without_unit = false;  ///< not doubted if a unit was written
};

/// Checks all numbers of a description: moduli outside of 1 MPa to 2 TPa,
/// densities outside 10 to 25 000 kg/m³, angles above one turn, frequencies above 1 MHz, bodies
/// larger than 100 m or smaller than 10 µm, elements larger than their part.
std::vector<Doubt> doubtful_values(const ModelDescription& description);

}  // namespace buckens::model

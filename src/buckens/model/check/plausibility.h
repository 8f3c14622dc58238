// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// A value that is possible but hardly meant, most often by a unit that was left out.
struct Doubt {
  std::string path;      ///< of the field: "materials.steel.E"
  SourceLocation where;  ///< of the entry that holds it
  std::string text;      ///< "0.21 MPa is below what solids have (1 MPa to 2 TPa)"
  /// What was probably meant, to be said only where no unit was written: "210000 MPa"; may be
  /// empty.
  std::string likely;
  bool only_without_unit = false;  ///< no doubt where a unit was written
};

/// Looks over everything that a description says in numbers: moduli outside of 1 MPa to 2 TPa,
/// densities outside of 10 to 25 000 kg/m³, angles above a turn, frequencies above 1 MHz, bodies
/// larger than 100 m or smaller than 10 µm, elements larger than their part.
std::vector<Doubt> doubtful_values(const ModelDescription& description);

}  // namespace buckens::model

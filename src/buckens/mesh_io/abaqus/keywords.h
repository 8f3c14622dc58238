// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::mesh_io {

/// What a keyword that no card reads means for a body.
enum class KeywordRole {
  silent,      ///< nothing to report
  elsewhere,   ///< loads, supports and initial values: belong in the model file
  weightless,  ///< neither mass nor stiffness of a linear elastic body: contact, heat, output …
  nonlinear,   ///< material behaviour beyond linear elasticity
  periodic,    ///< the deck is one sector of a repeated structure
  holding,     ///< mass, stiffness or a connection: refused unless skipped
  unknown,
};

/// @param name in capitals, without star and blanks
KeywordRole role_of_keyword(const std::string& name);

}  // namespace buckens::mesh_io

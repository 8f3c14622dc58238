// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::mesh_io {

/// What a keyword that no card reads is to a body.
enum class KeywordRole {
  silent,      ///< nothing to say of it
  elsewhere,   ///< loads, supports and initial values: the model file has them
  weightless,  ///< neither mass nor stiffness of a linear elastic body: contact, heat, output …
  nonlinear,   ///< what a material does beyond linear elasticity
  periodic,    ///< the deck is a sector or a part of what is repeated
  holding,     ///< mass, stiffness or a connection: refused unless the model file leaves it out
  unknown,
};

/// @param name in capitals, without star and blanks
KeywordRole role_of_keyword(const std::string& name);

}  // namespace buckens::mesh_io

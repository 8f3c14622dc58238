// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/contact_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers and the force law of a contact.
/// @param load with its name
/// @return further loads of the same name, to stand behind it: of a rigid contact the rows of its
///         friction and of other places where it touches
/// @throws InputError, ModelError naming the contact and its place in the file
std::vector<Load> set_contact(const loads::ContactSpec& spec, MarkerFinder& find, Load& load,
                              const SourceLocation& where);

}  // namespace buckens::model

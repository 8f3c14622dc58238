// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/contact_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Adds a group of bodies that touch each other to the model under construction, and makes a load
/// its place among the loads.
/// @param load with its name, to be added next
/// @throws InputError, ModelError naming the load and its place in the file
void set_contacts(const loads::ContactsSpec& spec, MarkerFinder& find, Load& load,
                  const SourceLocation& where);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/loads/contact_pair.h"
#include "buckens/loads/contact_shape_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// A shape on a marker, in a planar model its section.
/// @param what "load "name"", for messages
/// @throws InputError if a planar model cannot have it that way
loads::ContactShape contact_shape(const loads::ShapeSpec& spec, MarkerFinder& find,
                                  const MarkerId& marker, const std::string& what,
                                  const SourceLocation& where);

}  // namespace buckens::model

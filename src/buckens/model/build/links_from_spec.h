// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "buckens/base/source_location.h"
#include "buckens/fem/constraint/link_spec.h"
#include "buckens/fem/structure.h"

namespace buckens::model {

/// Finds a node by its name.
using NodeFinder = std::function<int(const std::string& name, const SourceLocation& where)>;

/// Adds the links and springs of a structure. Messages cite their lines.
void add_links(const fem::StructureLinksSpec& spec, const NodeFinder& node,
               fem::Structure& structure);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/marker_ref.h"
#include "buckens/base/name_index.h"
#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> out;
  for (const T& entry : list) out.push_back(entry.name);
  return out;
}

/// Names that may follow the slash after a body.
std::vector<std::string> marker_names(const body::BodySpec& body);

/// Whether a name denotes a node of the body's mesh file: `n` and its number there.
bool is_numbered_node(const body::BodySpec& body, const std::string& name);

/// The reference as written, also if made by a program.
std::string text_of(const base::MarkerRef& marker);

/// Whether the named body or marker does not exist.
/// @param bodies index of those of the model
Found marker_problem(const base::MarkerRef& marker, const ModelDescription& model,
                     base::NameIndex& bodies);

/// Markers and interfaces of a body whose names are already in use, and markers at places that the
/// body does not have. The mesh must have been read.
Found names_problem(const body::BodySpec& body);

}  // namespace buckens::model

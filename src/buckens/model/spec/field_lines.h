// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::model {

/// What a model says, one line per value: "bodies.rod.beam.elements: 16". Numbers to the last bit,
/// names and orders as in the model file; title, duration and places in files are left out. Laws of
/// time are told by their text and by their values at a few instants of the run.
///
/// For telling two models apart, and saying where they differ.
std::vector<std::string> field_lines(const ModelDescription& description);

/// What a model came to, one line per body: variables, rows and mass. It shows what a description
/// does not: other content of a mesh file.
std::vector<std::string> built_lines(const Model& model);

}  // namespace buckens::model

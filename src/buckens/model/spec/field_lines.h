// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::model {

/// The contents of a model, one line per value: "bodies.rod.beam.elements: 16". Numbers to the last
/// bit, names and order as in the model file; title, duration,
/// checkpoints, places in files and the directory of files (`base`) are left out.
/// Laws of time are given by their text and their values at a few instants of the run.
///
/// For detecting whether and where two models differ.
std::vector<std::string> field_lines(const ModelDescription& description);

/// What was built from a model, one line per body: variables, rows and mass. It shows what a
/// description does not: changed contents of a mesh file.
std::vector<std::string> built_lines(const Model& model);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::model_file {

/// Reads a model file (YAML or JSON) and checks everything that can be checked without building the
/// model. Numbers are SI afterwards, names are resolved. Reference: docs/reference/model-file.md.
///
/// @param overrides "PATH=VALUE" each, applied before reading: "bodies.rod.beam.elements=8"
/// @throws IoError if the file (or a table it names) cannot be read
/// @throws InputError with file:line:column, the path of the key, the value and a remedy
model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides = {});

/// The same from a text; `name` denotes the file in messages, and tables are looked up in its
/// directory.
model::ModelDescription read_model_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides = {});

/// JSON Schema (draft 2020-12) of model files, for editors.
std::string model_schema_json();

/// Reference page of the model file in Markdown.
std::string model_reference_markdown();

}  // namespace buckens::model_file

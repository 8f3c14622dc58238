// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "buckens/fem/assembly/body_matrices.h"
#include "buckens/fem/assembly/matrices_spec.h"

namespace buckens::mesh_io {

/// Reads the matrices and the table of nodes named in a model file, in SI units.
/// @param directory for relative file names
/// @throws InputError with file and line, IoError if a file cannot be read
std::shared_ptr<const fem::BodyMatrices> read_body_matrices(const fem::MatricesSpec& spec,
                                                            const std::filesystem::path& directory);

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::cli {

/// A mesh file, or a STEP file to be meshed, and its units from the command line.
struct MeshArguments {
  std::string file;
  std::string length_unit, mass_unit;  ///< empty: not given
  std::string size;                    ///< of elements, for STEP files; empty: chosen
  std::string solid;                   ///< of a STEP file; empty: all
  int order = 2;
  std::vector<std::string> only, skip;  ///< see fem::MeshWishes

  fem::LengthUnit unit_of_length() const;
  fem::MassUnit unit_of_mass() const;
  /// In units of the file.
  /// @throws InputError
  fem::ImportedMesh read() const;
  bool is_step() const;
};

void add_mesh_options(CLI::App& verb, MeshArguments& arguments);

}  // namespace buckens::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace buckens::mesh_io {

/// Names of faces in a STEP file, and a copy of the file in which colours represent them.
///
/// OpenCASCADE passes colours of faces to Gmsh, but not their names. So every named face gets a
/// unique colour in the copy; the shapes and their order stay the same.
struct ColoredStep {
  std::vector<std::string> names;  ///< each once
  std::string text;                ///< of the copy; empty if no face has a name
};

/// @param step contents of a STEP file (ISO 10303-21)
ColoredStep color_named_faces(const std::string& step);

/// Index of the name represented by a colour of the copy, from linear values 0 … 255 as returned by
/// OpenCASCADE; −1: none.
int name_of_color(const std::array<int, 3>& linear, std::size_t num_names);

/// What to say of a file that refers to entities that it does not contain, with number and place;
/// empty if there are none.
std::string missing_entities(const std::string& step);

/// Converts a display value 0 … 255 to linear.
double linear_color(double value);
/// The inverse, rounded.
int shown_color(int linear);

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace buckens::mesh_io {

/// Names of faces in a STEP file, and a copy of the file in which colours stand for them.
///
/// OpenCASCADE gives colours of faces to Gmsh, but not their names. So every face with a name gets
/// a colour of its own in the copy; the shapes and their order stay the same.
struct ColoredStep {
  std::vector<std::string> names;  ///< each once
  std::string text;                ///< of the copy; empty if no face has a name
};

/// @param step contents of a STEP file (ISO 10303-21)
ColoredStep color_named_faces(const std::string& step);

/// Which of the names a colour of the copy stands for, from linear values 0 … 255 as OpenCASCADE
/// gives them; −1: none.
int name_of_color(const std::array<int, 3>& linear, std::size_t num_names);

/// A value 0 … 255 as screens show it, made linear.
double linear_color(double value);
/// The way back, rounded.
int shown_color(int linear);

}  // namespace buckens::mesh_io

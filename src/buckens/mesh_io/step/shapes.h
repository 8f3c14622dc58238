// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/estimate.h"

namespace buckens::mesh_io {

/// A face of the glued part and its colour, or that of the face it is a piece of.
struct ColoredShape {
  int face = 0;
  GmshLibrary::Color color = {0, 0, 0, 0};
};

/// Result of gluing the touching solids of a STEP file.
struct GluedShapes {
  std::vector<ColoredShape> colors;  ///< a face between two solids may have two
  int lost = 0;                      ///< coloured faces of which no pieces could be found
  bool overlap = false;              ///< solids have volume in common
  std::string problem;               ///< why there is nothing to mesh; empty: there is
};

/// The last part of a name such as "Shapes/assembly/rod", or volume_<number>.
std::string label_of_solid(const GmshLibrary& gmsh, const GmshEntity& solid);

/// Loads a file into a new model and gives touching solids common faces.
///
/// The library loses the colours of faces that it cuts. Their pieces are found by position: they
/// are inside the bounding box of the face and together have its area and its centre.
///
/// @param solid name or number (by their order in the file) of the one to keep; empty: all
GluedShapes load_glued(GmshLibrary& gmsh, const char* model, const std::string& file,
                       const std::string& solid);

/// A curve that two solids have in common, which no chain of common faces connects.
struct SharedEdge {
  int curve = 0;
  std::string first, second;  ///< labels of the solids
};

std::vector<SharedEdge> edges_without_faces(const GmshLibrary& gmsh);

/// Curves where a surface is no single closed skin.
struct SurfaceFaults {
  std::vector<GmshEntity> free;     ///< curves of one face
  std::vector<GmshEntity> crowded;  ///< curves of three faces or more
  /// Walls without thickness between closed rooms: faces that share no curve with exactly one
  /// other, if the rest is closed without them.
  std::vector<GmshEntity> walls;
};

SurfaceFaults surface_faults(const GmshLibrary& gmsh);

/// Faces of the model in its unit of length.
std::vector<FaceExtent> face_extents(const GmshLibrary& gmsh);

}  // namespace buckens::mesh_io

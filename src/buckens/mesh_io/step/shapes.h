// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/estimate.h"

namespace buckens::mesh_io {

/// A face of the glued part and its colour, or that of the face it is a piece of.
struct ColoredShape {
  int face = 0;
  GmshLibrary::Color color = {0, 0, 0, 0};
};

/// What gluing the touching solids of a STEP file does to its faces.
struct GluedShapes {
  std::vector<ColoredShape> colors;  ///< a face between two solids may have two
  int lost = 0;                      ///< coloured faces of which no pieces could be found
  std::vector<std::string> labels;   ///< of the solids, before they were cut
  std::vector<double> volumes;       ///< likewise
  /// Two solids that have volume in common, for each piece of it.
  std::vector<std::pair<std::size_t, std::size_t>> overlaps;
  std::size_t num_faces = 0;  ///< of the file, before they were cut
};

/// The last part of a name such as "Shapes/assembly/rod", or volume_<number>.
std::string label_of_solid(const GmshLibrary& gmsh, const GmshEntity& solid);

/// Which solids of a file are used.
struct SolidChoice {
  std::string only;                  ///< name or number (by their order in the file); empty: all
  std::vector<std::size_t> without;  ///< of these, by place from 0: left out
};

/// Loads a file into a new model.
/// @return what is wrong; empty: nothing
std::string load_part(GmshLibrary& gmsh, const char* model, const std::string& file,
                      const SolidChoice& choice);

/// Gives touching solids common faces.
///
/// The library loses the colours of faces that it cuts. Their pieces are found by position: they
/// are inside the bounding box of the face and together have its area and its centre.
GluedShapes glue_solids(GmshLibrary& gmsh);

/// Colours of a copy of the file on the faces of the glued part: the copy is not glued itself.
/// @param glued the part, which is the present model
/// @return no colours if the copy has other faces
GluedShapes colors_of_copy(GmshLibrary& gmsh, const char* part, const GluedShapes& glued,
                           const std::string& copy, const SolidChoice& choice);

/// Of each two solids that overlap the smaller one: screws in their holes.
/// @return places of these solids, in order
std::vector<std::size_t> smaller_of_overlapping(const GluedShapes& glued);

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

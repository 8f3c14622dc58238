// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gmshc.h>

namespace buckens::mesh_io {

/// Dimension and number of an entity of a geometry.
using GmshEntity = std::pair<int, int>;

/// The library of Gmsh, loaded when it is needed: with all that hangs on it (OpenCASCADE, X11) it
/// takes ten times as long to load as this program.
///
/// Use it in a process of its own (isolated_work.h): it prints, keeps a global state, and crashes
/// on files that are broken. Functions throw IoError with the library's own words.
class GmshLibrary {
 public:
  /// @throws IoError if the library is not there
  GmshLibrary();

  void set_number(const char* option, double value);
  void set_text(const char* option, const char* value);
  /// An empty model, in which what follows happens.
  void new_model(const char* name);
  void use_model(const char* name);
  /// Solids and faces of a STEP file, with the colours and labels that it has.
  void import_shapes(const std::string& file);
  /// Cuts volumes that overlap or touch, so that they share faces.
  void fragment(const std::vector<GmshEntity>& volumes);
  /// Takes volumes away with the faces that nothing else has.
  void remove(const std::vector<GmshEntity>& volumes);
  /// Mends wires and small faces, sews faces whose edges are no farther apart than the tolerance,
  /// and makes a solid of them. All entities get new numbers.
  void heal(double tolerance);
  /// What bounds all these entities together: the curves that an odd number of faces has.
  std::vector<GmshEntity> boundary(const std::vector<GmshEntity>& entities) const;
  std::vector<GmshEntity> entities(int dimension) const;
  /// "" or a path of labels, "Shapes/rod".
  std::string name(const GmshEntity& entity) const;
  struct Color {
    int red, green, blue, alpha;
  };
  Color color(const GmshEntity& entity) const;
  /// Volume, area or length of an entity.
  double size(const GmshEntity& entity) const;
  std::array<double, 3> centre(const GmshEntity& entity) const;
  /// Least and largest x, y, z, somewhat widened.
  std::array<double, 6> box(const GmshEntity& entity) const;
  void add_group(int dimension, std::vector<int> entities, const std::string& name);
  void mesh(int dimension);
  /// Nodes in the middle of edges, on the true surface; 2 for the second order.
  void set_order(int order);
  /// Moves nodes where elements of higher order are badly shaped.
  void optimize_order();
  void write(const std::string& file);
  /// Warnings and errors so far.
  std::vector<std::string> messages() const;
  /// Where the mesher has failed, as far as it says.
  std::vector<GmshEntity> entities_at_fault() const;

 private:
  template <class Function>
  Function function(const char* name) const;
  void check(int error) const;

  void* handle_ = nullptr;
};

}  // namespace buckens::mesh_io

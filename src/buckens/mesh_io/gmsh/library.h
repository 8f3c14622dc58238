// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace buckens::mesh_io {

/// Dimension and number of an entity of a geometry.
using GmshEntity = std::pair<int, int>;

/// The library of Gmsh, loaded when needed: with its dependencies (OpenCASCADE, X11) it takes ten
/// times as long to load as this program.
///
/// Use it in a separate process (isolated_work.h): it prints, keeps a global state, and crashes on
/// broken files. Functions throw IoError with the library's own message.
class GmshLibrary {
 public:
  /// @throws IoError if the library is missing
  GmshLibrary();

  void set_number(const char* option, double value);
  void set_text(const char* option, const char* value);
  /// Starts an empty model for the following calls.
  void new_model(const char* name);
  void use_model(const char* name);
  /// Solids and faces of a STEP file, with their colours and labels.
  void import_shapes(const std::string& file);
  /// Cuts volumes that overlap or touch, so that they share faces.
  /// @return what each of them became
  std::vector<std::vector<GmshEntity>> fragment(const std::vector<GmshEntity>& volumes);
  /// Removes volumes with the faces that nothing else uses.
  void remove(const std::vector<GmshEntity>& volumes);
  /// Repairs wires and small faces, sews faces whose edges are within the tolerance, and makes a
  /// solid of them. All entities get new numbers.
  void heal(double tolerance);
  /// The boundary of all these entities together: the curves that belong to an odd number of faces.
  std::vector<GmshEntity> boundary(const std::vector<GmshEntity>& entities) const;
  /// The boundaries of entities, with what several of them share.
  std::vector<GmshEntity> boundary_of_each(const std::vector<GmshEntity>& entities) const;
  /// Makes faces anew, each as a smooth surface through the curves of one loop, and the solid with
  /// them, all under their numbers.
  /// @param shells the faces of the solid, those of the outer shell first
  /// @param points through which a face is to pass as well
  void replace_faces(const GmshEntity& solid, const std::vector<std::vector<int>>& shells,
                     const std::map<int, std::vector<int>>& loops,
                     const std::map<int, std::vector<std::array<double, 3>>>& points);
  /// Points of a face, count by count over the middle half of its parameters, without those outside
  /// its edges and those where it is folded over, its normal opposite to that of most.
  /// @param count at least 2
  std::vector<std::array<double, 3>> inner_points(int face, int count) const;
  std::vector<GmshEntity> entities(int dimension) const;
  /// "" or a path of labels, "Shapes/rod".
  std::string name(const GmshEntity& entity) const;
  struct Color {
    int red, green, blue, alpha;
  };
  Color color(const GmshEntity& entity) const;
  /// Volume, area or length of an entity.
  double size(const GmshEntity& entity) const;
  /// Of a face [1/length], at nine places of its parameters; 0 if the kernel knows none.
  double largest_curvature(int face) const;
  std::array<double, 3> centre(const GmshEntity& entity) const;
  /// Smallest and largest x, y, z, slightly enlarged.
  std::array<double, 6> box(const GmshEntity& entity) const;
  void add_group(int dimension, std::vector<int> entities, const std::string& name);
  void mesh(int dimension);
  /// Forgets the mesh, and what was said so far.
  void clear_mesh();
  /// Numbers of the nodes and x, y, z of each.
  std::pair<std::vector<std::size_t>, std::vector<double>> nodes() const;
  /// The nodes of elements of one of Gmsh's types (2: triangles, 4: tetrahedra).
  /// @param entity number of a curve, face or volume; −1: all
  std::vector<std::size_t> element_nodes(int type, int entity) const;
  /// An upper bound for sizes on an entity; empty: none. To be kept until the mesh is made.
  using SizeOf = std::function<double(int dimension, int entity)>;
  void bound_sizes(const SizeOf* size);
  /// Nodes in the middle of edges, on the true surface; 2 for the second order.
  void set_order(int order);
  /// Improves elements: "" or "Netgen" by swapping edges and moving nodes, "Relocate3D" by moving
  /// nodes, "HighOrder" those of higher order.
  void optimize(const char* way);
  void write(const std::string& file);
  /// Says on the standard output what it does.
  void be_heard();
  /// Wall seconds of the last mesh(): edges, faces, volumes.
  std::array<double, 3> mesh_seconds() const;
  /// Warnings and errors so far.
  std::vector<std::string> messages() const;
  /// Where the mesher failed, as far as it reports it.
  std::vector<GmshEntity> entities_at_fault() const;

 private:
  template <class Function>
  Function function(const char* name) const;
  void check(int error) const;
  std::vector<std::string> log() const;

  void* handle_ = nullptr;
};

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/base/marker_ref.h"
#include "buckens/body/body.h"
#include "buckens/body/body_spec.h"
#include "buckens/model/build/structure_from_spec.h"

namespace buckens::model {

/// Finds the marker for a name in the model file, and assigns points of the mesh their rows y = N
/// d. Markers requested first (by joints and loads) get the first rows.
class MarkerTable {
 public:
  /// @param mesh null for rigid bodies
  /// @param whole_com for one part of a divided body: mass centre of the whole, model axes [m]
  MarkerTable(const body::BodySpec& spec, body::Body& body, const NamedStructure* mesh,
              const std::optional<Eigen::Vector3d>& whole_com = std::nullopt);

  /// Index into Body::markers.
  /// @param needs_mesh true where a force acts: on flexible bodies the marker must lie on the mesh
  /// @throws InputError with the nearest name if there is no such marker, ModelError if a force
  /// would act away from the mesh
  int find(const base::MarkerRef& ref, bool needs_mesh);

  /// Position of the marker on the mesh; empty if it is fixed to the body frame.
  std::optional<MeshPlace> place(const base::MarkerRef& ref) const;

  /// The interface that the marker is or is at, null for all other places.
  const InterfaceRegion* interface(const std::string& marker) const;

  /// Whether the named place is on this mesh: in a divided body it may be on another part.
  bool holds(const std::string& name) const;
  /// Distance from the named place to the nearest node [m]; HUGE_VAL if the name is unknown.
  double distance(const std::string& name) const;
  /// Marker on a node at which this part was cut from others.
  int cut_marker(int node);

  /// Marker that follows the mean displacement of a part of the mesh, with the axes of the body. It
  /// is found by its name, which cannot occur in a model file ("#load NAME").
  /// @param position mean position, model axes [m]; empty: a marker at the body frame
  /// @param rows of the mean displacement over the nodal variables (0…2, DOF, value)
  int add_region(const std::string& name, const std::optional<Eigen::Vector3d>& position,
                 const std::vector<linalg::Triplet>& rows);
  /// Adds a row over the nodal variables.
  /// @param entries (0, DOF, value)
  /// @return its index
  int add_pattern(const std::vector<linalg::Triplet>& entries);

  /// All names a user can write, for messages and listings.
  std::vector<std::string> names() const;

  /// Number of rows assigned so far.
  int num_rows() const { return num_rows_; }
  /// N with all rows.
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows() const;

 private:
  struct Target {
    Eigen::Vector3d position;  // model axes
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    std::optional<MeshPlace> place;
    const InterfaceRegion* interface = nullptr;
  };
  Target target(const base::MarkerRef& ref) const;
  Target named(const std::string& name, const base::MarkerRef& ref) const;
  /// @throws InputError saying how far the marker is from the mesh
  [[noreturn]] void refuse_place(const body::MarkerSpec& marker) const;
  std::string suggestion(const std::string& name) const;
  /// "use one of: …": the places that follow the mesh, for messages.
  std::string mesh_points() const;
  std::optional<MeshPlace> find_place(const std::string& name) const;
  std::optional<MeshPlace> place_at(const Eigen::Vector3d& position) const;
  std::pair<int, int> rows_at(const MeshPlace& place);
  std::pair<int, int> rows_of(const InterfaceRegion& interface);
  std::pair<int, int> add_rows(const fem::PointRows& rows);
  int add(const std::string& name, const Target& where);
  int nearest_of(const std::vector<int>& nodes, const Eigen::Vector3d& position) const;
  void add_entries(const std::vector<linalg::Triplet>& entries, int first);

  const body::BodySpec& spec_;
  body::Body& body_;
  const NamedStructure* mesh_;
  std::optional<Eigen::Vector3d> whole_com_;
  std::map<std::string, int> found_;
  std::map<std::tuple<int, int, double>, std::pair<int, int>> rows_of_place_;
  std::map<std::string, std::pair<int, int>> rows_of_interface_;
  std::vector<linalg::Triplet> entries_;
  int num_rows_ = 0;
};

}  // namespace buckens::model

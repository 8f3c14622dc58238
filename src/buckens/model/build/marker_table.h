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

/// Finds the marker that a name in the model file means, and gives points of the mesh their rows
/// y = N d. Markers asked for first (by joints and loads) get the first rows.
class MarkerTable {
 public:
  /// @param mesh null for rigid bodies
  /// @param whole_com for one part of a divided body: mass centre of the whole, model axes [m]
  MarkerTable(const body::BodySpec& spec, body::Body& body, const NamedStructure* mesh,
              const std::optional<Eigen::Vector3d>& whole_com = std::nullopt);

  /// Index into Body::markers.
  /// @param needs_mesh true where a force acts: on flexible bodies the marker must lie on the mesh
  /// @throws InputError with the nearest name if there is no such marker, ModelError if a force
  ///         would act on a place off the mesh
  int find(const base::MarkerRef& ref, bool needs_mesh);

  /// Where on the mesh the marker lies; empty if it is fixed to the body frame.
  std::optional<MeshPlace> place(const base::MarkerRef& ref) const;

  /// The interface that the marker is or stands at, null for all other places.
  const InterfaceRegion* interface(const std::string& marker) const;

  /// Whether the named place lies on this mesh: in a divided body it may lie on another part.
  bool holds(const std::string& name) const;
  /// Least distance of a node from the named place [m]; HUGE_VAL where the name is unknown.
  double distance(const std::string& name) const;
  /// Marker on a node where this part is cut from others.
  int cut_marker(int node);

  /// Marker that follows the mean displacement of a part of the mesh; with the axes of the body.
  /// Its name, which no model file can write, finds it.
  /// @param position mean place, model axes [m]; empty: a marker at the body frame
  /// @param rows of the mean displacement over the nodal variables (0…2, DOF, value)
  int add_region(const std::string& name, const std::optional<Eigen::Vector3d>& position,
                 const std::vector<linalg::Triplet>& rows);
  /// One more row over the nodal variables.
  /// @param entries (0, DOF, value)
  /// @return its number
  int add_pattern(const std::vector<linalg::Triplet>& entries);

  /// All names a user can write, for messages and listings.
  std::vector<std::string> names() const;

  /// Number of rows given out so far.
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
  /// @throws InputError saying how far from the mesh the marker lies
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

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
#include "buckens/model/structure_from_spec.h"

namespace buckens::model {

/// Finds the marker that a name in the model file means, and gives points of the mesh their rows
/// y = N d. Markers asked for first (by joints and loads) get the first rows.
class MarkerTable {
 public:
  /// @param mesh null for rigid bodies
  MarkerTable(const body::BodySpec& spec, body::Body& body, const NamedStructure* mesh);

  /// Index into Body::markers.
  /// @param needs_mesh true where a force acts: on flexible bodies the marker must lie on the mesh
  /// @throws InputError with the nearest name if there is no such marker, ModelError if a force
  ///         would act on a place off the mesh
  int find(const base::MarkerRef& ref, bool needs_mesh);

  /// Where on the mesh the marker lies; empty if it is fixed to the body frame.
  std::optional<MeshPlace> place(const base::MarkerRef& ref) const;

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
  };
  Target target(const base::MarkerRef& ref) const;
  Target named(const std::string& name, const base::MarkerRef& ref) const;
  std::string suggestion(const std::string& name) const;
  std::optional<MeshPlace> place_at(const Eigen::Vector3d& position) const;
  std::pair<int, int> rows_at(const MeshPlace& place);
  void add_rows(const std::vector<linalg::Triplet>& entries, int first);

  const body::BodySpec& spec_;
  body::Body& body_;
  const NamedStructure* mesh_;
  std::map<std::string, int> found_;
  std::map<std::tuple<int, int, double>, std::pair<int, int>> rows_of_place_;
  std::vector<linalg::Triplet> entries_;
  int num_rows_ = 0;
};

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "buckens/mesh_io/nastran/bulk.h"
#include "buckens/mesh_io/nastran/ids.h"

namespace buckens::mesh_io {

/// Angles in decks are in degrees [rad].
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// The coordinate systems of a deck and where its nodes are.
///
/// Systems refer to systems (CORD2x) and to nodes (CORD1x), nodes to systems; all are followed
/// until the basic system 0. Angles are in degrees: (r, θ, z) and (r, θ from z, φ from x).
class NastranCoordinates {
 public:
  /// @throws InputError for systems and nodes that are missing, defined differently under one
  /// number, circular or without three points
  NastranCoordinates(const NastranBulk& bulk, NastranNotes& notes);

  /// Nodes in the order of the deck, without duplicates; basic system.
  const std::vector<Eigen::Vector3d>& positions() const { return positions_; }
  const std::vector<std::int64_t>& node_ids() const { return node_ids_; }

  /// Index of a node, −1 if it is missing.
  int find_node(std::int64_t id) const { return nodes_.find(id); }
  /// Index of a node. @throws InputError if it is missing; `user` says what needs it
  int node(std::int64_t id, const std::string& user, const NastranPlace& place) const;
  /// Adds a node that is not in the deck, for ends of offsets. @return its index
  int add_node(const Eigen::Vector3d& position);

  /// Axes of a system as columns at a point of the basic system.
  /// @throws InputError if it is missing
  Eigen::Matrix3d axes_at(std::int64_t system, const Eigen::Vector3d& point,
                          const NastranPlace& place) const;
  /// A point of a system in the basic one.
  Eigen::Vector3d to_basic(std::int64_t system, const Eigen::Vector3d& point,
                           const NastranPlace& place) const;
  bool is_rectangular(std::int64_t system, const NastranPlace& place) const;

  /// The displacement system of a node (CD).
  std::int64_t displacement_system(int node) const {
    return displacement_systems_[static_cast<std::size_t>(node)];
  }
  /// Its axes there.
  Eigen::Matrix3d displacement_axes(int node) const;

 private:
  enum class Form { rectangular, cylindrical, spherical };

  struct System {
    std::int64_t id = 0;
    Form form = Form::rectangular;
    std::array<int, 3> nodes = {-1, -1, -1};  // CORD1x: indices into grids_
    std::int64_t base = 0;                    // CORD2x: RID
    std::array<Eigen::Vector3d, 3> points;    // CORD2x: in RID
    bool solved = false, visited = false;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    NastranPlace place;
  };

  void add_nodes(const NastranBulk& bulk, NastranNotes& notes);
  void add_systems(const NastranBulk& bulk, NastranNotes& notes);
  void add_system(const System& system, NastranNotes& notes);
  const System& system(std::int64_t id, const NastranPlace& place) const;
  std::vector<std::int64_t> needs(const System& system) const;
  void solve(std::int64_t id);
  void place_axes(System& system);
  Eigen::Vector3d node_position(int grid) const;
  static Eigen::Vector3d point_of(const System& system, const Eigen::Vector3d& point);

  std::vector<NastranGrid> grids_;  // without duplicates, defaults filled in
  NastranIds nodes_;
  std::vector<System> systems_;
  std::unordered_map<std::int64_t, std::size_t> system_of_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::int64_t> node_ids_;
  std::vector<std::int64_t> displacement_systems_;
  std::int64_t next_id_ = 1;
};

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::results {

/// Work done on the mechanism since its start [J].
struct WorkBalance {
  double external = 0;    ///< by loads and drives
  double dissipated = 0;  ///< by structural damping and dampers
  double balance = 0;     ///< E − E₀ − external + dissipated
  /// Of the first two, and what force laws hold: in the order of EnergyParts; empty where nothing
  /// keeps account of them.
  linalg::Vector parts = {};
};

/// What is read of the mesh of a body.
struct ObservedElements {
  bool largest = false;     ///< the largest stresses of all elements
  std::vector<int> lines;   ///< line elements, ascending: their section forces and stresses
  std::vector<int> solids;  ///< solids and shells, ascending: their stresses

  bool operator==(const ObservedElements& other) const = default;
};

/// Parts of an observation that need numbers of nodes.
struct ObservedParts {
  bool energies = false;                   ///< and the balance of work
  std::map<int, ObservedElements> bodies;  ///< by index into Model::bodies

  ObservedParts& operator|=(const ObservedParts& other);
};

/// Everything from which sensors and channels are computed at one instant.
struct Observation {
  const model::Model& model;
  const model::State& state;
  std::vector<dynamics::BodyMotion> motions;    ///< with all marker rows
  std::vector<spatial::Wrench> joint_wrenches;  ///< on the second markers, world axes
  std::vector<linalg::Vector> nodal;            ///< nodal variables of each mesh, empty if rigid
  std::vector<linalg::Matrix>
      section_forces;                    ///< 12×E per flexible body, see fem/assembly/recovery.h
  std::vector<linalg::Matrix> stresses;  ///< 2×E per flexible body [Pa]
  std::vector<linalg::Matrix> solid_stresses;  ///< 7×S, see fem/solid/recovery.h; may be empty
  dynamics::Energy energy;
  WorkBalance work;
  std::vector<body::FrameMotion> wholes;  ///< frame of each whole body, see model::whole_motion
  double load_factor = 1;                 ///< of applied loads
  std::vector<double> signals;            ///< t and the values of all signals; empty without any
  /// Largest axial and von Mises stress of bodies whose tables above do not give it [Pa].
  std::map<int, Eigen::Vector2d> largest = {};
  /// Bodies of whose elements the tables above have columns for some only: those.
  std::map<int, ObservedElements> columns = {};

  /// Columns of an element in `section_forces` and `stresses`, and in `solid_stresses`.
  Eigen::Index column_of_line(int body, int element) const;
  Eigen::Index column_of_solid(int body, int element) const;
};

/// What force laws see.
dynamics::Circumstances circumstances_of(const Observation& now);

/// Force and torque of each joint on its second marker at the marker's origin; of couplers on that
/// of their first coordinate.
/// @param lambda multipliers, with those of redundant rows distributed
std::vector<spatial::Wrench> joint_wrenches(const model::Model& model,
                                            const std::vector<dynamics::BodyMotion>& motions,
                                            double t, const model::RowMemory& memory,
                                            const linalg::Vector& lambda);

/// Acceleration of a marker's origin, in world axes [m/s²].
Eigen::Vector3d marker_acceleration(const Observation& now, const model::MarkerId& id);

}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/initial/assembly_moves.h"
#include "buckens/analysis/simulation/section_report.h"
#include "buckens/analysis/vibration/mode_damping.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Report on an interface without running.
struct InterfaceReport {
  std::string name;
  bool is_rigid = false;
  bool carries_moment = true;
  int nodes = 0;
  double area = 0;         ///< [m²]
  Eigen::Vector3d centre;  ///< model axes [m]
};

/// Report on one body without running.
struct BodyReport {
  std::string name;
  bool is_flexible = false;
  int frames = 1;                           ///< body frames that carry it
  double mass = 0;                          ///< [kg]
  Eigen::Vector3d com;                      ///< mass centre in model axes [m]
  Eigen::Matrix3d inertia;                  ///< about the mass centre, model axes [kg m²]
  std::array<double, 3> principal_inertia;  ///< ascending [kg m²]
  int nodes = 0, elements = 0, dof = 0;
  int frame_coordinates = 0;
  std::vector<double> frequencies;                  ///< lowest elastic free-free frequencies [Hz]
  std::vector<std::string> markers;                 ///< names that joints and sensors can use
  std::optional<body::ReductionFigures> reduction;  ///< of reduced bodies
  std::vector<InterfaceReport> interfaces;
  std::vector<SectionReport> sections;  ///< of beams, each orientation once
};

/// Report on a distributed load without running.
struct LoadReport {
  std::string name, kind;
  std::string place;  ///< as in the model file; empty: all bodies
  double extent = 0;
  std::string unit;                                  ///< of the extent: "m^2", "m", "kg", "m^3"
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< resultant at t = 0, world axes [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< at t = 0, about the mass centre [N m]
};

/// Report on a model without running: the contents of `buckens check`.
struct ModelReport {
  std::vector<BodyReport> bodies;
  std::vector<LoadReport> distributed_loads;
  int joints = 0, loads = 0;
  int constraint_rows = 0, redundant_rows = 0;
  int degrees_of_freedom = 0;                ///< of the mechanism with rigid bodies
  std::vector<std::string> redundant;        ///< by joint
  double assembly_gap = 0;                   ///< largest |g| left by assembly [m] or [-]
  std::vector<AssemblyMove> moves;           ///< moves of the bodies by assembly
  double result_bytes = 0;                   ///< of results.h5, 0 without a simulation
  std::vector<ModeDamping> damping;          ///< of the lowest vibrations as assembled
  double step = 0, highest_frequency = 0;    ///< [s]; of the modes that loads excite [Hz]
  std::vector<std::string> notes, warnings;  ///< warnings: steps, doubtful values, moves
};

/// Assembles the mechanism and reports on it.
/// @throws ModelError if it cannot be assembled
ModelReport report_model(const model::BuiltModel& built);

}  // namespace buckens::analysis

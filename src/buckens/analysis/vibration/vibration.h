// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/body/free_free_modes.h"
#include "buckens/linalg/ranks.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Motion of one body in a vibration, relative to its position at rest.
struct BodyShape {
  /// Rotation of the frame in body axes [rad], then its translation in world axes [m].
  Eigen::Matrix<double, 6, 1> frame = Eigen::Matrix<double, 6, 1>::Zero();
  linalg::Vector d;  ///< nodal variables [m, rad]; empty for rigid bodies
};

/// One vibration. Its shape is scaled so that the largest displacement of a node or frame is 1 m;
/// if nothing is displaced (torsion of a straight beam), the largest rotation times the size of its
/// body is 1 m.
struct Vibration {
  double square = 0;            ///< ω² [1/s²]; negative: the position is unstable
  double frequency = 0;         ///< [Hz]; 0 if ω² is negative
  double generalised_mass = 0;  ///< twice the kinetic energy at (1 m) ω [kg]
  double residual = 0;  ///< ‖Kφ − ω²Mφ‖/‖ω²Mφ‖, see body::FreeFreeModes; bodies only
  double error = 0;     ///< bound of the relative error of ω² + μ, see body::FreeFreeModes
  std::vector<double> energy_shares;  ///< of the potential energy, in the order of the groups
  double damping_ratio = 0;           ///< of critical damping, see damping_ratio(); systems only
  /// Mass that a support moving along x, y, z sees in this mode [kg]; systems only.
  std::array<double, 3> effective_mass{};
  /// One entry for a free body, one per body of the model for a system.
  std::vector<BodyShape> shape;
};

/// Effort for the eigenproblem.
struct VibrationWork {
  std::string method;
  double shift = 0;           ///< μ [1/s²]
  double penalty = 0;         ///< c [1/s²]
  int sweeps = 0;             ///< block iterations or Lanczos restarts
  long solves = 0;            ///< large solves, all right-hand sides counted
  int factorisations = 0;     ///< of each flexible body
  double factor_entries = 0;  ///< of the last factors
  double condition = 0;       ///< of the factored matrix; 0: not asked
  double seconds = 0;         ///< wall time
  linalg::Traffic traffic;    ///< of the first process with others
};

/// Vibrations of one free body or of the assembled system.
struct VibrationReport {
  std::string subject;  ///< name of the body; "system"
  int whole = -1;       ///< index of the free body into model::Model::wholes, −1: the system
  int dof = 0;          ///< unknowns: nodal variables and frame coordinates
  int rigid_modes = 0;  ///< motions with ω = 0, not among the vibrations
  double mass = 0;      ///< of all bodies [kg]
  bool is_system() const { return whole < 0; }

  std::vector<std::string> energy_groups;
  std::vector<Vibration> vibrations;  ///< ω² ascending
  model::State position;              ///< about which the system vibrates
  VibrationWork work;
  std::vector<std::string> notes;
};

}  // namespace buckens::analysis

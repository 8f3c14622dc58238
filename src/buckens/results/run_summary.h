// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buckens/results/error_statement.h"

namespace buckens::results {

/// Computing effort for one body.
struct BodyEffort {
  std::string name;
  int dof = 0;              ///< nodal variables; 0 for rigid bodies
  long factorisations = 0;  ///< large factorisations, all step sizes together
  long solves = 0;          ///< large solves while stepping
  long recycled = 0;        ///< answers combined from earlier solves in place of further ones
  std::string coupling;     ///< level of inertial coupling in use; empty for rigid bodies
  /// Further counts and measures of this body, by name ("mode_ratio", "factor_bytes").
  std::vector<std::pair<std::string, double>> measures;
};

/// The steps of one length.
struct StepSizeEffort {
  double step = 0;          ///< [s]
  long steps = 0;           ///< accepted ones
  long factorisations = 0;  ///< of all bodies together
};

/// How the step length was chosen.
struct StepControlEffort {
  bool is_controlled = false;         ///< by an error estimate
  long rejected = 0;                  ///< undone because their error was too large
  long failed = 0;                    ///< undone because they did not converge
  double smallest = 0;                ///< accepted [s]
  double largest = 0;                 ///< accepted [s]
  std::vector<StepSizeEffort> sizes;  ///< from the longest to the shortest
};

/// Wall time [s].
struct WallSeconds {
  double total = 0;
  double setup = 0;
  double stepping = 0;
  std::vector<std::pair<std::string, double>> phases;  ///< shares of `stepping`, by name
  /// From the model file to the first step, by name: what precedes `setup`, and its shares.
  std::vector<std::pair<std::string, double>> preparation;
};

struct NewtonEffort {
  long total = 0;
  double per_step_mean = 0;
  long max = 0;  ///< in one step
};

/// Largest values over the run.
struct Residuals {
  double position = 0;  ///< of the constraints [m or rad]
  double velocity = 0;  ///< of the constraints [m/s or rad/s]
  double sieve = 0;     ///< ‖S⁻¹Pᵀd‖ relative to the body's size
  /// Of the constraints on one scale, lengths as parts of the model's length: position [-] and
  /// velocity [1/s].
  double opening = 0, opening_rate = 0;
};

/// A critical point of a static path.
struct CriticalPoint {
  std::string kind;                                     ///< "limit point" or "bifurcation"
  double load_factor = 0;                               ///< there
  double position = 0;                                  ///< time stamp of its record
  std::vector<std::pair<std::string, double>> sensors;  ///< columns by name, SI
};

/// What a static path adds to the summary.
struct StaticPathSummary {
  double load_factor = 0;  ///< reached
  std::vector<CriticalPoint> critical_points;
};

/// A part of the energy account of a run.
struct EnergyEntry {
  enum class Side {
    brought_in,  ///< by loads, drives and events
    lost,        ///< dissipated
    kept         ///< by how much more the model holds now than at its start
  };
  Side side;
  std::string kind;   ///< as sensors spell it: "joint-friction"
  std::string of;     ///< load, joint or body; empty: the model
  double energy = 0;  ///< [J]
};

/// Where the energy came from and went.
struct EnergyAccount {
  std::vector<EnergyEntry> entries;  ///< all that are not zero
  double unexplained = 0;            ///< kept − brought in + lost, the error of steps [J]
};

/// What a run reports at its end; the contents of summary.json.
struct RunSummary {
  std::string title;        ///< of the model
  std::string version;      ///< of Buckens
  bool finished = false;    ///< true: reached the requested end
  std::string interrupted;  ///< why not, in words; empty if finished
  double end_time = 0;      ///< simulated time reached [s]
  long steps = 0;
  StepControlEffort step_control;
  WallSeconds wall_seconds;
  std::vector<BodyEffort> bodies;
  long setup_solves = 0;  ///< large solves before the first step
  NewtonEffort newton_iterations;
  Residuals residuals;
  std::optional<EnergyAccount> energy_account;  ///< of simulations
  double energy_error = 0;                      ///< (E−E₀−W+D)/scale, largest magnitude
  std::vector<std::string> trust;               ///< reasons to doubt the results; empty: none
  std::vector<std::string> warnings;
  std::vector<std::string> notes;                  ///< other events, such as changes of level
  std::vector<std::string> redundant_constraints;  ///< rows found redundant, by joint
  std::optional<StaticPathSummary> static_path;    ///< of `buckens static`
  std::optional<ErrorStatement> errors;            ///< if requested
  /// Further figures of the run, by name.
  std::vector<std::pair<std::string, double>> measures;
};

}  // namespace buckens::results

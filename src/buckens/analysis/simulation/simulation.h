// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "buckens/analysis/simulation/step_view.h"
#include "buckens/base/name_index.h"
#include "buckens/base/saved_values.h"
#include "buckens/linalg/solve_exchange.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"
#include "buckens/results/motion_tables.h"
#include "buckens/results/record_sink.h"

namespace buckens::analysis {

/// Progress of a run.
struct Progress {
  double t = 0;         ///< simulated time [s]
  double duration = 0;  ///< [s]
  long step = 0;
  long steps = 0;  ///< total; 0 if unknown because of step control
};

struct SimulationOptions {
  /// Called by run() at its start and after every step; returning false ends the run after this
  /// step.
  std::function<bool(const Progress&)> on_progress;
  /// Why the run was stopped, for the summary: "interrupted by the user".
  std::string stop_reason = "stopped";
  int threads = 1;  ///< ≥ 1; does not influence results
  /// Whether warnings of the set-up go to the log; the summary has them anyway.
  bool tells_warnings = true;
  /// Shares factors and solves with other simulations that run side by side; null: alone.
  linalg::SolveExchange* exchange = nullptr;
};

/// What may differ between the model of a saved state and the one that continues it, besides title
/// and duration.
enum class Leeway {
  none,
  steps  ///< `step` and `tolerance`, too; then the grid of steps begins anew
};

class SimulationRun;

/// A simulation of a model: set up once, then advanced step by step, to an instant or to its end.
///
///     Simulation simulation(load_model("slider_crank.yaml"));
///     while (simulation.step()) watch(simulation.sensor("angle")[0]);
///
/// Views (sensor, values, displacements) have fixed addresses for the lifetime of the simulation:
/// a call updates the contents and returns the same address each time. They cost nothing in
/// steps.
class Simulation {
 public:
  /// Prepares: assembly, one factorisation per flexible body, consistent start.
  /// @param built outlives the simulation
  /// @throws InputError without a `simulation:`, ModelError if the mechanism cannot be assembled,
  ///         NumericalError naming the joint or body that resists
  explicit Simulation(const model::BuiltModel& built, SimulationOptions options = {});
  /// The same, and keeps the model alive.
  explicit Simulation(std::shared_ptr<const model::BuiltModel> built,
                      SimulationOptions options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // ---- advance
  /// Takes one accepted step. @return false if the end was already reached, or the run was stopped
  /// @throws NumericalError naming the joint or body that resists; the state is then unchanged
  bool step();
  /// Takes steps until one ends at or beyond t: steps stay on their grid.
  /// @return false if the end of the run or a stop came first
  /// @throws NumericalError as step()
  bool advance_to(double t);
  /// Takes steps until the end, or until something stops it, and finishes.
  ///
  /// A step that fails ends the run: the sink gets everything up to it and a summary with
  /// `finished` false, then the error is rethrown.
  results::RunSummary run();
  /// Finishes the records and returns the summary; run() does this itself.
  results::RunSummary finish();
  /// Ends the run after the current step, or now.
  void stop();
  /// Called after each accepted step, in the order in which callbacks were given.
  void on_step(std::function<void(const StepView&)> callback);
  /// Opens a sink, which from now on receives the records requested by the model, starting with the
  /// current state before the next step. It must outlive the simulation's last step.
  /// @pre no step was taken since the simulation was created or restored
  /// @throws InputError, ModelError if a sensor is meaningless, IoError from the sink
  void record_into(results::RecordSink& sink);

  // ---- look
  const model::BuiltModel& built() const;
  double time() const;      ///< [s]
  double end_time() const;  ///< of the run [s]
  long num_steps() const;   ///< taken so far, since t = 0
  bool is_done() const;     ///< the end is reached
  /// The same object for the lifetime of the simulation. Its vectors are swapped from step to step;
  /// positions are relative to Model::origin.
  const model::State& state() const;
  /// Frame of a body: origin at the mass centre; rotation and velocities as in the record. @throws
  /// InputError naming the existing bodies
  body::FrameMotion frame(const std::string& body) const;
  /// Current values of a recorded quantity, "joints/hinge/force", "energies/total".
  /// @return a view with a fixed address, updated by the next call for any path
  /// @throws InputError naming the nearest path
  Eigen::Map<const Eigen::VectorXd> values(const std::string& path) const;
  /// What values() finds under a path. Bodies and joints have channels of their own here also
  /// where thousands of them are recorded in tables. @throws InputError as values()
  results::Channel channel(const std::string& path) const;
  /// Everything that is recorded: paths, units, extents.
  const results::RecordLayout& layout() const;
  /// Current values of a sensor of the model.
  Eigen::Map<const Eigen::VectorXd> sensor(const std::string& name) const;
  /// Current value of a signal of the model. @throws InputError naming the nearest
  double signal(const std::string& name) const;
  using NodalMatrix = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  /// Nodal displacements and rotations of a flexible body in its axes, one row per node.
  Eigen::Map<const NodalMatrix> displacements(const std::string& body) const;
  /// Their rates. @throws InputError for bodies with several frames, whose nodes have several rates
  Eigen::Map<const NodalMatrix> velocities(const std::string& body) const;

  // ---- act
  /// Gives a force or torque of the model a value instead of its law, from now on: [N] or [N m], in
  /// the axes of the load. Before the first step accelerations follow at once; later the value acts
  /// like a law that jumps here.
  /// @throws InputError naming the loads that accept values
  void set_load(const std::string& load, const Eigen::Vector3d& value);
  /// Returns the load to its law.
  void release_load(const std::string& load);
  /// Gives a signal with a `setting` a value from now on, which motors, loads and other signals
  /// that name it follow like a law that jumps here. Part of what save() keeps.
  /// @throws InputError naming the signals that can be set
  void set_signal(const std::string& signal, double value);

  // ---- save and go on
  /// Everything needed to continue bit for bit.
  base::SavedValues save() const;
  /// The same to be written to a file before the simulation goes on: long lists are made as they
  /// are written, and never in memory together.
  base::SavedValues save_to_write() const;
  /// Continues from there. The model must be the same except for its title, duration and leeway.
  /// @pre no step was taken
  /// @throws InputError saying what differs, IoError from the file; it is unusable afterwards
  void restore(const base::SavedValues& saved, Leeway leeway = Leeway::none);

 private:
  std::size_t find_whole(const std::string& body) const;
  results::TablePart find_channel(const std::string& path) const;

  mutable base::NameIndex bodies_, joints_;  // of the wholes and joints of the model
  std::shared_ptr<const model::BuiltModel> kept_;
  std::unique_ptr<SimulationRun> run_;
};

}  // namespace buckens::analysis

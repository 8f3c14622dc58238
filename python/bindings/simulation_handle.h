// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "bindings/model_handle.h"
#include "bindings/python_force.h"
#include "bindings/python_signal.h"

#include "buckens/analysis/error/sensor_curves.h"
#include "buckens/analysis/simulation/checkpoints.h"
#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::python {

struct SimulationSettings {
  std::vector<PythonForce> forces;
  std::vector<PythonSignal> signals;
  int threads = 1;
  std::string out;           ///< run directory; empty: none
  bool keep_records = true;  ///< sensors at the instants of records, in memory
  std::string start_from;    ///< file with a saved state; empty: the start of the model
  bool continues = false;    ///< the run in `out`, of whose checkpoint `start_from` is the file
  std::string model_text;    ///< of model.yaml in `out`; empty: that of the model
};

/// A simulation for Python: releases Python's lock while it computes, returns arrays that follow
/// the simulation, and passes on the exceptions of Python functions unchanged.
///
/// All functions are called with Python's lock held.
class SimulationHandle : public std::enable_shared_from_this<SimulationHandle> {
 public:
  SimulationHandle(std::shared_ptr<const ModelHandle> model, const SimulationSettings& settings);
  /// As leave().
  ~SimulationHandle();
  SimulationHandle(const SimulationHandle&) = delete;
  SimulationHandle& operator=(const SimulationHandle&) = delete;

  // ---- advance
  /// @return false if the end was already reached
  bool step();
  /// @return false if the run ended first
  bool advance(double t);
  /// @param progress called with (time, end time, steps) at most ten times a second; may be None
  /// @return summary.json
  std::string run(pybind11::object progress);
  /// Completes records and files. @return summary.json
  std::string finish();
  /// Completes the files of a run that has taken steps and was not finished, and forgets errors.
  void leave();
  void stop();
  void on_step(pybind11::function callback);

  // ---- look
  double time() const;
  double end_time() const;
  long num_steps() const;
  bool is_done() const;
  /// Position (3), rotation matrix (9, by rows), velocity (3), angular velocity in body axes (3).
  pybind11::array frame(const std::string& body);
  pybind11::array displacements(const std::string& body);
  pybind11::array velocities(const std::string& body);
  pybind11::array multipliers();
  /// A copy of a recorded quantity, in its original shape.
  pybind11::array value(const std::string& path) const;
  double signal(const std::string& name) const;
  std::vector<std::string> signals() const;
  /// Path, unit and component names of all quantities that value() accepts.
  std::vector<std::tuple<std::string, std::string, std::vector<std::string>>> quantities() const;
  /// Name, unit and recorded values of the sensors; the times of the records come first.
  pybind11::list curves() const;

  // ---- act
  void set_load(const std::string& load, const Eigen::Vector3d& value);
  void release_load(const std::string& load);
  void set_signal(const std::string& signal, double value);
  void save(const std::string& path) const;
  /// Brings the records so far to the run directory, unless a step is being computed: then they
  /// come within a second.
  void flush();

 private:
  enum class Phase { idle, in_step, between_steps };

  /// As within a step: for calls that evaluate forces.
  class Evaluating {
   public:
    explicit Evaluating(std::atomic<Phase>& phase) : phase_(phase), before_(phase) {
      phase = Phase::in_step;
    }
    ~Evaluating() { phase_ = before_; }
    Evaluating(const Evaluating&) = delete;
    Evaluating& operator=(const Evaluating&) = delete;

   private:
    std::atomic<Phase>& phase_;
    Phase before_;
  };

  using Clock = std::chrono::steady_clock;

  template <class Work>
  void compute(Work&& work);
  void set_up(const SimulationSettings& settings);
  void keep_checkpoints();
  /// Calls something short that evaluates forces, with Python's lock held.
  template <class Work>
  auto evaluate(Work&& work) const {
    const Evaluating evaluating(phase_);
    try {
      return work();
    } catch (const Error&) {
      pending_->deliver();
      throw;
    }
  }
  void require_idle(const char* what) const;
  void require_at_rest(const char* what) const;
  void require_unfinished() const;
  void after_step();
  void refresh();
  std::string complete();
  pybind11::array view(double* data, std::vector<pybind11::ssize_t> shape);

  std::shared_ptr<const model::BuiltModel> built_;
  std::shared_ptr<PendingException> pending_ = std::make_shared<PendingException>();
  std::unique_ptr<run_store::RunDirectory> directory_;
  std::unique_ptr<analysis::SensorCurves> curves_;
  std::unique_ptr<analysis::Simulation> simulation_;
  std::optional<analysis::Checkpoints> checkpoints_;
  bool is_steered_ = false;  // by functions, or by values set from Python
  long steps_at_start_ = 0;
  std::vector<pybind11::function> callbacks_;
  pybind11::object progress_ = pybind11::none();
  std::map<std::string, std::vector<double>> tables_;       // of frames and multipliers
  std::map<std::string, std::function<void()>> refreshes_;  // of arrays that were handed out
  std::optional<std::string> summary_;
  Clock::time_point next_look_ = Clock::now();
  mutable std::atomic<Phase> phase_ = Phase::idle;
};

}  // namespace buckens::python

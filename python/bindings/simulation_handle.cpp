// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulation_handle.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/state_file.h"
#include "buckens/run_store/summary_json.h"

namespace py = pybind11;

namespace buckens::python {

namespace {

constexpr std::chrono::milliseconds kLookInterval(100);

/// Leaves the library after a completed step; never seen by Python.
struct StepsEnd {};

}  // namespace

SimulationHandle::SimulationHandle(std::shared_ptr<const ModelHandle> model,
                                   const SimulationSettings& settings)
    : is_steered_(!settings.forces.empty() || !settings.signals.empty()) {
  const auto origin = std::make_shared<Eigen::Vector3d>(Eigen::Vector3d::Zero());
  std::vector<model::OwnForce> forces;
  for (const PythonForce& force : settings.forces) {
    forces.push_back(own_force(force, pending_, origin));
  }
  std::vector<model::SignalFunction> signals;
  for (const PythonSignal& signal : settings.signals) {
    signals.push_back(signal_function(signal, pending_));
  }
  compute([&] {
    model->call([&] {
      {
        const base::AllowedThreads threads(settings.threads);
        built_ = model->built_with(std::move(forces), signals);
      }
      *origin = built_->model.origin;
      set_up(settings);
    });
  });
  simulation_->on_step([this](const analysis::StepView&) { after_step(); });
  keep_checkpoints();
  steps_at_start_ = num_steps();
}

void SimulationHandle::set_up(const SimulationSettings& settings) {
  analysis::SimulationOptions options;
  options.threads = settings.threads;
  options.stop_reason = "stopped from Python";
  std::optional<base::SavedValues> start;
  if (!settings.start_from.empty()) start = run_store::read_state(settings.start_from);
  const model::ModelDescription& description = built_->description;
  if (!settings.out.empty()) {
    const std::string& text =
        settings.model_text.empty() ? description.source : settings.model_text;
    run_store::RunDirectoryOptions of_directory{description.title, text, {}};
    if (settings.continues) of_directory.continues = run_store::continuation_from(*start);
    directory_ = std::make_unique<run_store::RunDirectory>(settings.out, std::move(of_directory));
  }
  simulation_ = std::make_unique<analysis::Simulation>(built_, options);
  if (start) {
    simulation_->restore(*start,
                         settings.continues ? analysis::Leeway::steps : analysis::Leeway::none);
    start.reset();  // closes its file
  }
  if (settings.continues && simulation_->is_done()) {
    throw InputError(
        fmt::format("{}: the run has reached its end, t = {:g} s; give a later one: resume(…, "
                    "until=…)",
                    settings.out, simulation_->time()));
  }
  if (directory_ || settings.keep_records) {
    curves_ = std::make_unique<analysis::SensorCurves>(directory_.get());
    simulation_->record_into(*curves_);
  }
}

/// After the functions of a step: what they set acts from there on.
void SimulationHandle::keep_checkpoints() {
  const double interval = built_->description.simulation->checkpoint;
  if (!directory_ || interval <= 0.0) return;
  const auto marked = [this](base::SavedValues state) {
    if (is_steered_) run_store::mark_steered(state);
    return state;
  };
  checkpoints_.emplace(*simulation_, interval, [this, marked](base::SavedValues state) {
    directory_->write_checkpoint(marked(std::move(state)));
  });
  directory_->checkpoint_at_end([this, marked] { return marked(simulation_->save_to_write()); });
}

SimulationHandle::~SimulationHandle() {
  leave();
  // It outlives the simulation whose state it would ask for.
  if (directory_) directory_->checkpoint_at_end({});
}

void SimulationHandle::leave() {
  if (!directory_ || summary_ || phase_ != Phase::idle || num_steps() == steps_at_start_) return;
  try {
    complete();
  } catch (const std::exception&) {  // nobody is left to be told; what was flushed stays readable
  }
}

/// Runs something long without Python's lock; afterwards arrays are up to date, and the exception
/// of a Python function is raised in place of that of the step that it ended.
template <class Work>
void SimulationHandle::compute(Work&& work) {
  next_look_ = Clock::now() + kLookInterval;
  const Evaluating evaluating(phase_);
  try {
    const py::gil_scoped_release unlocked;
    work();
  } catch (const StepsEnd&) {
  } catch (...) {
    refresh();
    pending_->deliver();
    throw;
  }
  refresh();
  pending_->deliver();
}

void SimulationHandle::refresh() {
  for (const auto& [name, fill] : refreshes_) fill();
}

void SimulationHandle::require_idle(const char* what) const {
  if (phase_ == Phase::idle) return;
  throw InputError(
      fmt::format("{}: the simulation is already advancing, in this thread or another; "
                  "let that call return first",
                  what));
}

void SimulationHandle::require_at_rest(const char* what) const {
  if (phase_ != Phase::in_step) return;
  throw InputError(
      fmt::format("{}: the simulation is within a step; a force function has to make "
                  "do with its arguments, and other threads with what a function "
                  "given to on_step tells them",
                  what));
}

void SimulationHandle::require_unfinished() const {
  if (!summary_) return;
  throw InputError(
      fmt::format("the simulation is finished at t = {:.6g} s and its records are "
                  "complete; begin another one, or resume from a saved state",
                  time()));
}

/// Called by the library after each step, without Python's lock.
void SimulationHandle::after_step() {
  const Clock::time_point now = Clock::now();
  const bool is_due = now >= next_look_;
  if (callbacks_.empty() && !is_due) return;
  const py::gil_scoped_acquire lock;
  phase_ = Phase::between_steps;
  try {
    if (!callbacks_.empty()) refresh();
    // Callbacks may add others; those begin with the next step.
    const std::vector<py::function> callbacks = callbacks_;
    for (const py::function& callback : callbacks) callback();
    if (is_due) {
      next_look_ = now + kLookInterval;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(time(), end_time(), num_steps());
    }
  } catch (py::error_already_set& raised) {
    pending_->keep(std::move(raised));
    phase_ = Phase::in_step;
    throw StepsEnd();
  }
  phase_ = Phase::in_step;
}

bool SimulationHandle::step() {
  require_idle("step");
  require_unfinished();
  bool was_taken = false;
  compute([&] { was_taken = simulation_->step(); });
  return was_taken;
}

bool SimulationHandle::advance(double t) {
  require_idle("advance");
  require_unfinished();
  if (!std::isfinite(t)) {
    throw InputError(fmt::format("advance: expected an instant in seconds, found {}", t));
  }
  if (t < time() - 1e-9 * std::abs(t)) {
    throw InputError(
        fmt::format("advance: t = {:.9g} s is over, the simulation is at {:.9g} s; "
                    "resume from a saved state, or begin another one",
                    t, time()));
  }
  bool was_reached = false;
  compute([&] { was_reached = simulation_->advance_to(t); });
  return was_reached;
}

std::string SimulationHandle::run(py::object progress) {
  require_idle("run");
  if (summary_ && is_done()) return *summary_;
  require_unfinished();
  progress_ = std::move(progress);
  try {
    compute([&] { simulation_->run(); });
  } catch (...) {
    // Complete what there is; the exception says more than a further failure would.
    progress_ = py::none();
    try {
      simulation_->stop();
      complete();
    } catch (const Error&) {
    }
    throw;
  }
  if (!progress_.is_none()) progress_(time(), end_time(), num_steps());
  progress_ = py::none();
  return complete();
}

std::string SimulationHandle::finish() {
  require_idle("finish");
  return complete();
}

std::string SimulationHandle::complete() {
  if (summary_) return *summary_;
  const Evaluating evaluating(phase_);
  const py::gil_scoped_release unlocked;
  const results::RunSummary summary = simulation_->finish();
  summary_ = run_store::summary_json(summary, "", "");
  if (directory_) directory_->finish(summary);
  return *summary_;
}

void SimulationHandle::stop() {
  require_at_rest("stop");
  simulation_->stop();
}

void SimulationHandle::on_step(py::function callback) {
  require_at_rest("on_step");
  callbacks_.push_back(std::move(callback));
  is_steered_ = true;
}

void SimulationHandle::set_load(const std::string& load, const Eigen::Vector3d& value) {
  require_at_rest("set_load");
  is_steered_ = true;
  evaluate([&] { simulation_->set_load(load, value); });
}

void SimulationHandle::release_load(const std::string& load) {
  require_at_rest("release_load");
  evaluate([&] { simulation_->release_load(load); });
}

void SimulationHandle::set_signal(const std::string& signal, double value) {
  require_at_rest("set_signal");
  is_steered_ = true;
  evaluate([&] { simulation_->set_signal(signal, value); });
}

void SimulationHandle::save(const std::string& path) const {
  require_at_rest("save");
  const Evaluating evaluating(phase_);
  const py::gil_scoped_release unlocked;
  run_store::write_state(simulation_->save_to_write(), path);
}

void SimulationHandle::flush() {
  if (!directory_ || summary_ || phase_ == Phase::in_step) return;
  directory_->flush();
}

}  // namespace buckens::python

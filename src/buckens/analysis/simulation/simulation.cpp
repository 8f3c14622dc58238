// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/simulation.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/analysis/simulation/run.h"
#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::analysis {

namespace {

// Ends of steps are counted, requested times are decimal numbers.
constexpr double kSameTime = 1e-9;

/// Place of an entry in its list, −1 if there is none of this name.
template <class T>
int place_in(const std::vector<T>& list, base::NameIndex& index, const std::string& name) {
  const T* found = index.find(list, name);
  return found == nullptr ? -1 : static_cast<int>(found - list.data());
}

}  // namespace

Simulation::Simulation(const model::BuiltModel& built, SimulationOptions options)
    : run_(std::make_unique<SimulationRun>(built, std::move(options))) {}

Simulation::Simulation(std::shared_ptr<const model::BuiltModel> built, SimulationOptions options)
    : kept_(std::move(built)), run_(std::make_unique<SimulationRun>(*kept_, std::move(options))) {}

Simulation::~Simulation() = default;

bool Simulation::step() {
  if (run_->is_over()) return false;
  run_->step_by_hand();
  return true;
}

bool Simulation::advance_to(double t) {
  const double enough = t - kSameTime * run_->longest_step();
  while (time() < enough) {
    if (!step()) return false;
  }
  return true;
}

results::RunSummary Simulation::run() { return run_->run(); }

results::RunSummary Simulation::finish() { return run_->finish(); }

void Simulation::stop() { run_->stop(); }

void Simulation::on_step(std::function<void(const StepView&)> callback) {
  run_->callbacks.push_back(
      [this, callback = std::move(callback)](double step) { callback(StepView(*this, step)); });
}

void Simulation::record_into(results::RecordSink& sink) { run_->record_into(sink); }

const model::BuiltModel& Simulation::built() const { return run_->built(); }
double Simulation::time() const { return run_->state().t; }
double Simulation::end_time() const { return run_->duration(); }
long Simulation::num_steps() const { return run_->num_steps(); }
bool Simulation::is_done() const { return run_->is_done(); }
const model::State& Simulation::state() const { return run_->state(); }

body::FrameMotion Simulation::frame(const std::string& body) const {
  const model::Model& model = built().model;
  body::FrameMotion out = model::whole_motion(model, model.wholes[find_whole(body)], state());
  out.X_WB.p += model.origin;
  return out;
}

Eigen::Map<const Eigen::VectorXd> Simulation::values(const std::string& path) const {
  const results::RecordLayout& known_paths = layout();
  const results::TablePart part = find_channel(path);
  return {run_->observe().data() + known_paths.offset(part.table) + part.offset(known_paths),
          static_cast<Eigen::Index>(part.channel.size())};
}

std::size_t Simulation::find_whole(const std::string& body) const {
  const model::Model& model = built().model;
  const int found = place_in(model.wholes, bodies_, body);
  if (found >= 0) return static_cast<std::size_t>(found);
  std::vector<std::string> known;
  for (const model::WholeBody& whole : model.wholes) known.push_back(whole.name);
  throw InputError(fmt::format("there is no body \"{}\".{}", body, base::suggestion(body, known)));
}

results::Channel Simulation::channel(const std::string& path) const {
  return find_channel(path).channel;
}

/// A channel by itself counts as the only part of its table.
results::TablePart Simulation::find_channel(const std::string& path) const {
  const results::RecordLayout& known_paths = layout();
  const int found = known_paths.find(path);
  if (found >= 0) {
    const auto index = static_cast<std::size_t>(found);
    return {index, 0, 0, known_paths.channel(index)};
  }
  const model::Model& model = built().model;
  const auto part = results::find_in_tables(
      known_paths, path,
      [&](const std::string& name) { return place_in(model.wholes, bodies_, name); },
      [&](const std::string& name) { return place_in(model.joints, joints_, name); });
  if (part) return *part;
  std::vector<std::string> known;
  for (const results::Channel& channel : known_paths.channels()) known.push_back(channel.path);
  throw InputError(
      fmt::format("nothing is recorded as \"{}\".{}", path, base::suggestion(path, known)));
}

const results::RecordLayout& Simulation::layout() const { return run_->layout(); }

Eigen::Map<const Eigen::VectorXd> Simulation::sensor(const std::string& name) const {
  return values("sensors/" + name);
}

double Simulation::signal(const std::string& name) const { return run_->signal(name); }

Eigen::Map<const Simulation::NodalMatrix> Simulation::displacements(const std::string& body) const {
  return run_->nodal_views().displacements(find_whole(body), state());
}

Eigen::Map<const Simulation::NodalMatrix> Simulation::velocities(const std::string& body) const {
  return run_->nodal_views().velocities(find_whole(body), state());
}

void Simulation::set_load(const std::string& load, const Eigen::Vector3d& value) {
  run_->set_load(load, value);
}

void Simulation::release_load(const std::string& load) { run_->set_load(load, std::nullopt); }

void Simulation::set_signal(const std::string& signal, double value) {
  run_->set_signal(signal, value);
}

base::SavedValues Simulation::save() const {
  base::SavedValues out;
  run_->save(base::SaveVisit::saving(out));
  return out;
}

base::SavedValues Simulation::save_to_write() const {
  base::SavedValues out;
  run_->save(base::SaveVisit::saving_to_write(out));
  return out;
}

void Simulation::restore(const base::SavedValues& saved, Leeway leeway) {
  run_->restore(saved, leeway);
}

double StepView::time() const { return simulation_->time(); }

void StepView::stop() const { simulation_->stop(); }

void StepView::set_load(const std::string& load, const Eigen::Vector3d& value) const {
  simulation_->set_load(load, value);
}

void StepView::set_signal(const std::string& signal, double value) const {
  simulation_->set_signal(signal, value);
}

Eigen::Map<const Eigen::VectorXd> StepView::sensor(const std::string& name) const {
  return simulation_->sensor(name);
}

}  // namespace buckens::analysis

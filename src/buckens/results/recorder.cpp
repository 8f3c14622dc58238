// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/recorder.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/signals.h"
#include "buckens/results/divided_body.h"
#include "buckens/results/model_geometry.h"
#include "buckens/results/motion_tables.h"
#include "buckens/results/sensor_component.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

const std::vector<std::string> kXyz = {"x", "y", "z"};

// More bodies and joints than this have rows in two tables, in place of two or three data sets of
// their own: HDF5 closes a file that others may read in a time that increases with the square of
// their number, and each takes some 10 kB at least.
constexpr std::size_t kMostWithOwnChannels = 3000;

/// Whether bodies and joints have rows in two tables.
bool are_in_tables(const model::Model& model) {
  return model.wholes.size() + model.joints.size() > kMostWithOwnChannels &&
         std::none_of(model.bodies.begin(), model.bodies.end(),
                      [](const body::Body& body) { return body.is_flexible(); });
}

}  // namespace

Recorder::Recorder(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                   bool has_redundant_joints, TaskPool* pool)
    : built_(built),
      metric_(metric),
      has_redundant_joints_(has_redundant_joints),
      pool_(pool),
      meshes_(built.model, pool) {
  for (std::size_t k = 0; k < built.description.output.sensors.size(); ++k) {
    sensors_.push_back(make_sensor(built, k));
  }
  add_channels();
}

Recorder::~Recorder() = default;

void Recorder::add_mesh_channels(const model::WholeBody& whole, const fem::FeModel& mesh) {
  const std::string path = "bodies/" + whole.name;
  const int nodes = static_cast<int>(mesh.nodes.size());
  const int elements = static_cast<int>(fem::line_elements(mesh).size());
  const int solids = fem::num_solids(mesh);
  layout_.add({path + "/displacement",
               "m, rad",
               {nodes, 6},
               "nodal translations and rotations in body axes",
               {"x", "y", "z", "rx", "ry", "rz"}});
  if (whole.is_divided()) {
    layout_.add({path + "/cut_force",
                 "N, N m",
                 {static_cast<int>(DividedBody(built_.model, whole).ties().size()), 6},
                 "force and torque between the parts, on the later one, axes of the earlier",
                 {"Fx", "Fy", "Fz", "Mx", "My", "Mz"}});
  }
  if (solids > 0) {
    layout_.add({path + "/solid_stress",
                 "Pa",
                 {solids},
                 "von Mises stress at the centre of each solid element",
                 {}});
  }
  if (elements == 0) return;
  layout_.add({path + "/section_force",
               "N, N m",
               {elements, 12},
               "section forces at both ends of each element, element axes",
               {"N_1", "Qy_1", "Qz_1", "Mt_1", "My_1", "Mz_1", "N_2", "Qy_2", "Qz_2", "Mt_2",
                "My_2", "Mz_2"}});
  layout_.add({path + "/stress",
               "Pa",
               {elements, 2},
               "largest axial and von Mises stress",
               {"axial", "mises"}});
}

void Recorder::add_tables() {
  // Values stand in the same order as those of data sets for each.
  const model::Model& model = built_.model;
  layout_.add(motions_channel(model.wholes.size()));
  if (!model.joints.empty()) layout_.add(reactions_channel(model.joints.size()));
}

void Recorder::add_body_and_joint_channels() {
  const model::Model& model = built_.model;
  for (const model::WholeBody& whole : model.wholes) {
    for (Channel& channel : body_channels(whole.name)) layout_.add(std::move(channel));
    const fem::FeModel* mesh = mesh_of(model, whole);
    if (mesh == nullptr) continue;
    add_mesh_channels(whole, *mesh);
  }
  for (const model::Joint& joint : model.joints) {
    if (joint.is_tie) continue;
    for (Channel& channel : joint_channels(joint.name)) layout_.add(std::move(channel));
  }
}

void Recorder::add_channels() {
  const model::Model& model = built_.model;
  are_in_tables(model) ? add_tables() : add_body_and_joint_channels();
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const int count = load.element->num_values();
    const std::string path = "loads/" + load.name + "/value";
    if (count == 0 || layout_.find(path) >= 0) continue;  // one load may act on several bodies
    recorded_loads_.push_back(k);
    layout_.add({path, load.unit, count == 1 ? std::vector<int>{} : std::vector<int>{count},
                 fmt::format("of the {}{}", load.kind,
                             count == 1                ? ""
                             : load.element->follows() ? ", axes that turn with the body"
                                                       : ", world axes"),
                 count == 1 ? std::vector<std::string>{} : kXyz});
  }
  for (const char* name :
       {"kinetic", "strain", "gravity", "springs", "total", "work", "dissipated", "balance"}) {
    layout_.add({std::string("energies/") + name, "J", {}, "energy of the whole model", {}});
  }
  for (const auto& sensor : sensors_) {
    for (Channel& channel : sensor->channels()) layout_.add(std::move(channel));
  }
}

Geometry Recorder::geometry() const { return model_geometry(built_.model); }

void Recorder::append_bodies(const Observation& now, std::vector<double>& values) const {
  const auto push = [&](const Vector3d& v) { values.insert(values.end(), {v.x(), v.y(), v.z()}); };
  for (std::size_t w = 0; w < now.model.wholes.size(); ++w) {
    const model::WholeBody& whole = now.model.wholes[w];
    const body::FrameMotion& frame = now.wholes[w];
    push(now.model.origin + frame.X_WB.p);
    const Eigen::Quaterniond& q = frame.X_WB.q;
    values.insert(values.end(), {q.w(), q.x(), q.y(), q.z()});
    push(frame.v);
    push(frame.w);
    if (whole.is_divided()) {
      const DividedBody divided(now.model, whole);
      divided.append_displacements(now, values);
      divided.append_cut_forces(now, values);
      divided.append_solid_stresses(now.solid_stresses, values);
      divided.append_elements(now.section_forces, values);
      divided.append_elements(now.stresses, values);
      continue;
    }
    const auto b = static_cast<std::size_t>(whole.first);
    if (!now.model.bodies[b].is_flexible()) continue;
    for (const auto& dofs : now.model.bodies[b].flexible->mesh().dofs.node_dofs) {
      for (const int dof : dofs) values.push_back(dof >= 0 ? now.nodal[b][dof] : 0.0);
    }
    const auto& mises = now.solid_stresses[b];
    for (Eigen::Index e = 0; e < mises.cols(); ++e) values.push_back(mises(fem::kMises, e));
    const auto& forces = now.section_forces[b];
    values.insert(values.end(), forces.data(), forces.data() + forces.size());
    const auto& stresses = now.stresses[b];
    values.insert(values.end(), stresses.data(), stresses.data() + stresses.size());
  }
}

void Recorder::append_joints_and_loads(const Observation& now, std::vector<double>& values) const {
  const model::Model& model = now.model;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].is_tie) continue;
    const spatial::Wrench& wrench = now.joint_wrenches[j];
    for (const Vector3d& v : {wrench.force, wrench.torque}) {
      values.insert(values.end(), {v.x(), v.y(), v.z()});
    }
  }
  for (const std::size_t k : recorded_loads_) {
    const loads::ForceElement& load = *model.loads[k].element;
    const double factor = load.is_applied() ? load_factor_ : 1.0;
    const model::LoadInputs& inputs = now.state.inputs;
    const bool is_given = !inputs.empty() && inputs[k];
    const Vector3d given = factor * (is_given ? *inputs[k] : load.values(now.state.t));
    values.insert(values.end(), given.data(), given.data() + load.num_values());
  }
}

/// Without fields and energies.
Observation Recorder::observe(const model::State& state, const WorkBalance& work) {
  const model::Model& model = built_.model;
  Observation now{
      model,        state, dynamics::motions_of(model, state), {}, {}, {}, {}, {}, {}, work, {},
      load_factor_, {}};
  if (!model.signals.empty()) {
    dynamics::SignalValues signals;
    dynamics::evaluate_signals(model, now.motions, state.t, dynamics::circumstances_of(state),
                               signals);
    now.signals = std::move(signals.values);
  }
  for (const model::WholeBody& whole : model.wholes) {
    now.wholes.push_back(model::whole_motion(model, whole, state));
  }
  linalg::Vector lambda = state.lambda;
  if (has_redundant_joints_) {
    dynamics::Constraints constraints;
    dynamics::evaluate_constraints(model, now.motions, state.t, &state.memory, constraints);
    lambda = dynamics::least_multipliers(model, metric_, constraints.rows, lambda);
  }
  now.joint_wrenches = joint_wrenches(model, now.motions, state.t, state.memory, lambda);
  multipliers_ = std::move(lambda);
  return now;
}

void Recorder::add_energies(const std::optional<dynamics::Energy>& energy, Observation& now) {
  now.energy = energy ? *energy : dynamics::energy(now.model, now.state, pool_);
  if (!started_) first_energy_ = now.energy.total();
  now.work.balance = now.energy.total() - first_energy_ - now.work.external + now.work.dissipated;
}

void Recorder::start(const Observation& now) {
  if (std::exchange(started_, true)) return;
  for (const auto& sensor : sensors_) sensor->start(now);
}

std::vector<double> Recorder::read(const model::State& state, const WorkBalance& work,
                                   const std::vector<SensorValue>& values) {
  ObservedParts parts;
  for (const SensorValue& value : values) parts |= sensors_[value.sensor]->reads();
  Observation now = observe(state, work);
  meshes_.add(parts, now);
  // The first energy is what balances refer to.
  if (parts.energies || !started_) add_energies({}, now);
  start(now);
  std::vector<double> out, of_one;
  for (const SensorValue& value : values) {
    of_one.clear();
    sensors_[value.sensor]->append(now, of_one);
    out.push_back(of_one[value.place]);
  }
  return out;
}

std::size_t Recorder::find_component(std::size_t sensor, const model::Signal& signal) const {
  return results::find_component(*sensors_[sensor], signal);
}

Record Recorder::record(const model::State& state, const WorkBalance& work,
                        const std::optional<dynamics::Energy>& energy) {
  Observation now = observe(state, work);
  meshes_.add_all(now);
  add_energies(energy, now);
  Record record{state.t, {}};
  record.values.reserve(layout_.num_values());
  append_bodies(now, record.values);
  append_joints_and_loads(now, record.values);
  const dynamics::Energy& e = now.energy;
  const double datum = dynamics::gravity_datum(built_.model);
  record.values.insert(record.values.end(),
                       {e.kinetic, e.strain, datum + e.gravity, e.springs, datum + e.total(),
                        now.work.external, now.work.dissipated, now.work.balance});
  start(now);
  for (const auto& sensor : sensors_) sensor->append(now, record.values);
  energy_ = e;
  balance_ = now.work.balance;
  return record;
}

void Recorder::visit_saved(const base::SaveVisit& visit) {
  visit.flag("started", started_);
  visit.number("first_energy", first_energy_);
  for (std::size_t k = 0; k < sensors_.size(); ++k) {
    sensors_[k]->visit_saved(visit.inside("sensors").inside(k));
  }
}

}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/model_report.h"

#include <algorithm>
#include <utility>

#include "buckens/analysis/initial/prepare.h"
#include "buckens/analysis/simulation/held_readings.h"
#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/analysis/simulation/step_advice.h"
#include "buckens/analysis/simulation/turn.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/model/build/paired_model.h"
#include "buckens/results/field_recorder.h"
#include "buckens/results/recorder.h"
#include "buckens/results/stored_size.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::analysis {

namespace {

/// Report from mesh and mass properties; `fe` is null for rigid bodies.
void describe(const fem::FeModel* fe, const body::FreeModes& modes, BodyReport& out) {
  const Eigen::Vector3d principal = spatial::principal_axes(out.inertia).values;
  for (std::size_t k = 0; k < 3; ++k) {
    out.principal_inertia[k] = principal[static_cast<Eigen::Index>(k)];
  }
  if (fe == nullptr) return;
  out.is_flexible = true;
  out.nodes = static_cast<int>(fe->nodes.size());
  out.elements = static_cast<int>(fem::line_elements(*fe).size()) + fem::num_solids(*fe);
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k) {
    out.frequencies.push_back(modes.omega[k] / kTurn);
  }
}

void add_body(const body::Body& body, BodyReport& out) {
  out.dof += static_cast<int>(body.num_dofs());
  out.frame_coordinates +=
      static_cast<int>(body.rotation_basis.cols() + body.translation_basis.cols());
  for (const body::Marker& marker : body.markers) {
    if (!marker.name.starts_with('#')) out.markers.push_back(marker.name);
  }
}

/// Normal of the plane of a planar model, in the model axes of a body.
std::optional<Eigen::Vector3d> normal_of(const model::Model& model, const model::WholeBody& whole) {
  if (!model.planar) return std::nullopt;
  const spatial::Pose& placed = model.placed[static_cast<std::size_t>(whole.first)];
  return Eigen::Vector3d(placed.q.conjugate() * spatial::normal(*model.planar));
}

BodyReport report_body(const model::Model& model, const model::WholeBody& whole,
                       const body::FreeModes& modes) {
  BodyReport out;
  out.name = whole.name;
  out.frames = whole.count;
  out.mass = whole.mass;
  out.com = whole.com;
  for (int b = whole.first; b < whole.first + whole.count; ++b) {
    add_body(model.bodies[static_cast<std::size_t>(b)], out);
  }
  for (const model::InterfaceRegion& interface : whole.interfaces) {
    out.interfaces.push_back({interface.name, interface.is_rigid, interface.region.turns(),
                              static_cast<int>(interface.region.nodes.size()),
                              interface.region.area, interface.region.centre});
  }
  if (whole.is_divided()) {
    out.inertia = whole.mesh->shape.J0;
    describe(whole.mesh.get(), modes, out);
    out.sections = report_sections(*whole.mesh, normal_of(model, whole));
    return out;
  }
  const body::Body& body = model.bodies[static_cast<std::size_t>(whole.first)];
  out.inertia = body.J0;
  describe(body.is_flexible() ? &body.flexible->mesh() : nullptr, modes, out);
  if (body.is_flexible()) {
    out.sections = report_sections(body.flexible->mesh(), normal_of(model, whole));
  }
  if (body.is_flexible() && body.flexible->is_reduced()) out.reduction = body.flexible->reduction;
  return out;
}

/// Mass centre of the bodies from `first` on, on which a load acts.
Eigen::Vector3d centre_of(const model::Model& model, const model::State& state,
                          const std::vector<int>& bodies) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0;
  for (const int body : bodies) {
    const auto b = static_cast<std::size_t>(body);
    moment += model.bodies[b].mass * state.bodies[b].frame.X_WB.p;
    mass += model.bodies[b].mass;
  }
  return moment / mass;
}

/// All parts of the wholes on which the loads with this name act.
std::vector<int> bodies_of(const model::Model& model, const std::string& load) {
  std::vector<int> out;
  for (const model::WholeBody& whole : model.wholes) {
    const bool is_loaded =
        std::any_of(model.loads.begin(), model.loads.end(), [&](const model::Load& l) {
          return l.name == load && l.first.body >= whole.first &&
                 l.first.body < whole.first + whole.count;
        });
    for (int b = whole.first; is_loaded && b < whole.first + whole.count; ++b) out.push_back(b);
  }
  return out;
}

std::vector<LoadReport> report_loads(const model::Model& model, const model::State& state) {
  const auto motions = dynamics::motions_of(model, state);
  std::vector<LoadReport> out;
  for (const model::Load& load : model.loads) {
    if (!load.region) continue;
    const bool is_new = out.empty() || out.back().name != load.name;
    if (is_new) out.push_back({load.name, load.kind, load.region->place, 0, load.region->unit});
    LoadReport& report = out.back();
    if (report.place != load.region->place) report.place.clear();
    report.extent += load.region->extent;
    const auto first = dynamics::evaluate_marker(model, load.first, motions).motion;
    const spatial::Wrench wrench = load.element->evaluate(state.t, first, {}).on_first;
    const Eigen::Vector3d centre = centre_of(model, state, bodies_of(model, load.name));
    report.force += wrench.force;
    report.torque += wrench.torque + (first.p - centre).cross(wrench.force);
  }
  return out;
}

void add_damping(ModeDampingReport damping, ModelReport& out) {
  out.damping = std::move(damping.modes);
  out.notes.insert(out.notes.end(), damping.notes.begin(), damping.notes.end());
}

/// @throws InputError where a signal reads a component that its sensor has not
void report_size(const model::BuiltModel& built, const results::Recorder& recorder,
                 const OutputPlan& plan, ModelReport& out) {
  const HeldReadings readings(built, recorder);
  const results::FieldRecorder fields(built);
  results::Geometry geometry = recorder.geometry();
  if (!fields.is_empty()) fields.add_places(geometry);
  out.result_bytes =
      plan.bytes(recorder.layout(), fields.layout()) + results::stored_bytes(geometry);
  const std::string advice = judge_size(out.result_bytes);
  if (!advice.empty()) out.warnings.push_back(advice);
}

}  // namespace

ModelReport report_model(const model::BuiltModel& given) {
  model::PairedModel paired(given);
  const model::BuiltModel& built = paired.built();
  const model::Model& model = built.model;
  ModelReport out;
  OutputPlan plan;
  if (built.description.simulation) {
    out.step = built.description.simulation->step.value_or(0.0);
    plan = plan_output(built.description);
  }
  int coordinates = 0;
  for (const model::WholeBody& whole : model.wholes) {
    const body::FreeModes modes = reported_modes(model, whole);
    out.bodies.push_back(report_body(model, whole, modes));
    const double lowest = modes.omega.size() > 0 ? modes.omega[0] : 0.0;
    if (const std::string doubt = judge_frequency(whole.name, lowest); !doubt.empty()) {
      out.warnings.push_back(doubt);
    }
    const ExcitedBand band = excited_band(model, whole, modes);
    out.highest_frequency = std::max(out.highest_frequency, band.highest / kTurn);
    const std::string advice = judge_step(whole.name, band, out.step, plan.finest);
    if (!advice.empty()) out.warnings.push_back(advice);
    coordinates += out.bodies.back().frame_coordinates;
  }
  const dynamics::MassMetric metric(model);
  const Prepared prepared = prepare(built, metric, paired.pairs());
  out.joints = static_cast<int>(std::count_if(model.joints.begin(), model.joints.end(),
                                              [](const auto& joint) { return !joint.is_tie; }));
  out.loads = static_cast<int>(built.description.loads.size());
  out.distributed_loads = report_loads(model, prepared.state);
  out.constraint_rows = model.num_constraint_rows();
  out.redundant_rows = static_cast<int>(prepared.redundant_rows.size());
  out.redundant = prepared.redundant_text;
  out.notes = prepared.notes;
  out.moves = prepared.moves;
  for (const std::string& text : prepared.warnings) out.warnings.push_back(text);

  if (built.description.simulation) {
    report_size(built, results::Recorder(built, metric, !prepared.redundant_rows.empty()), plan,
                out);
  }

  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, prepared.state), 0.0,
                                 &prepared.state.memory, constraints);
  if (constraints.g.size() > 0) out.assembly_gap = constraints.g.cwiseAbs().maxCoeff();
  std::vector<dynamics::SystemRow> rigid_rows = constraints.rows;
  for (dynamics::SystemRow& row : rigid_rows) {
    for (std::size_t k = 0; k < row.num_parts(); ++k)
      row.part(k).translation_row = row.part(k).rotation_row = -1;
  }
  out.degrees_of_freedom =
      coordinates - static_cast<int>(metric.split(rigid_rows).independent.size());
  add_damping(report_mode_damping(built, prepared.state), out);
  return out;
}

}  // namespace buckens::analysis

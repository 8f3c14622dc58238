// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/field_recorder.h"

#include <algorithm>
#include <utility>

#include "buckens/base/errors.h"
#include "buckens/model/state.h"
#include "buckens/results/model_geometry.h"

namespace buckens::results {

namespace {

bool has_mesh(const model::Model& model, const model::FieldPlaces& places) {
  return mesh_of(model, model.wholes[static_cast<std::size_t>(places.whole)]) != nullptr;
}

[[noreturn]] void refuse_nothing(const model::FieldOutputSpec& spec, bool has_loads) {
  if (has_loads) {
    throw InputError(spec.where,
                     "output.fields: no joint and no load acts at the places there, so that there "
                     "are no interface loads; leave `on` out, or name a body or marker with a "
                     "joint or load");
  }
  throw InputError(
      spec.where,
      "output.fields: no body there has solids or shells, so there are no such fields; "
      "beams and bars have `stress` and `section_force` in every run, and motion "
      "(displacement, velocity, acceleration) exists on every mesh");
}

}  // namespace

FieldRecorder::FieldRecorder(const model::BuiltModel& built, TaskPool* pool) : built_(built) {
  const auto& spec = built.description.output.field_output;
  if (!spec) return;
  for (const model::FieldPlaces& places : built.fields) {
    if (!has_mesh(built.model, places)) continue;
    BodyFields body(built.model, places, *spec, pool);
    if (body.is_empty()) continue;
    body.add_channels(layout_);
    bodies_.push_back(std::move(body));
  }
  for (const model::FieldPlaces& places : built.fields) {
    if (!has_mesh(built.model, places)) continue;
    ShellFields shells(built.model, places, *spec);
    if (shells.is_empty()) continue;
    shells.add_channels(layout_);
    shells_.push_back(std::move(shells));
  }
  const bool has_loads = std::find(spec->record.begin(), spec->record.end(),
                                   model::FieldQuantity::interface_load) != spec->record.end();
  for (const model::FieldPlaces& places : built.fields) {
    if (!has_loads) break;
    InterfaceLoads loads(built.model, places);
    if (loads.is_empty()) continue;
    loads.add_channels(layout_);
    loads_.push_back(std::move(loads));
  }
  if (is_empty()) refuse_nothing(*spec, has_loads);
}

bool FieldRecorder::watches_steps() const {
  const auto& spec = built_.description.output.field_output;
  return spec && spec->extremes == model::ExtremeRate::steps && has_extremes();
}

void FieldRecorder::add_places(Geometry& geometry) const {
  for (const BodyFields& body : bodies_) {
    body.add_places(geometry.bodies[static_cast<std::size_t>(body.whole())]);
  }
}

void FieldRecorder::watch(const model::State& state) {
  for (BodyFields& body : bodies_) {
    if (!body.has_extremes()) continue;
    body.evaluate_stresses(state);
    body.update_extremes(state.t);
  }
  for (ShellFields& body : shells_) {
    if (!body.has_extremes()) continue;
    body.evaluate(state);
    body.update_extremes(state.t);
  }
}

Record FieldRecorder::record(const model::State& state, const FieldInstant& at) {
  Record out{at.stamp.value_or(state.t), {}};
  out.values.reserve(layout_.fields.num_values());
  for (BodyFields& body : bodies_) {
    body.evaluate_stresses(state);
    body.update_extremes(out.t);
    body.append(state, out.values);
  }
  for (ShellFields& body : shells_) {
    body.evaluate(state);
    body.update_extremes(out.t);
    body.append(out.values);
  }
  if (loads_.empty()) return out;
  const std::vector<dynamics::BodyMotion> motions = dynamics::motions_of(built_.model, state);
  const linalg::Vector& lambda = at.lambda != nullptr ? *at.lambda : state.lambda;
  for (const InterfaceLoads& body : loads_) {
    body.append(state, motions, lambda, at.load_factor, out.values);
  }
  return out;
}

std::vector<double> FieldRecorder::extremes() const {
  std::vector<double> out;
  out.reserve(layout_.extremes.num_values());
  for (const BodyFields& body : bodies_) body.append_extremes(out);
  for (const ShellFields& body : shells_) body.append_extremes(out);
  return out;
}

void FieldRecorder::visit_saved(const base::SaveVisit& visit) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k].visit_saved(visit.inside("bodies").inside(k));
  }
  for (std::size_t k = 0; k < shells_.size(); ++k) {
    shells_[k].visit_saved(visit.inside("shells").inside(k));
  }
}

}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/field_recorder.h"

#include <utility>

#include "buckens/base/errors.h"
#include "buckens/model/state.h"

namespace buckens::results {

FieldRecorder::FieldRecorder(const model::BuiltModel& built) : built_(built) {
  const auto& spec = built.description.output.field_output;
  if (!spec) return;
  for (const model::FieldPlaces& places : built.fields) {
    BodyFields body(built.model, places, *spec);
    if (!body.is_empty()) {
      body.add_channels(layout_);
      bodies_.push_back(std::move(body));
    }
  }
  for (const model::FieldPlaces& places : built.fields) {
    ShellFields shells(built.model, places, *spec);
    if (shells.is_empty()) continue;
    shells.add_channels(layout_);
    shells_.push_back(std::move(shells));
  }
  if (!is_empty()) return;
  throw InputError(
      spec->where,
      "output.fields: no body there has solids or shells, so there are no such fields; "
      "beams and bars have `stress` and `section_force` in every run, and motion "
      "(displacement, velocity, acceleration) exists on every mesh");
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

Record FieldRecorder::record(const model::State& state, const std::optional<double>& stamp) {
  Record out{stamp.value_or(state.t), {}};
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
  return out;
}

std::vector<double> FieldRecorder::extremes() const {
  std::vector<double> out;
  out.reserve(layout_.extremes.num_values());
  for (const BodyFields& body : bodies_) body.append_extremes(out);
  for (const ShellFields& body : shells_) body.append_extremes(out);
  return out;
}

}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/choose_modes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

namespace {

constexpr double kTrialSteps = 400;
constexpr double kTrialShare = 0.2;  // of the duration, with step control
constexpr double kTrialRecords = 100;

/// Keeps the values of all sensors.
class SensorValues final : public results::RecordSink {
 public:
  void begin(const results::RecordLayout& layout, const results::Geometry& /*shape*/) override {
    for (std::size_t k = 0; k < layout.channels().size(); ++k) {
      if (!layout.channel(k).path.starts_with("sensors/")) continue;
      first_.push_back(layout.offset(k));
    }
  }
  void write(const results::Record& record) override {
    for (const std::size_t at : first_) {
      values.emplace_back(record.values[at], record.values[at + 1], record.values[at + 2]);
    }
  }
  void finish(const results::RunSummary& /*summary*/) override {}

  std::vector<Eigen::Vector3d> values;  ///< sensor by sensor, record by record

 private:
  std::vector<std::size_t> first_;
};

class ModeChoice {
 public:
  explicit ModeChoice(const model::ModelDescription& description) : trial_(description) {
    model::SimulationSpec& run = *trial_.simulation;
    const double step = run.step.value_or(0.0);
    run.duration = run.has_step_control() ? kTrialShare * run.duration
                                          : std::min(run.duration, kTrialSteps * step);
    trial_.output.every = run.duration / kTrialRecords;
    trial_.output.field_output.reset();  // their interval matches the run's, and nobody reads them
    for (body::BodySpec& spec : trial_.bodies) {
      if (spec.reduction.is_automatic()) automatic_.push_back(&spec);
    }
    for (body::BodySpec* spec : automatic_) spec->reduction = {};
    watch_markers();
  }

  double duration() const { return trial_.simulation->duration; }
  /// Half the variables of the smallest of the meshes.
  int most_modes() const { return most_modes_; }

  /// @return largest distance of a marker from its position with full meshes, relative to the
  /// largest elastic displacement
  double error_of(int modes) {
    if (full_.empty()) full_ = run();
    for (body::BodySpec* spec : automatic_) {
      spec->reduction.craig_bampton.emplace();
      spec->reduction.craig_bampton->modes = modes;
    }
    const std::vector<Eigen::Vector3d> reduced = run();
    double elastic = 0, off = 0;
    for (std::size_t k = 0; k < full_.size(); ++k) {
      const bool is_position = k % sensors_ < positions_;
      if (is_position) off = std::max(off, (reduced[k] - full_[k]).norm());
      if (!is_position) elastic = std::max(elastic, full_[k].norm());
    }
    return elastic > 0.0 ? off / elastic : (off > 0.0 ? HUGE_VAL : 0.0);
  }

 private:
  /// Sensors: positions of all markers, then elastic displacements of those of automatic bodies.
  void watch_markers() {
    const auto built = model::build_model(trial_);  // with the markers of its sensors
    std::vector<model::SensorSpec> positions, deflections;
    for (std::size_t w = 0; w < built->model.wholes.size(); ++w) {
      const model::WholeBody& whole = built->model.wholes[w];
      const body::Body& body = built->model.bodies[static_cast<std::size_t>(whole.first)];
      const bool is_automatic =
          std::find(automatic_.begin(), automatic_.end(), &trial_.bodies[w]) != automatic_.end();
      if (is_automatic) {
        const auto half = static_cast<int>(body.num_dofs() / 2);
        most_modes_ = most_modes_ == 0 ? half : std::min(most_modes_, half);
      }
      if (whole.is_divided()) continue;
      for (const body::Marker& marker : body.markers) {
        base::MarkerRef ref;
        ref.body = whole.name;
        ref.marker = marker.name == "com" ? "" : marker.name;
        ref.text = whole.name + "/" + marker.name;
        model::PositionSensor position;
        position.of = ref;
        positions.push_back({fmt::format("p{}", positions.size()), {}, position});
        if (!is_automatic || !marker.follows_mesh()) continue;
        model::DeflectionSensor deflection;
        deflection.of = ref;
        deflection.from = model::DeflectionBase::frame;
        deflections.push_back({fmt::format("d{}", deflections.size()), {}, deflection});
      }
    }
    positions_ = positions.size();
    trial_.output.sensors = std::move(positions);
    trial_.output.sensors.insert(trial_.output.sensors.end(), deflections.begin(),
                                 deflections.end());
    sensors_ = trial_.output.sensors.size();
  }

  std::vector<Eigen::Vector3d> run() const {
    SensorValues sink;
    const auto built = model::build_model(trial_);
    SimulationOptions options;
    options.tells_warnings = false;  // those of the run itself will be reported
    simulate(*built, sink, options);
    return std::move(sink.values);
  }

  model::ModelDescription trial_;
  std::vector<body::BodySpec*> automatic_;
  std::size_t positions_ = 0, sensors_ = 0;
  int most_modes_ = 0;
  std::vector<Eigen::Vector3d> full_;
};

/// Sets the choice in all automatic bodies; 0 modes: they stay full.
std::string take_over(model::ModelDescription& description, int modes) {
  std::string names;
  for (body::BodySpec& spec : description.bodies) {
    if (!spec.reduction.is_automatic()) continue;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", spec.name);
    spec.reduction = {};
    if (modes == 0) continue;
    spec.reduction.craig_bampton.emplace();
    spec.reduction.craig_bampton->modes = modes;
  }
  return names;
}

}  // namespace

void choose_modes(model::ModelDescription& description, std::vector<std::string>& notes,
                  const std::function<void(const std::string&)>& say) {
  double tolerance = HUGE_VAL;
  for (const body::BodySpec& spec : description.bodies) {
    if (!spec.reduction.is_automatic()) continue;
    tolerance = std::min(tolerance, spec.reduction.tolerance);
    if (!spec.reduction.file.empty()) {
      throw InputError(
          spec.where, fmt::format("body \"{}\": `reduction: auto` runs its trials every time; give "
                                  "the number of modes that it found to keep the basis in a file",
                                  spec.name));
    }
    if (!description.simulation) {
      throw InputError(spec.where, fmt::format("body \"{}\": `reduction: auto` needs a "
                                               "`simulation` for its trial runs; add one, or give "
                                               "the number of modes",
                                               spec.name));
    }
  }
  if (tolerance == HUGE_VAL) return;
  ModeChoice choice(description);
  double error = HUGE_VAL;
  for (int modes = 1; modes <= choice.most_modes(); modes *= 2) {
    if (say) say(fmt::format("trial run with {} modes", modes));
    error = choice.error_of(modes);
    if (!(error <= tolerance)) continue;
    const std::string names = take_over(description, modes);
    notes.push_back(fmt::format(
        "reduction of {}: craig-bampton with {} modes; in a trial run of {:.4g} s all markers stay "
        "within {:.2g} % of the largest elastic displacement",
        names, modes, choice.duration(), 100.0 * error));
    return;
  }
  const std::string names = take_over(description, 0);
  notes.push_back(
      fmt::format("reduction of {}: up to {} modes miss the tolerance {:g}, the last by {:.2g}; "
                  "the full mesh is "
                  "kept",
                  names, choice.most_modes(), tolerance, error));
}

}  // namespace buckens::analysis

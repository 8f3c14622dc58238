// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/path_record.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr std::string_view kSensors = "sensors/";

/// Loads scaled by the load factor, at factor one.
dynamics::Forces applied_loads(const model::Model& model, const StaticPoint& point, double t) {
  std::vector<dynamics::BodyMotion> motions(point.poses.size());
  for (std::size_t b = 0; b < motions.size(); ++b) {
    motions[b].frame.X_WB = point.poses[b];
    motions[b].y = motions[b].y_dot = linalg::Vector::Zero(model.bodies[b].num_rows());
    motions[b].y.head(point.y[b].size()) = point.y[b];
  }
  dynamics::Forces with, without;
  dynamics::evaluate_forces(model, motions, t, with, 1.0);
  dynamics::evaluate_forces(model, motions, t, without, 0.0);
  for (std::size_t b = 0; b < with.frame.size(); ++b) {
    with.frame[b] -= without.frame[b];
    with.interface[b] -= without.interface[b];
  }
  return with;
}

std::vector<std::string> column_names(const results::Channel& channel) {
  const std::string name = channel.path.substr(kSensors.size());
  if (channel.components.empty()) return {name};
  std::vector<std::string> out;
  for (const std::string& component : channel.components) out.push_back(name + "." + component);
  return out;
}

}  // namespace

StaticPathRecord::StaticPathRecord(const model::BuiltModel& built,
                                   const dynamics::MassMetric& metric, const RestRows& rest,
                                   const Compliances& compliances, double time,
                                   results::RecordSink& sink)
    : built_(built),
      model_(built.model),
      metric_(metric),
      rest_(rest),
      compliances_(compliances),
      sink_(sink),
      fields_(built),
      state_(model::placed_state(built.model)),
      largest_rotation_(built.model.bodies.size(), 0.0) {
  state_.t = time;
  summary.static_path.emplace();
}

void StaticPathRecord::begin(const PathPoint& start) {
  const bool has_redundant_joints =
      !metric_.split(start.balance.constraints.rows).dependent.empty();
  recorder_ = std::make_unique<results::Recorder>(built_, metric_, has_redundant_joints);
  layout_.add({std::string(kSensors) + "load-factor",
               "1",
               {},
               "factor of the applied forces and torques",
               {}});
  layout_.add({"static/unstable",
               "1",
               {},
               "number of motions along which the equilibrium is unstable; -1 if not examined",
               {}});
  for (const results::Channel& channel : recorder_->layout().channels()) layout_.add(channel);
  find_stop();
  results::Geometry geometry = recorder_->geometry();
  if (!fields_.is_empty()) {
    fields_.add_places(geometry);
    sink_.begin_fields(fields_.layout());
  }
  sink_.begin(layout_, geometry);
}

void StaticPathRecord::find_stop() {
  const auto& spec = built_.description.static_path;
  if (!spec || !spec->stop) return;
  const model::StaticStopSpec& stop = *spec->stop;
  const std::string wanted =
      stop.component.empty() ? stop.sensor : stop.sensor + "." + stop.component;
  std::vector<std::string> known;
  for (std::size_t k = 0; k < layout_.channels().size(); ++k) {
    const results::Channel& channel = layout_.channel(k);
    if (!channel.path.starts_with(kSensors)) continue;
    const std::vector<std::string> names = column_names(channel);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == wanted) stop_ = layout_.offset(k) + i;
      known.push_back(names[i]);
    }
  }
  if (stop_) return;
  throw InputError(stop.where,
                   fmt::format("static.stop: no sensor has the column \"{}\".{} Columns are: {}",
                               wanted, base::suggestion(wanted, known), fmt::join(known, ", ")));
}

void StaticPathRecord::watch_stop(double value) {
  const double at = built_.description.static_path->stop->at;
  if (stop_before_ && (*stop_before_ - at) * (value - at) <= 0.0) passed_stop_ = true;
  stop_before_ = value;
}

results::WorkBalance StaticPathRecord::add_work(const PathPoint& at) {
  const dynamics::Forces loads = applied_loads(model_, at.point, state_.t);
  if (before_) {
    // Trapezoidal rule: exact if loads are linear in the displacement.
    double work = 0.0;
    for (std::size_t b = 0; b < loads.frame.size(); ++b) {
      const spatial::Pose& from = before_->poses[b];
      const spatial::Pose& to = at.point.poses[b];
      Vector6 way;
      way << spatial::log_rotation(from.q.conjugate() * to.q), to.p - from.p;
      work +=
          (before_->load_factor * loads_before_.frame[b] + at.point.load_factor * loads.frame[b])
              .dot(way);
      work += (before_->load_factor * loads_before_.interface[b] +
               at.point.load_factor * loads.interface[b])
                  .dot(at.point.y[b] - before_->y[b]);
    }
    work_.external += 0.5 * work;
  }
  before_ = at.point;
  loads_before_ = loads;
  return work_;
}

void StaticPathRecord::write(const PathPoint& at) {
  set_static_state(at.point, rest_, at.balance, compliances_, state_);
  watch_friction(at);
  recorder_->set_load_factor(at.point.load_factor);
  results::Record record = recorder_->record(state_, add_work(at));
  const double unstable =
      at.stiffness ? static_cast<double>((at.stiffness->array() < 0.0).count()) : -1.0;
  record.values.insert(record.values.begin(), {at.point.load_factor, unstable});
  // Time stamps must grow; a limit point may lie within rounding of a step's end.
  record.t = has_last_ ? std::max(at.position, last_.t + 1e-9) : at.position;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    largest_rotation_[b] = std::max(largest_rotation_[b],
                                    largest_nodal_rotation(model_.bodies[b], state_.bodies[b].d));
  }
  const dynamics::Energy& e = recorder_->last_energy();
  energy_scale_ = std::max({energy_scale_, e.strain + e.springs, std::abs(work_.external)});
  largest_balance_ = std::max(largest_balance_, std::abs(recorder_->last_balance()));
  const linalg::Vector& g = at.balance.constraints.g;
  if (g.size() > 0) {
    summary.residuals.position = std::max(summary.residuals.position, g.cwiseAbs().maxCoeff());
  }
  if (has_last_) {
    ++summary.steps;
    summary.newton_iterations.total += at.iterations;
    summary.newton_iterations.max = std::max<long>(summary.newton_iterations.max, at.iterations);
  }
  summary.end_time = record.t;
  if (stop_) watch_stop(record.values[*stop_]);
  sink_.write(record);
  if (!fields_.is_empty()) {
    sink_.write_fields(
        fields_.record(state_, {record.t, &recorder_->last_multipliers(), at.point.load_factor}));
  }
  last_ = std::move(record);
  has_last_ = true;
}

void StaticPathRecord::watch_friction(const PathPoint& at) {
  for (const FrictionDemand& now :
       friction_demands(model_, metric_, rest_, at.point.rest, state_)) {
    WorstFriction& worst = friction_[now.load];
    if (now.ratio() > worst.demand.ratio()) worst = {now, at.point.load_factor};
  }
}

void StaticPathRecord::add_critical_point(const PathPoint& at) {
  results::CriticalPoint out{at.kind, at.point.load_factor, last_.t, {}};
  for (std::size_t k = 0; k < layout_.channels().size(); ++k) {
    const results::Channel& channel = layout_.channel(k);
    if (!channel.path.starts_with(kSensors)) continue;
    const std::vector<std::string> names = column_names(channel);
    for (std::size_t i = 0; i < names.size(); ++i) {
      out.sensors.emplace_back(names[i], last_.values[layout_.offset(k) + i]);
    }
  }
  summary.static_path->critical_points.push_back(std::move(out));
}

void StaticPathRecord::add_body(const model::WholeBody& whole) {
  results::BodyEffort effort;
  effort.name = whole.name;
  const auto first = static_cast<std::size_t>(whole.first);
  std::size_t bent = first;  // the part with the largest rotation
  for (std::size_t b = first; b < first + static_cast<std::size_t>(whole.count); ++b) {
    effort.dof += static_cast<int>(model_.bodies[b].num_dofs());
    if (largest_rotation_[b] > largest_rotation_[bent]) bent = b;
    if (compliances_.of_body[b] == nullptr) continue;
    ++effort.factorisations;
    effort.solves += compliances_.of_body[b]->num_solves();
  }
  if (whole.is_divided()) effort.measures.emplace_back("frames", whole.count);
  if (effort.dof > 0) {
    effort.measures.emplace_back("largest_rotation_rad", largest_rotation_[bent]);
  }
  summary.bodies.push_back(std::move(effort));
  if (largest_rotation_[bent] <= kLargestNodalRotation) return;
  summary.trust.push_back(fmt::format(
      "body \"{}\" bends by up to {:.2g} rad within its frame, more than the {:.1f} rad that "
      "linear elasticity allows; give it more `frames` or divide it into several bodies",
      model_.bodies[bent].name, largest_rotation_[bent], kLargestNodalRotation));
}

void StaticPathRecord::finish(double load_factor) {
  summary.static_path->load_factor = load_factor;
  for (const model::WholeBody& whole : model_.wholes) add_body(whole);
  for (const auto& [load, worst] : friction_) {
    for (const std::string& text : overloaded_friction({worst.demand})) {
      summary.trust.push_back(fmt::format("at load factor {:.6g} {}", worst.load_factor, text));
    }
  }
  results::NewtonEffort& newton = summary.newton_iterations;
  if (summary.steps > 0) {
    newton.per_step_mean = static_cast<double>(newton.total) / static_cast<double>(summary.steps);
  }
  summary.energy_error = energy_scale_ > 0.0 ? largest_balance_ / energy_scale_ : 0.0;
  if (has_last_ && fields_.has_extremes()) sink_.write_extremes(fields_.extremes());
  sink_.finish(summary);
}

}  // namespace buckens::analysis

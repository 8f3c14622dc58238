// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration_record.h"

#include <algorithm>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/results/recorder.h"

namespace buckens::analysis {

namespace {

const std::vector<std::string> kXyz = {"x", "y", "z"};

results::RecordLayout layout_of(const model::Model& model) {
  results::RecordLayout layout;
  layout.add({"modes/body", "1", {}, "number of the free body, -1 for the system", {}});
  layout.add({"modes/number", "1", {}, "of the vibration of this body or the system, from 1", {}});
  layout.add({"modes/frequency", "Hz", {}, "0 where the position is unstable", {}});
  layout.add({"modes/generalised_mass", "kg", {}, "of the shape as stored", {}});
  layout.add({"modes/error", "1", {}, "bound of the relative error of omega^2 + shift", {}});
  layout.add({"modes/effective_mass", "kg", {3}, "of the system along world axes", kXyz});
  for (const body::Body& body : model.bodies) {
    const std::string path = "bodies/" + body.name;
    layout.add({path + "/pose",
                "m, 1",
                {7},
                "origin of the body frame and its quaternion where the body rests",
                {"x", "y", "z", "qw", "qx", "qy", "qz"}});
    layout.add({path + "/motion",
                "rad, m",
                {6},
                "rotation of the frame in body axes, translation in world axes",
                {"rx", "ry", "rz", "x", "y", "z"}});
    if (!body.is_flexible()) continue;
    layout.add({path + "/displacement",
                "m, rad",
                {static_cast<int>(body.flexible->fe.nodes.size()), 6},
                "nodal translations and rotations in body axes",
                {"x", "y", "z", "rx", "ry", "rz"}});
  }
  return layout;
}

void append_pose(const spatial::Pose& X, std::vector<double>& values) {
  values.insert(values.end(), {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()});
}

void append_displacement(const fem::DofMap& dofs, const linalg::Vector& d,
                         std::vector<double>& values) {
  for (const std::array<int, 6>& node : dofs.node_dofs) {
    for (const int dof : node) values.push_back(dof < 0 || d.size() == 0 ? 0.0 : d[dof]);
  }
}

std::vector<double> values_of(const model::Model& model, const VibrationReport& report,
                              std::size_t number) {
  const Vibration& v = report.vibrations[number];
  const bool is_system = report.subject == "system";
  std::vector<double> values = {is_system ? -1.0 : static_cast<double>(report.bodies.front()),
                                static_cast<double>(number + 1), v.frequency, v.generalised_mass,
                                v.error};
  values.insert(values.end(), v.effective_mass.begin(), v.effective_mass.end());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    append_pose(report.position.bodies[b].frame.X_WB, values);
    const auto found = std::find(report.bodies.begin(), report.bodies.end(), static_cast<int>(b));
    const BodyShape still;
    const BodyShape& shape = found == report.bodies.end()
                                 ? still
                                 : v.shape[static_cast<std::size_t>(found - report.bodies.begin())];
    values.insert(values.end(), shape.frame.data(), shape.frame.data() + 6);
    if (model.bodies[b].is_flexible()) {
      append_displacement(model.bodies[b].flexible->fe.dofs, shape.d, values);
    }
  }
  return values;
}

}  // namespace

void record_vibrations(const model::BuiltModel& built, const std::vector<VibrationReport>& reports,
                       results::RecordSink& sink) {
  const dynamics::MassMetric metric(built.model);
  sink.begin(layout_of(built.model), results::Recorder(built, metric, false).geometry());
  results::RunSummary summary;
  summary.title = built.description.title;
  summary.finished = true;
  for (const VibrationReport& report : reports) {
    summary.wall_seconds.total += report.work.seconds;
    summary.setup_solves += report.work.solves;
    summary.warnings.insert(summary.warnings.end(), report.notes.begin(), report.notes.end());
    for (std::size_t k = 0; k < report.vibrations.size(); ++k) {
      summary.end_time += 1.0;
      sink.write({summary.end_time, values_of(built.model, report, k)});
    }
  }
  sink.finish(summary);
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/record.h"

#include "buckens/dynamics/mass_metric.h"
#include "buckens/results/model_geometry.h"
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
  for (const model::WholeBody& whole : model.wholes) {
    const std::string path = "bodies/" + whole.name;
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
    const fem::FeModel* mesh = results::mesh_of(model, whole);
    if (mesh == nullptr) continue;
    layout.add({path + "/displacement",
                "m, rad",
                {static_cast<int>(mesh->nodes.size()), 6},
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

/// Motion of the nodes of a divided body in the axes of the whole, whose frame rests.
void append_parts(const model::Model& model, const model::WholeBody& whole,
                  const VibrationReport& report, const Vibration& v, std::vector<double>& values) {
  const Eigen::Quaterniond to_whole =
      model::whole_motion(model, whole, report.position).X_WB.q.conjugate();
  for (std::size_t n = 0; n < whole.nodes.size(); ++n) {
    const model::MeshCopy& copy = whole.nodes[n];
    const auto b = static_cast<std::size_t>(copy.body);
    const BodyShape& shape = v.shape[b];
    const auto& dofs =
        model.bodies[b].flexible->mesh().dofs.node_dofs[static_cast<std::size_t>(copy.index)];
    Eigen::Matrix<double, 6, 1> own = Eigen::Matrix<double, 6, 1>::Zero();
    for (int k = 0; k < 6; ++k) {
      const int dof = dofs[static_cast<std::size_t>(k)];
      if (dof >= 0) own[k] = shape.d[dof];
    }
    const Eigen::Vector3d w = shape.frame.head<3>();
    const Eigen::Vector3d z = whole.mesh->nodes[n].position - model.bodies[b].com;
    const Eigen::Quaterniond& q = report.position.bodies[b].frame.X_WB.q;
    const Eigen::Vector3d u =
        to_whole * Eigen::Vector3d(shape.frame.tail<3>() + q * (w.cross(z) + own.head<3>()));
    const Eigen::Vector3d theta = to_whole * (q * Eigen::Vector3d(w + own.tail<3>()));
    values.insert(values.end(), {u.x(), u.y(), u.z(), theta.x(), theta.y(), theta.z()});
  }
}

std::vector<double> values_of(const model::Model& model, const VibrationReport& report,
                              std::size_t number) {
  const Vibration& v = report.vibrations[number];
  std::vector<double> values = {static_cast<double>(report.whole), static_cast<double>(number + 1),
                                v.frequency, v.generalised_mass, v.error};
  values.insert(values.end(), v.effective_mass.begin(), v.effective_mass.end());
  for (std::size_t k = 0; k < model.wholes.size(); ++k) {
    const model::WholeBody& whole = model.wholes[k];
    spatial::Pose X_WB = model::whole_motion(model, whole, report.position).X_WB;
    X_WB.p += model.origin;
    append_pose(X_WB, values);
    BodyShape shape;
    if (report.is_system() && !whole.is_divided()) {
      shape = v.shape[static_cast<std::size_t>(whole.first)];
    } else if (report.whole == static_cast<int>(k)) {
      shape = v.shape.front();
    }
    values.insert(values.end(), shape.frame.data(), shape.frame.data() + 6);
    const fem::FeModel* mesh = results::mesh_of(model, whole);
    if (mesh == nullptr) continue;
    if (report.is_system() && whole.is_divided()) {
      append_parts(model, whole, report, v, values);
    } else {
      append_displacement(mesh->dofs, shape.d, values);
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

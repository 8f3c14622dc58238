// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/model_report.h"

#include <algorithm>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "buckens/analysis/prepare.h"
#include "buckens/analysis/step_advice.h"
#include "buckens/body/free_modes.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/fem/recovery.h"

namespace buckens::analysis {

namespace {

constexpr int kModes = 10;
constexpr double kTurn = 2.0 * std::numbers::pi;

BodyReport report_body(const body::Body& body) {
  BodyReport out;
  out.name = body.name;
  out.is_flexible = body.is_flexible();
  out.mass = body.mass;
  out.com = body.com;
  out.inertia = body.J0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(body.J0);
  for (std::size_t k = 0; k < 3; ++k) {
    out.principal_inertia[k] = principal.eigenvalues()[static_cast<Eigen::Index>(k)];
  }
  out.dof = static_cast<int>(body.num_dofs());
  out.frame_coordinates =
      static_cast<int>(body.rotation_basis.cols() + body.translation_basis.cols());
  for (const body::Marker& marker : body.markers) out.markers.push_back(marker.name);
  if (!body.is_flexible()) return out;
  const fem::FeModel& fe = body.flexible->fe;
  out.nodes = static_cast<int>(fe.nodes.size());
  out.elements = static_cast<int>(fem::line_elements(fe).size());
  const body::FreeModes modes = body::free_modes(fe.M, fe.K, body.flexible->sieve.Phi(), kModes);
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k) {
    out.frequencies.push_back(modes.omega[k] / kTurn);
  }
  return out;
}

}  // namespace

ModelReport report_model(const model::BuiltModel& built) {
  const model::Model& model = built.model;
  ModelReport out;
  if (built.description.simulation) out.step = built.description.simulation->step;
  int coordinates = 0;
  for (const body::Body& body : model.bodies) {
    out.bodies.push_back(report_body(body));
    const ExcitedBand band = excited_band(body);
    out.highest_frequency = std::max(out.highest_frequency, band.highest / kTurn);
    const std::string advice = judge_step(body.name, band, out.step);
    if (!advice.empty()) out.warnings.push_back(advice);
    coordinates += out.bodies.back().frame_coordinates;
  }
  const dynamics::MassMetric metric(model);
  const Prepared prepared = prepare(built, metric);
  out.joints = static_cast<int>(model.joints.size());
  out.loads = static_cast<int>(model.loads.size());
  out.constraint_rows = model.num_constraint_rows();
  out.redundant_rows = static_cast<int>(prepared.redundant_rows.size());
  out.redundant = prepared.redundant_text;
  out.notes = prepared.notes;

  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, prepared.state), 0.0,
                                 constraints);
  if (constraints.g.size() > 0) out.assembly_gap = constraints.g.cwiseAbs().maxCoeff();
  std::vector<dynamics::SystemRow> rigid_rows = constraints.rows;
  for (dynamics::SystemRow& row : rigid_rows) {
    row.first.translation_row = row.first.rotation_row = -1;
    row.second.translation_row = row.second.rotation_row = -1;
  }
  out.degrees_of_freedom =
      coordinates - static_cast<int>(metric.split(rigid_rows).independent.size());

  return out;
}

}  // namespace buckens::analysis

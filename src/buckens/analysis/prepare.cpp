// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/prepare.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/analysis/initial_acceleration.h"
#include "buckens/analysis/position_assembly.h"
#include "buckens/analysis/static_equilibrium.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

/// Velocities as the model file gives them, before joints are considered.
void set_velocities(const model::BuiltModel& built, model::State& state) {
  for (const model::InitialBodySpec& spec : built.description.initial.bodies) {
    const int index = built.model.find_body(spec.name);
    if (index == model::kGround) {
      throw InputError(spec.where, fmt::format("initial: there is no body \"{}\"", spec.name));
    }
    const body::Body& body = built.model.bodies[static_cast<std::size_t>(index)];
    model::BodyState& s = state.bodies[static_cast<std::size_t>(index)];
    const auto keep = [](const auto& basis, const Vector3d& v) -> Vector3d {
      return basis * (basis.transpose() * v);
    };
    s.frame.v = keep(body.translation_basis, spec.velocity);
    s.frame.w = keep(body.rotation_basis, spec.angular_velocity);
    if ((s.frame.v - spec.velocity).norm() + (s.frame.w - spec.angular_velocity).norm() > 0.0 &&
        built.model.planar) {
      throw InputError(spec.where, fmt::format("initial: body \"{}\" cannot leave the plane of the "
                                               "planar model; set the other components to zero",
                                               spec.name));
    }
    if (!spec.nodal_velocity) continue;
    if (!body.is_flexible()) {
      throw InputError(spec.where, fmt::format("initial: body \"{}\" is rigid, it has no nodal "
                                               "velocities; give `velocity` instead",
                                               spec.name));
    }
    const model::NodalVelocitySpec& field = *spec.nodal_velocity;
    const model::PositionLaw* laws[6] = {&field.x,  &field.y,  &field.z,
                                         &field.rx, &field.ry, &field.rz};
    const fem::FeModel& fe = body.flexible->fe;
    for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
      for (std::size_t k = 0; k < 6; ++k) {
        const int dof = fe.dofs.node_dofs[node][k];
        if (dof >= 0) s.d_dot[dof] = (*laws[k])(fe.nodes[node].position);
      }
    }
    body.flexible->sieve.apply(s.d_dot);
  }
}

std::vector<std::string> describe_redundancy(const model::Model& model,
                                             const std::vector<int>& dependent) {
  std::vector<std::string> out;
  for (const model::Joint& joint : model.joints) {
    const int first = joint.first_row;
    const int count = static_cast<int>(joint.rows.size());
    const auto own = std::count_if(dependent.begin(), dependent.end(),
                                   [&](int row) { return row >= first && row < first + count; });
    if (own > 0) {
      out.push_back(fmt::format("joint \"{}\": {} of its {} equations follow from other joints",
                                joint.name, own, count));
    }
  }
  return out;
}

}  // namespace

Prepared prepare(const model::BuiltModel& built, const dynamics::MassMetric& metric) {
  const model::Model& model = built.model;
  const model::InitialSpec& initial = built.description.initial;
  Prepared out;
  out.notes = model.notes;
  out.state = model::placed_state(model);
  try {
    assemble_positions(model, metric, out.state);
  } catch (const ModelError&) {
    // Bodies that must be deformed to fit are closed by the static start.
    if (!initial.preload) throw;
    out.notes.push_back("bodies are deformed to close the joints (preload)");
  }
  const bool is_static = initial.start == model::StartKind::static_equilibrium;
  if (is_static || initial.preload) {
    const StaticReport report = find_static_equilibrium(model, metric, out.state);
    out.setup_factorisations = report.factorisations;
    out.notes.insert(out.notes.end(), report.notes.begin(), report.notes.end());
  }
  set_velocities(built, out.state);

  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, out.state), out.state.t,
                                 constraints);
  const linalg::RowRank rank = metric.split(constraints.rows);
  out.rows_in_use = rank.independent;
  out.redundant_rows = rank.dependent;
  out.redundant_text = describe_redundancy(model, rank.dependent);
  project_velocities(model, metric, out.state);
  compute_accelerations(model, metric, out.rows_in_use, out.state);
  return out;
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/nodal_views.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/results/divided_body.h"

namespace buckens::analysis {

void NodalViews::require_flexible(const model::WholeBody& whole) const {
  if (model_.bodies[static_cast<std::size_t>(whole.first)].is_flexible()) return;
  throw InputError(
      fmt::format("body \"{}\" is rigid and has no nodes; ask for its frame", whole.name));
}

NodalViews::View NodalViews::show(NodalMatrix& table, std::size_t body,
                                  const linalg::Vector& values) const {
  const auto& nodes = model_.bodies[body].flexible->mesh().dofs.node_dofs;
  const linalg::Vector nodal = model_.bodies[body].flexible->nodal(values);
  table.resize(static_cast<Eigen::Index>(nodes.size()), Eigen::NoChange);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = nodes[n][k];
      table(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) =
          dof >= 0 ? nodal[dof] : 0.0;
    }
  }
  return {table.data(), table.rows(), 6};
}

NodalViews::View NodalViews::displacements(std::size_t whole, const model::State& state) {
  const model::WholeBody& body = model_.wholes[whole];
  require_flexible(body);
  NodalMatrix& table = displacements_[whole];
  const auto first = static_cast<std::size_t>(body.first);
  if (!body.is_divided()) return show(table, first, state.bodies[first].d);
  results::Observation now{model_, state, {}, {}, {}, {}, {}, {}, {}, {}, {}, 1.0, {}};
  now.wholes.resize(model_.wholes.size());
  now.wholes[whole] = model::whole_motion(model_, body, state);
  now.nodal.resize(state.bodies.size());
  for (int b = body.first; b < body.first + body.count; ++b) {
    const auto part = static_cast<std::size_t>(b);
    now.nodal[part] = model_.bodies[part].flexible->nodal(state.bodies[part].d);
  }
  std::vector<double> values;
  results::DividedBody(model_, body).append_displacements(now, values);
  table.resize(static_cast<Eigen::Index>(values.size()) / 6, Eigen::NoChange);
  std::copy(values.begin(), values.end(), table.data());
  return {table.data(), table.rows(), 6};
}

NodalViews::View NodalViews::velocities(std::size_t whole, const model::State& state) {
  const model::WholeBody& body = model_.wholes[whole];
  require_flexible(body);
  if (body.is_divided()) {
    throw InputError(
        fmt::format("body \"{}\" has several frames, and its nodes have a velocity "
                    "relative to each; record the velocity of markers instead",
                    body.name));
  }
  const auto first = static_cast<std::size_t>(body.first);
  return show(velocities_[whole], first, state.bodies[first].d_dot);
}

}  // namespace buckens::analysis

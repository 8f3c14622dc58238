// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/body_vibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "buckens/analysis/vibration/strain_energy_groups.h"
#include "buckens/base/errors.h"
#include "buckens/body/of_body.h"
#include "buckens/model/build/eliminate_links.h"

namespace buckens::analysis {

namespace {

// Displacements below this share of rotation × size are rounding.
constexpr double kNoDisplacement = 1e-6;

}  // namespace

double largest_motion(const fem::FeModel& fe, const linalg::Vector& d, double size) {
  double displacement = 0.0, rotation = 0.0;
  for (const std::array<int, 6>& dofs : fe.dofs.node_dofs) {
    for (std::size_t k = 0; k < 6; k += 3) {
      double square = 0.0;
      for (std::size_t a = k; a < k + 3; ++a) square += dofs[a] < 0 ? 0.0 : std::pow(d[dofs[a]], 2);
      double& largest = k == 0 ? displacement : rotation;
      largest = std::max(largest, std::sqrt(square));
    }
  }
  const double turned = size * rotation;
  return displacement > kNoDisplacement * turned ? displacement : turned;
}

VibrationReport free_body_vibrations(const model::BuiltModel& built, int whole,
                                     const body::FreeModesSettings& settings) {
  const model::WholeBody& w = built.model.wholes.at(static_cast<std::size_t>(whole));
  const body::Body& b = built.model.bodies[static_cast<std::size_t>(w.first)];
  if (!b.is_flexible()) {
    throw ModelError(fmt::format(
        "body \"{}\" is rigid: it has no free vibrations; choose a flexible body", w.name));
  }
  if (b.flexible->is_quasi_static) {
    throw ModelError(fmt::format(
        "body \"{}\" is quasi-static: it does not vibrate; remove `flexibility: quasi-static` to "
        "see its free vibrations",
        w.name));
  }
  std::unique_ptr<body::FlexiblePart> undivided;
  if (w.is_divided()) undivided = model::undivided_part(w, b.flexible->coupling);
  const body::FlexiblePart& part = undivided ? *undivided : *b.flexible;
  const double size = std::sqrt(0.5 * part.fe.shape.J0.trace() / w.mass);
  const linalg::Traffic before = linalg::Ranks::traffic();
  const auto begin = std::chrono::steady_clock::now();
  const body::FreeFreeModes modes =
      body::of_body(w.name, [&] { return body::free_free_modes(part, settings); });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

  VibrationReport out;
  out.subject = w.name;
  out.whole = whole;
  out.dof = static_cast<int>(part.num_dofs());
  out.rigid_modes = static_cast<int>(part.sieve.rank());
  out.mass = w.mass;
  out.position = model::placed_state(built.model);
  out.work = {body::to_string(modes.method),
              modes.shift,
              modes.penalty,
              modes.sweeps,
              modes.solves,
              modes.factorisations,
              modes.factor_entries,
              modes.condition,
              took.count(),
              linalg::Ranks::traffic().since(before)};
  const StrainEnergyGroups groups(part.mesh());
  out.energy_groups = groups.names();
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k) {
    const linalg::Vector shape = part.nodal(modes.shapes.col(k));
    const double largest = largest_motion(part.mesh(), shape, size);
    Vibration v;
    v.square = modes.omega[k] * modes.omega[k];
    v.frequency = modes.omega[k] / (2.0 * std::numbers::pi);
    v.generalised_mass = 1.0 / (largest * largest);
    if (modes.residual.size() > k) v.residual = modes.residual[k];
    if (modes.error.size() > k) v.error = modes.error[k];
    v.energy_shares = groups.shares(shape);
    v.shape.resize(1);
    v.shape[0].d = shape / largest;
    out.vibrations.push_back(std::move(v));
  }
  return out;
}

}  // namespace buckens::analysis

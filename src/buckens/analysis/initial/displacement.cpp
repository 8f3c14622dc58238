// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/displacement.h"

#include <fmt/format.h>

#include "buckens/analysis/initial/nodal_field.h"
#include "buckens/base/errors.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

void require_own_shape(const model::BuiltModel& built, const model::WholeBody& whole,
                       const model::InitialBodySpec& spec) {
  const body::Body& body = built.model.bodies[static_cast<std::size_t>(whole.first)];
  const model::InitialSpec& initial = built.description.initial;
  const char* why = nullptr;
  if (!body.is_flexible()) {
    why = "is rigid and has no nodes";
  } else if (body.flexible->is_quasi_static) {
    why = "is quasi-static, and its shape follows from its loads";
  } else if (initial.start == model::StartKind::static_equilibrium) {
    why = "starts in static equilibrium, which determines its shape";
  } else if (initial.preload) {
    why = "is preloaded, which finds its shape";
  }
  if (why == nullptr) return;
  throw InputError(spec.where, fmt::format("initial: body \"{}\" {}; remove `nodal-displacement`",
                                           spec.name, why));
}

void deform(const model::Model& model, const model::WholeBody& whole,
            const model::NodalDisplacementSpec& laws, model::State& state) {
  std::vector<linalg::Vector> fields;
  const auto first = static_cast<std::size_t>(whole.first);
  const auto count = static_cast<std::size_t>(whole.count);
  for (std::size_t k = 0; k < count; ++k) {
    fields.push_back(nodal_field(model.bodies[first + k],
                                 {&laws.x, &laws.y, &laws.z, &laws.rx, &laws.ry, &laws.rz}));
  }
  const std::vector<RigidShare> shares = sieve_field(model, whole, fields);
  for (std::size_t k = 0; k < count; ++k) {
    const body::Body& part = model.bodies[first + k];
    model::BodyState& s = state.bodies[first + k];
    const Vector3d u = s.frame.X_WB.q * shares[k].translation;
    s.frame.X_WB.p += part.translation_basis * (part.translation_basis.transpose() * u);
    const Vector3d turn =
        part.rotation_basis * (part.rotation_basis.transpose() * shares[k].rotation);
    s.frame.X_WB.q = (s.frame.X_WB.q * spatial::exp_rotation(turn)).normalized();
    s.d = std::move(fields[k]);
  }
}

}  // namespace

bool set_initial_displacements(const model::BuiltModel& built, model::State& state) {
  bool has_any = false;
  for (const model::InitialBodySpec& spec : built.description.initial.bodies) {
    if (!spec.nodal_displacement) continue;
    const int index = built.model.find_whole(spec.name);
    if (index < 0) {
      throw InputError(spec.where, fmt::format("initial: there is no body \"{}\"", spec.name));
    }
    const model::WholeBody& whole = built.model.wholes[static_cast<std::size_t>(index)];
    require_own_shape(built, whole, spec);
    deform(built.model, whole, *spec.nodal_displacement, state);
    has_any = true;
  }
  return has_any;
}

}  // namespace buckens::analysis

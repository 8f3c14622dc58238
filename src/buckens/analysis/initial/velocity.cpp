// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/velocity.h"

#include <fmt/format.h>

#include "buckens/analysis/initial/nodal_field.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

using Eigen::Vector3d;
using linalg::Vector;

namespace {

Vector3d within(const Eigen::Matrix<double, 3, Eigen::Dynamic>& basis, const Vector3d& v) {
  return basis * (basis.transpose() * v);
}

/// The velocities of one whole body.
class Setter {
 public:
  Setter(const model::Model& model, const model::WholeBody& whole,
         const model::InitialBodySpec& spec, model::State& state)
      : model_(model), whole_(whole), spec_(spec), state_(state) {}

  void run() {
    set_frames();
    if (!spec_.nodal_velocity) return;
    if (!body(whole_.first).is_flexible()) {
      throw InputError(
          spec_.where,
          fmt::format(
              "initial: body \"{}\" is rigid and has no nodal velocities; give `velocity` instead",
              spec_.name));
    }
    if (body(whole_.first).flexible->is_quasi_static) {
      throw InputError(spec_.where, fmt::format("initial: body \"{}\" is quasi-static, so its "
                                                "deformation has no rates; remove `nodal-velocity`",
                                                spec_.name));
    }
    set_nodes(*spec_.nodal_velocity);
  }

 private:
  const body::Body& body(int b) const { return model_.bodies[static_cast<std::size_t>(b)]; }

  template <class Work>
  void for_each_part(Work&& work) {
    for (int b = whole_.first; b < whole_.first + whole_.count; ++b) {
      work(body(b), state_.bodies[static_cast<std::size_t>(b)]);
    }
  }

  void set_frames() {
    const spatial::Pose X_WB = model::whole_motion(model_, whole_, state_).X_WB;
    const Vector3d w_W = X_WB.q * spec_.angular_velocity;
    for_each_part([&](const body::Body& part, model::BodyState& s) {
      const Vector3d v = spec_.velocity + w_W.cross(s.frame.X_WB.p - X_WB.p);
      const Vector3d w =
          whole_.is_divided() ? Vector3d(s.frame.X_WB.q.conjugate() * w_W) : spec_.angular_velocity;
      s.frame.v = within(part.translation_basis, v);
      s.frame.w = within(part.rotation_basis, w);
      if (!model_.planar || is_in_plane(v, w, s)) return;
      throw InputError(spec_.where, fmt::format("initial: body \"{}\" cannot leave the plane of "
                                                "the planar model; set the other components to "
                                                "zero",
                                                spec_.name));
    });
  }

  bool is_in_plane(const Vector3d& v, const Vector3d& w, const model::BodyState& s) const {
    const double left = (s.frame.v - v).norm() + (s.frame.w - w).norm();
    // The parts' velocities are summed: rounding.
    return left <= (whole_.is_divided() ? 1e-12 * (v.norm() + w.norm()) : 0.0);
  }

  void set_nodes(const model::NodalVelocitySpec& laws) {
    std::vector<Vector> fields;
    for_each_part([&](const body::Body& part, model::BodyState&) {
      fields.push_back(
          nodal_field(part, {&laws.x, &laws.y, &laws.z, &laws.rx, &laws.ry, &laws.rz}));
    });
    const std::vector<RigidShare> shares = sieve_field(model_, whole_, fields);
    std::size_t k = 0;
    for_each_part([&](const body::Body& part, model::BodyState& s) {
      s.frame.v += within(part.translation_basis, s.frame.X_WB.q * shares[k].translation);
      s.frame.w += within(part.rotation_basis, shares[k].rotation);
      s.d_dot = std::move(fields[k]);
      ++k;
    });
  }

  const model::Model& model_;
  const model::WholeBody& whole_;
  const model::InitialBodySpec& spec_;
  model::State& state_;
};

}  // namespace

void set_initial_velocities(const model::BuiltModel& built, model::State& state) {
  for (const model::InitialBodySpec& spec : built.description.initial.bodies) {
    const int index = built.model.find_whole(spec.name);
    if (index < 0) {
      throw InputError(spec.where, fmt::format("initial: there is no body \"{}\"", spec.name));
    }
    const model::WholeBody& whole = built.model.wholes[static_cast<std::size_t>(index)];
    Setter(built.model, whole, spec, state).run();
  }
}

}  // namespace buckens::analysis

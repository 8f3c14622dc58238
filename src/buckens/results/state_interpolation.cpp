// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/state_interpolation.h"

#include "buckens/spatial/rotation.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

/// Cubic through both ends with both rates; s in [0, 1], h the distance.
template <class V>
V hermite(const V& a, const V& a_rate, const V& b, const V& b_rate, double s, double h) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * h * a_rate + (3 * s2 - 2 * s3) * b +
         (s3 - s2) * h * b_rate;
}

template <class V>
V linear(const V& a, const V& b, double s) {
  return (1.0 - s) * a + s * b;
}

}  // namespace

model::State interpolate(const model::State& before, const model::State& after, double t) {
  const double h = after.t - before.t;
  const double s = h > 0.0 ? (t - before.t) / h : 1.0;
  model::State out;
  out.t = t;
  out.bodies.resize(after.bodies.size());
  for (std::size_t b = 0; b < after.bodies.size(); ++b) {
    const model::BodyState& x = before.bodies[b];
    const model::BodyState& y = after.bodies[b];
    model::BodyState& z = out.bodies[b];
    z.frame.X_WB.p = hermite(x.frame.X_WB.p, x.frame.v, y.frame.X_WB.p, y.frame.v, s, h);
    const Vector3d turned = spatial::log_rotation(x.frame.X_WB.q.conjugate() * y.frame.X_WB.q);
    const Vector3d psi = hermite<Vector3d>(Vector3d::Zero(), x.frame.w, turned, y.frame.w, s, h);
    z.frame.X_WB.q = x.frame.X_WB.q * spatial::exp_rotation(psi);
    z.frame.v = linear(x.frame.v, y.frame.v, s);
    z.frame.w = linear(x.frame.w, y.frame.w, s);
    z.v_dot = linear(x.v_dot, y.v_dot, s);
    z.w_dot = linear(x.w_dot, y.w_dot, s);
    z.d = hermite(x.d.whole(), x.d_dot.whole(), y.d.whole(), y.d_dot.whole(), s, h);
    z.d_dot = linear(x.d_dot.whole(), y.d_dot.whole(), s);
    z.d_ddot = linear(x.d_ddot.whole(), y.d_ddot.whole(), s);
  }
  out.lambda = multipliers_at(before, after, t);
  out.lambda_time = t;
  out.inputs = after.inputs;
  out.memory = before.memory;  // readers continue from the start of the step
  return out;
}

linalg::Vector multipliers_at(const model::State& before, const model::State& after, double t) {
  const double distance = after.lambda_time - before.lambda_time;
  if (distance <= 0.0) return after.lambda;
  return linear(before.lambda, after.lambda, (t - before.lambda_time) / distance);
}

EnergyLevels interpolate(const EnergyLevels& before, const EnergyLevels& after, double share) {
  const auto between = [share](double a, double b) { return (1.0 - share) * a + share * b; };
  EnergyLevels out;
  const dynamics::Energy &a = before.energy, &b = after.energy;
  out.energy.kinetic = between(a.kinetic, b.kinetic);
  out.energy.strain = between(a.strain, b.strain);
  out.energy.gravity = between(a.gravity, b.gravity);
  out.energy.springs = between(a.springs, b.springs);
  out.work.external = between(before.work.external, after.work.external);
  out.work.dissipated = between(before.work.dissipated, after.work.dissipated);
  out.work.parts = (1.0 - share) * before.work.parts + share * after.work.parts;
  return out;
}

}  // namespace buckens::results

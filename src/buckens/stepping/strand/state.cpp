// SPDX-License-Identifier: Apache-2.0
// Between states and the tables of a StrandMechanism.
#include <cmath>

#include "buckens/dynamics/coupling_terms.h"
#include "buckens/stepping/body_iteration.h"
#include "buckens/stepping/strand/step.h"

namespace buckens::stepping {

using Eigen::Index;
using Eigen::Vector3d;
using linalg::Vector;
using strand::BodyRows;
using strand::entry;
using strand::kLanes;
using strand::MeshRows;
using strand::Plane;
using strand::Space;

namespace {

template <class S>
void put_frame(double* at, int row, const Vector3d& rotation, const Vector3d& translation) {
  if constexpr (S::T == 2) {
    entry(at, row) = rotation.z();
  } else {
    for (int k = 0; k < 3; ++k) entry(at, row + k) = rotation[k];
  }
  for (int k = 0; k < S::T; ++k) entry(at, row + S::R + k) = translation[k];
}

template <class S>
Vector3d rotation(double* at, int row) {
  if constexpr (S::T == 2) return {0.0, 0.0, entry(at, row)};
  return {entry(at, row), entry(at, row + 1), entry(at, row + 2)};
}
template <class S>
Vector3d translation(double* at, int row) {
  return {entry(at, row), entry(at, row + 1), S::T == 2 ? 0.0 : entry(at, row + 2)};
}

/// An inertia in the order of the tables.
template <class S>
void put_inertia(double* at, int row, const Eigen::Matrix3d& J) {
  if constexpr (S::T == 2) {
    entry(at, row) = J(2, 2);
    entry(at, row + 1) = J(0, 0);
    entry(at, row + 2) = J(1, 1);
    entry(at, row + 3) = J(0, 1);
  } else {
    for (int k = 0; k < 3; ++k) entry(at, row + k) = J(k, k);
    entry(at, row + 3) = J(0, 1);
    entry(at, row + 4) = J(0, 2);
    entry(at, row + 5) = J(1, 2);
  }
}
template <class S>
Eigen::Matrix3d inertia(double* at, int row) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  if constexpr (S::T == 2) {
    out(2, 2) = entry(at, row);
    out(0, 0) = entry(at, row + 1);
    out(1, 1) = entry(at, row + 2);
    out(0, 1) = out(1, 0) = entry(at, row + 3);
  } else {
    for (int k = 0; k < 3; ++k) out(k, k) = entry(at, row + k);
    out(0, 1) = out(1, 0) = entry(at, row + 3);
    out(0, 2) = out(2, 0) = entry(at, row + 4);
    out(1, 2) = out(2, 1) = entry(at, row + 5);
  }
  return out;
}

void put(double* at, int row, const std::vector<int>& order, const Vector& values) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    entry(at, row + order[i]) = values[static_cast<Index>(i)];
  }
}
void take(double* at, int row, const std::vector<int>& order, linalg::NodalVector& nodal) {
  Vector& values = nodal.overwrite(std::ssize(order));
  for (std::size_t i = 0; i < order.size(); ++i) {
    values[static_cast<Index>(i)] = entry(at, row + order[i]);
  }
}

}  // namespace

model::Coupling& StrandStep::extrapolated(const model::State& state, std::size_t b) {
  const model::BodyState& s = state.bodies[b];
  if (state.history > 0) {
    dynamics::extrapolate(s, state.history, scheme_.evaluation_time(state.t), coupling_);
  } else {
    dynamics::evaluate_coupling(model_.bodies[b], s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w,
                                s.w_dot, coupling_);
  }
  return coupling_;
}

template <class S>
void StrandStep::load_mesh(const model::State& state, std::size_t b) {
  using Row = MeshRows<S>;
  double* const at = mechanism_.body(b).at;
  const model::BodyState& s = state.bodies[b];
  const std::vector<int>& order = mechanism_.order(b);
  put(at, Row::d, order, s.d);
  put(at, Row::d1, order, s.d_dot);
  put(at, Row::d2, order, s.d_ddot);
  put(at, Row::da, order, s.d_alg);
  const model::Coupling& used = extrapolated(state, b);
  put(at, Row::load, order, used.load);
  put_inertia<S>(at, Row::J2, used.moments.J);
  put_inertia<S>(at, Row::Jd2, used.moments.J_dot);
  const Vector3d& l = used.moments.l;
  const Vector3d& l_dot = used.moments.l_dot;
  for (int k = 0; k < S::R; ++k) {
    entry(at, Row::l + k) = S::R == 1 ? l.z() : l[k];
    entry(at, Row::ld + k) = S::R == 1 ? l_dot.z() : l_dot[k];
  }
}

template <class S>
void StrandStep::load_body(const model::State& state, std::size_t b) {
  using Row = BodyRows<S>;
  double* const at = mechanism_.body(b).at;
  const model::BodyState& s = state.bodies[b];
  const Eigen::Quaterniond& q = s.frame.X_WB.q;
  entry(at, Row::q) = q.w();
  if constexpr (S::T == 2) {
    entry(at, Row::q + 1) = q.z();
  } else {
    for (int k = 0; k < 3; ++k) entry(at, Row::q + 1 + k) = q.vec()[k];
  }
  for (int k = 0; k < S::T; ++k) entry(at, Row::p + k) = s.frame.X_WB.p[k];
  put_frame<S>(at, Row::rate, s.frame.w, s.frame.v);
  put_frame<S>(at, Row::accel, s.w_dot, s.v_dot);
  put_frame<S>(at, Row::alg, s.w_alg, s.v_alg);
  if (mechanism_.body(b).has_mesh) load_mesh<S>(state, b);
}

template <class S>
void StrandStep::load_block(const model::State& state, std::size_t block) {
  for (const std::size_t b : mechanism_.members(block)) load_body<S>(state, b);
  kernels_.start(mechanism_.constants(), mechanism_.body_blocks()[block]);
  move_body(block);
}

template <class S>
double StrandStep::rounding_length() const {
  double out = model_.length;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    double* const at = mechanism_.body(b).at;
    for (int k = 0; k < S::T; ++k) {
      out = std::max(out, std::abs(entry(at, BodyRows<S>::pe + k)));
    }
  }
  return out;
}

template <class S>
void StrandStep::apply_forecast(const model::State& state) {
  using Row = BodyRows<S>;
  const Forecast::Parabola weights = forecast_.parabola(state);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    double* const at = mechanism_.body(b).at;
    const Vector6 foretold = Forecast::acceleration(state, weights, b);
    put_frame<S>(at, Row::u, foretold.head<3>(), foretold.tail<3>());
    for (int k = 0; k < S::F; ++k) {
      entry(at, Row::u + k) =
          (entry(at, Row::u + k) - entry(at, Row::acc + k)) / scheme_.acceleration_rate;
    }
  }
  Forecast::foretell_multipliers(state, weights, lambda_);
}

template <class S>
void StrandStep::write_mesh(const model::State& state, std::size_t b, model::BodyState& out) const {
  using Row = MeshRows<S>;
  double* const at = mechanism_.body(b).at;
  const std::vector<int>& order = mechanism_.order(b);
  take(at, Row::nd, order, out.d);
  take(at, Row::nd1, order, out.d_dot);
  take(at, Row::nd2, order, out.d_ddot);
  take(at, Row::nda, order, out.d_alg);
  model::Coupling& coupling = out.coupling;
  coupling.t = scheme_.evaluation_time(state.t);
  take(at, Row::eload, order, coupling.load);
  coupling.moments.J = inertia<S>(at, Row::eJ2);
  coupling.moments.J_dot = inertia<S>(at, Row::eJd2);
  coupling.moments.l = rotation<S>(at, Row::el);
  coupling.moments.l_dot = rotation<S>(at, Row::eld);
  out.coupling_before = state.bodies[b].coupling;
  out.coupling_earlier = state.bodies[b].coupling_before;
}

template <class S>
void StrandStep::write(const model::State& state, model::State& next) {
  using Row = BodyRows<S>;
  next.bodies.resize(model_.bodies.size());
  next.lambda = lambda_;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    double* const at = mechanism_.body(b).at;
    const model::BodyState& old = state.bodies[b];
    model::BodyState& s = next.bodies[b];
    const auto q = [&](int k) { return entry(at, Row::qe + k); };
    if constexpr (S::T == 2) {
      s.frame.X_WB.q = Eigen::Quaterniond(q(0), 0.0, 0.0, q(1));
      s.frame.X_WB.p = {entry(at, Row::pe), entry(at, Row::pe + 1), old.frame.X_WB.p.z()};
    } else {
      s.frame.X_WB.q = Eigen::Quaterniond(q(0), q(1), q(2), q(3));
      s.frame.X_WB.p = translation<S>(at, Row::pe);
    }
    s.frame.w = rotation<S>(at, Row::we);
    s.frame.v = translation<S>(at, Row::ve);
    s.w_dot = scheme_.acceleration_rate * rotation<S>(at, Row::u) + rotation<S>(at, Row::acc);
    s.v_dot = scheme_.acceleration_rate * translation<S>(at, Row::u + S::R) +
              translation<S>(at, Row::acc + S::R);
    s.w_alg = scheme_.algorithmic(old.w_dot, old.w_alg, s.w_dot);
    s.v_alg = scheme_.algorithmic(old.v_dot, old.v_alg, s.v_dot);
    s.terms = old.terms;
    const bool has_mesh = mechanism_.body(b).has_mesh;
    if (has_mesh) write_mesh<S>(state, b, s);
    if (is_touched_[b] == 0) continue;
    motions_[b].frame = s.frame;
    if (!has_mesh) continue;
    motions_[b].y = model_.bodies[b].row_values(s.d);
    motions_[b].y_dot = model_.bodies[b].row_values(s.d_dot);
  }
}

template void StrandStep::load_block<Plane>(const model::State&, std::size_t);
template void StrandStep::load_block<Space>(const model::State&, std::size_t);
template double StrandStep::rounding_length<Plane>() const;
template double StrandStep::rounding_length<Space>() const;
template void StrandStep::apply_forecast<Plane>(const model::State&);
template void StrandStep::apply_forecast<Space>(const model::State&);
template void StrandStep::write<Plane>(const model::State&, model::State&);
template void StrandStep::write<Space>(const model::State&, model::State&);

}  // namespace buckens::stepping

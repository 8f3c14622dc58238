// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/strand/motion_impl.h"

// Included by the sources kernels_*.cpp only. Equations of motion of blocks of bodies
// (docs/theory/05-time-integration.md) for eight bodies at once.
namespace buckens::stepping::strand {
namespace {

/// Moments of the frame equation.
template <class S>
struct Moments {
  Numbers<S::J> J, J_dot;
  Numbers<S::R> l, l_dot;
};

template <class S>
BUCKENS_LANES Numbers<S::P> doubled(const Numbers<S::P>& z) {
  Numbers<S::P> out = z;
#pragma GCC unroll 3
  for (int k = 0; k < S::T; ++k) out[k] = 2.0 * z[k];
  return out;
}

template <class S, bool HasMesh>
BUCKENS_LANES Moments<S> moments(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  const double* const t = block.rows;
  using In = Of<S>;
  Moments<S> out;
  out.J = take<S::J>(t, Row::J0);
  if constexpr (HasMesh) {
    constexpr int N = Row::N;
    const auto end = take<N>(t, Row::end);
    const auto d = end + take<N>(t, Row::dc);
    const auto rate = is.s1 * (end - take<N>(t, Row::d)) + take<N>(t, Row::dv);
    out.J = out.J + take<S::J>(t, Row::J2) +
            is.jvar * In::to_inertia(doubled<S>(product<S::P>(block.fixed, FixedRows<S>::pat, d)));
    out.J_dot = take<S::J>(t, Row::Jd2) + is.cor_ref * In::to_inertia(doubled<S>(product<S::P>(
                                                           block.fixed, FixedRows<S>::pat, rate)));
    out.l = take<S::R>(t, Row::l);
    out.l_dot = take<S::R>(t, Row::ld);
  } else {
    out.J_dot = {};
    out.l = {};
    out.l_dot = {};
  }
  return out;
}

template <class S, bool HasMesh>
void freeze_block(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  using In = Of<S>;
  give(t, Row::turn0, take<S::M>(t, Row::turn));
  give(t, Row::zf, take<kSlots * S::T>(t, Row::z));
  if constexpr (HasMesh) {
    give(t, Row::jlf, take<kSlots * S::R * S::R>(t, Row::jl));
  }
  const Moments<S> of = moments<S, HasMesh>(is, block);
  const auto w = take<S::R>(t, Row::we);
  give(t, Row::W,
       In::invert_tangent(of.J, of.J_dot, w, In::inertia(of.J, w) + of.l, is.mass, is.damping));
}

template <class S>
void freeze(const Constants& is, BodyBlock& block) {
  block.has_mesh ? freeze_block<S, true>(is, block) : freeze_block<S, false>(is, block);
}

/// Load on the frame by loads on markers; on nodes too where there are some.
template <class S, bool HasMesh, bool AtMatrix>
BUCKENS_LANES void load_of_slots(double* t, Numbers<S::F>& frame,
                                 Numbers<HasMesh ? MeshRows<S>::N : 1>& nodes) {
  using Row = MeshRows<S>;
  using Slot = SlotRows<S>;
  using In = Of<S>;
  const auto A = take<S::M>(t, AtMatrix ? Row::turn0 : Row::turn);
#pragma GCC unroll 2
  for (int k = 0; k < kSlots; ++k) {
    const int slot = slot_rows<S>(k);
    const auto force = take<S::T>(t, slot + Slot::f);
    const auto f = In::back(A, force);
    const auto m = In::back_rotation(A, take<S::R>(t, slot + Slot::m));
    const auto arm = In::cross(take<S::T>(t, (AtMatrix ? Row::zf : Row::z) + k * S::T), f);
#pragma GCC unroll 3
    for (int i = 0; i < S::R; ++i) frame[i] += m[i] + arm[i];
#pragma GCC unroll 3
    for (int i = 0; i < S::T; ++i) frame[S::R + i] += force[i];
    if constexpr (HasMesh) {
      const auto jl = take<S::R * S::R>(t, (AtMatrix ? Row::jlf : Row::jl) + k * S::R * S::R);
      const auto turning = In::left_transposed(jl, m);
#pragma GCC unroll 3
      for (int i = 0; i < S::T; ++i) nodes[k * S::F + i] = f[i];
#pragma GCC unroll 3
      for (int i = 0; i < S::R; ++i) nodes[k * S::F + S::T + i] = turning[i];
    }
    clear<S::F>(t, slot + Slot::f);
  }
}

template <class S, bool HasMesh>
void collect_block(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  Numbers<S::F> frame = {};
  if (block.has_given) {
    frame = take<S::F>(t, Row::given);
  } else {
    const Lanes mass = load(t, Row::mass);
#pragma GCC unroll 3
    for (int i = 0; i < S::T; ++i) frame[S::R + i] = mass * is.gravity[i];
  }
  Numbers<HasMesh ? Row::N : 1> nodes;
  load_of_slots<S, HasMesh, false>(t, frame, nodes);
  give(t, Row::fr, frame);
  if constexpr (HasMesh) {
    if (block.has_given) nodes = nodes + take<Row::N>(t, Row::given_nodes);
    const auto weights = is.cent0 * Of<S>::centrifugal(take<S::R>(t, Row::we));
    nodes = nodes + transposed_product<S::P, Row::N>(block.fixed, FixedRows<S>::pat, weights);
    give(t, Row::f, symmetric_product(block.fixed, FixedRows<S>::A, is.c * nodes));
  }
}

template <class S>
void collect(const Constants& is, BodyBlock& block) {
  block.has_mesh ? collect_block<S, true>(is, block) : collect_block<S, false>(is, block);
}

/// W⁻¹ f.
template <class S>
BUCKENS_LANES Numbers<S::F> frame_answer(const double* t, const Numbers<S::F>& f) {
  using Row = BodyRows<S>;
  Numbers<S::R> moment;
#pragma GCC unroll 3
  for (int i = 0; i < S::R; ++i) moment[i] = f[i];
  const auto turned = product<S::R>(t, Row::W, moment);
  const Lanes tau = load(t, Row::tau);
  Numbers<S::F> out;
#pragma GCC unroll 3
  for (int i = 0; i < S::R; ++i) out[i] = turned[i];
#pragma GCC unroll 3
  for (int i = 0; i < S::T; ++i) out[S::R + i] = tau * f[S::R + i];
  return out;
}

/// Rotations count by L.
template <class S>
BUCKENS_LANES Lanes frame_size(const Numbers<S::F>& u, double L) {
  Lanes turned = absolute(u[0]);
#pragma GCC unroll 3
  for (int i = 1; i < S::R; ++i) turned = larger(turned, absolute(u[i]));
  Lanes shifted = absolute(u[S::R]);
#pragma GCC unroll 3
  for (int i = 1; i < S::T; ++i) shifted = larger(shifted, absolute(u[S::R + i]));
  return larger(L * turned, shifted);
}
template <class S>
BUCKENS_LANES Lanes node_size(const BodyBlock& block, const Numbers<MeshRows<S>::N>& x, double L) {
  using Row = MeshRows<S>;
  Lanes out = largest_of(product<S::P>(block.fixed, FixedRows<S>::pat, x)) *
              load(block.fixed, FixedRows<S>::per_pattern);
#pragma GCC unroll 2
  for (int k = 0; k < kSlots; ++k) {
    const Lanes seen = load(block.rows, Row::seen + k);
#pragma GCC unroll 3
    for (int i = 0; i < S::T; ++i) out = larger(out, seen * absolute(x[k * S::F + i]));
#pragma GCC unroll 3
    for (int i = S::T; i < S::F; ++i) out = larger(out, L * seen * absolute(x[k * S::F + i]));
  }
  return out;
}

template <class S, bool HasMesh>
double find_residual_of_block(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  using In = Of<S>;
  const auto u = take<S::F>(t, Row::u);
  const auto acceleration = is.s2 * u + take<S::F>(t, Row::acc);
  Numbers<S::R> w_dot;
#pragma GCC unroll 3
  for (int i = 0; i < S::R; ++i) w_dot[i] = acceleration[i];
  const auto w = take<S::R>(t, Row::we);
  const Moments<S> of = moments<S, HasMesh>(is, block);
  const auto inertia = In::inertia(of.J, w_dot) + of.l_dot + In::inertia(of.J_dot, w) +
                       In::gyrate(w, In::inertia(of.J, w) + of.l);
  auto open = take<S::F>(t, Row::fr);
  const Lanes mass = load(t, Row::mass);
#pragma GCC unroll 3
  for (int i = 0; i < S::R; ++i) open[i] -= inertia[i];
#pragma GCC unroll 3
  for (int i = 0; i < S::T; ++i) open[S::R + i] -= mass * acceleration[S::R + i];
  const auto residual = frame_answer<S>(t, is.c * open);
  give(t, Row::res, residual);
  Lanes size = frame_size<S>(residual, is.L);
  if constexpr (HasMesh) {
    constexpr int N = Row::N;
    const auto moving =
        take<N>(t, Row::free) - take<N>(t, Row::end) + take<N>(t, Row::f) + take<N>(t, Row::be);
    give(t, Row::mov, moving);
    size = larger(size, node_size<S>(block, moving, is.L));
  }
  return largest(size);
}

template <class S>
double find_residual(const Constants& is, BodyBlock& block) {
  return block.has_mesh ? find_residual_of_block<S, true>(is, block)
                        : find_residual_of_block<S, false>(is, block);
}

template <class S, bool HasMesh>
void correct_block(const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  using Slot = SlotRows<S>;
  using In = Of<S>;
  Numbers<S::F> frame = {};
  Numbers<HasMesh ? Row::N : 1> nodes;
  load_of_slots<S, HasMesh, true>(t, frame, nodes);
  give(t, Row::cu, frame_answer<S>(t, frame));
  if constexpr (HasMesh) {
    constexpr int N = Row::N;
    const auto shift = symmetric_product(block.fixed, FixedRows<S>::A, nodes);
    const auto strain = symmetric_product(block.fixed, FixedRows<S>::B, nodes);
    give(t, Row::dc, take<N>(t, Row::dc) + shift);
    give(t, Row::be, take<N>(t, Row::be) + strain);
    give(t, Row::mov, take<N>(t, Row::mov) + strain);
  }
  const auto A = take<S::M>(t, Row::turn0);
  const auto turned = rotation_of<S>(t, Row::res);
  const auto shifted = translation_of<S>(t, Row::res);
#pragma GCC unroll 2
  for (int k = 0; k < kSlots; ++k) {
    const int slot = slot_rows<S>(k);
    auto dz = In::swing(turned, take<S::T>(t, Row::zf + k * S::T));
    auto spin = turned;
    if constexpr (HasMesh) {
      dz = dz + take<S::T>(t, Row::mov + k * S::F);
      spin = spin + In::left(take<S::R * S::R>(t, Row::jlf + k * S::R * S::R),
                             take<S::R>(t, Row::mov + k * S::F + S::T));
    }
    give(t, slot + Slot::dp, shifted + In::turn(A, dz));
    give(t, slot + Slot::dr, In::turn_rotation(A, spin));
  }
}

template <class S>
void correct(const Constants&, BodyBlock& block) {
  block.has_mesh ? correct_block<S, true>(block) : correct_block<S, false>(block);
}

template <class S, bool HasMesh>
Largest advance_block(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  Numbers<S::F> frame = {};
  Numbers<HasMesh ? Row::N : 1> nodes;
  load_of_slots<S, HasMesh, true>(t, frame, nodes);
  const auto du = take<S::F>(t, Row::res) + frame_answer<S>(t, frame);
  const auto cu = take<S::F>(t, Row::cu);
  const auto u = take<S::F>(t, Row::u) + du;
  give(t, Row::u, u);
  give(t, Row::corr, take<S::F>(t, Row::corr) + cu);
  Largest out;
  out.frame = largest(frame_size<S>(du, is.L) + frame_size<S>(cu, is.L));
  out.motion = largest(frame_size<S>(u, is.L));
  if constexpr (HasMesh) {
    constexpr int N = Row::N;
    const auto change =
        take<N>(t, Row::mov) + symmetric_product(block.fixed, FixedRows<S>::A, nodes);
    give(t, Row::end, take<N>(t, Row::end) + change);
    out.interface = largest(node_size<S>(block, change, is.L));
  }
  return out;
}

template <class S>
Largest advance(const Constants& is, BodyBlock& block) {
  return block.has_mesh ? advance_block<S, true>(is, block) : advance_block<S, false>(is, block);
}

template <class S>
void complete(const Constants& is, BodyBlock& block) {
  if (!block.has_mesh) return;
  using Row = MeshRows<S>;
  constexpr int N = Row::N;
  double* const t = block.rows;
  const auto d = take<N>(t, Row::d);
  const auto increment = take<N>(t, Row::free) - d + take<N>(t, Row::f) + take<N>(t, Row::be);
  give(t, Row::nd, d + increment + take<N>(t, Row::dc));
  give(t, Row::nd1, is.s1 * increment + take<N>(t, Row::dv));
  const auto acceleration =
      is.s2 * increment + combination<N>(is.acceleration, t, -1, Row::d1, Row::d2, Row::da);
  give(t, Row::nd2, acceleration);
  give(t, Row::nda,
       is.alg_new * acceleration + is.alg_before * take<N>(t, Row::d2) +
           is.alg_old * take<N>(t, Row::da));
}

}  // namespace
}  // namespace buckens::stepping::strand

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/strand/bodies_impl.h"

// Included by the sources kernels_*.cpp only. Inertial coupling of eight parts at once, as
// body::evaluate_deformation and LaggedCoupling do it for one.
namespace buckens::stepping::strand {
namespace {

/// One pass over the integrals of a block: T_ab(x, y) = xᵀ W_ab y and the loads.
template <class S>
struct DeformationPass {
  using Row = MeshRows<S>;
  static constexpr int T = S::T;
  Lanes dd[T][T] = {}, dv[T][T] = {}, da[T][T] = {};
  Lanes with_d[T][T] = {}, with_rate[T][T] = {};
  Numbers<Row::N> load_ = {};

  void run(const BodyBlock& block) {
    const double* const t = block.rows;
    for (int k = 0; k < block.num_columns; ++k) {
      const IntegralColumn& column = block.columns[k];
      const int a = column.a, b = column.b, j = column.column;
      const Lanes d = load(t, Row::nd + j), v = load(t, Row::nd1 + j), w = load(t, Row::nd2 + j);
      const Lanes spread = with_d[a][b] * d + with_rate[a][b] * v;
      Lanes Wd = {}, Wv = {}, Wa = {};
      for (int e = column.first; e < column.end; ++e) {
        const int i = block.entries[e];
        const Lanes value = load(block.values, e);
        Wd += value * load(t, Row::nd + i);
        Wv += value * load(t, Row::nd1 + i);
        Wa += value * load(t, Row::nd2 + i);
        load_[i] += spread * value;
      }
      dd[a][b] += Wd * d;
      dv[a][b] += Wd * v;
      da[a][b] += Wd * w;
      if (a == b) continue;
      dd[b][a] = dd[a][b];
      dv[b][a] += Wv * d;
      da[b][a] += Wa * d;
      load_[j] += with_d[b][a] * Wd + with_rate[b][a] * Wv;
    }
  }
};

template <class S>
void evaluate_coupling(const Constants& is, BodyBlock& block) {
  if (!block.has_mesh) return;
  using Row = MeshRows<S>;
  using In = Of<S>;
  constexpr int N = Row::N;
  double* const t = block.rows;
  const auto w = take<S::R>(t, Row::we);
  const auto w_dot = is.s2 * rotation_of<S>(t, Row::u) + rotation_of<S>(t, Row::acc);
  DeformationPass<S> pass;
  In::add_centrifugal(is.cent1, w, pass.with_d);
  In::add_skew(-is.eul_fe, w_dot, pass.with_d);
  In::add_skew(-2.0 * is.cor_fe, w, pass.with_rate);
  pass.run(block);
  const auto J2 = (is.quad_ref * is.jvar) * In::to_inertia(In::symmetric(pass.dd));
  const auto Jd2 = (is.quad_ref * is.cor_ref) * In::to_inertia(In::twice_symmetric(pass.dv));
  const auto l = is.quad_ref * In::axial(pass.dv);
  const auto l_dot = is.quad_ref * In::axial(pass.da);
  give(t, Row::eJ2, J2);
  give(t, Row::eJd2, Jd2);
  give(t, Row::el, l);
  give(t, Row::eld, l_dot);
  give(t, Row::eload, pass.load_);

  const auto change = pass.load_ - take<N>(t, Row::load);
  Lanes changed = {}, size = {}, moved = {};
#pragma GCC unroll 12
  for (int i = 0; i < N; ++i) {
    const Lanes inverse = load(block.fixed, FixedRows<S>::inverse + i);
    changed += change[i] * change[i] * inverse;
    size += pass.load_[i] * pass.load_[i] * inverse;
    moved = larger(moved, absolute(change[i] * load(block.fixed, FixedRows<S>::per_load + i)));
  }
  const auto weights = is.cent0 * In::centrifugal(w);
  size += dot(weights, product<S::P>(block.fixed, FixedRows<S>::und, weights));
  store(t, Row::changed, changed);
  store(t, Row::size, size);
  store(t, Row::moved, is.c * moved);
  const auto J_change = J2 - take<S::J>(t, Row::J2);
  const auto l_change = l - take<S::R>(t, Row::l);
  const auto frame_change = In::inertia(J_change, w_dot) + (l_dot - take<S::R>(t, Row::ld)) +
                            In::inertia(Jd2 - take<S::J>(t, Row::Jd2), w) +
                            In::gyrate(w, In::inertia(J_change, w) + l_change);
  give(t, Row::fc, frame_change);
  give(t, Row::turned, is.c * product<S::R>(t, Row::W, frame_change));
}

template <class S>
void take_over(const Constants& is, BodyBlock& block) {
  if (!block.has_mesh) return;
  using Row = MeshRows<S>;
  constexpr int N = Row::N;
  double* const t = block.rows;
  give(t, Row::J2, take<S::J>(t, Row::eJ2));
  give(t, Row::Jd2, take<S::J>(t, Row::eJd2));
  give(t, Row::l, take<S::R>(t, Row::el));
  give(t, Row::ld, take<S::R>(t, Row::eld));
  const Lanes mask = load(t, Row::mask);
  const auto used = take<N>(t, Row::load);
  const auto change = scaled(mask, take<N>(t, Row::eload) - used);
  // What is taken over becomes what is compared with, to the last bit.
  for (int i = 0; i < N; ++i) {
    store(t, Row::load + i, mask != 0.0 ? load(t, Row::eload + i) : used[i]);
  }
  give(t, Row::free,
       take<N>(t, Row::free) + symmetric_product(block.fixed, FixedRows<S>::A, is.c * change));
}

}  // namespace
}  // namespace buckens::stepping::strand

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/strand/rotations.h"

// Included by the sources kernels_*.cpp only. Start of a step and motion at its end, for
// eight bodies at once (docs/theory/05-time-integration.md).
namespace buckens::stepping::strand {
namespace {

template <class S>
constexpr int slot_rows(int slot) {
  return BodyRows<S>::slots + slot * SlotRows<S>::count;
}

/// Takes the rigid motion out of x.
template <class S>
BUCKENS_LANES void sieve(const double* fixed, Numbers<MeshRows<S>::N>& x) {
  Numbers<S::F> amplitude;
  for (int k = 0; k < S::F; ++k) {
    amplitude[k] = dot(take<FixedRows<S>::N>(fixed, FixedRows<S>::Pi + k * FixedRows<S>::N), x);
  }
  for (int k = 0; k < S::F; ++k) {
    x = x -
        scaled(amplitude[k], take<FixedRows<S>::N>(fixed, FixedRows<S>::Phi + k * FixedRows<S>::N));
  }
}

template <class S>
void start_mesh(const Constants& is, const BodyBlock& block) {
  using Row = MeshRows<S>;
  double* const t = block.rows;
  constexpr int N = Row::N;
  const auto past = [&](const Weights& w, bool with_d) {
    return combination<N>(w, t, with_d ? Row::d : -1, Row::d1, Row::d2, Row::da);
  };
  give(t, Row::dv, past(is.velocity, false));
  give(t, Row::end, take<N>(t, Row::d) + past(is.predicted, false));
  const Numbers<N> side =
      symmetric_product(block.fixed, FixedRows<S>::Mass, past(is.with_mass, true)) +
      is.side_load * take<N>(t, Row::load);
  Numbers<N> free = symmetric_product(block.fixed, FixedRows<S>::A, side);
  if (is.is_damped) {
    free = free + past(is.beside, true);
    sieve<S>(block.fixed, free);
  }
  give(t, Row::free, free);
  clear<N>(t, Row::f);
  clear<N>(t, Row::dc);
  clear<N>(t, Row::be);
}

template <class S>
void start(const Constants& is, BodyBlock& block) {
  using Row = BodyRows<S>;
  double* const t = block.rows;
  const auto past = [&](const Weights& w) {
    return combination<S::F>(w, t, -1, Row::rate, Row::accel, Row::alg);
  };
  give(t, Row::vel, past(is.velocity));
  give(t, Row::acc, past(is.acceleration));
  give(t, Row::u, past(is.predicted));
  clear<S::F>(t, Row::corr);
  if (block.has_mesh) start_mesh<S>(is, block);
}

/// First S::R or S::T of a frame vector.
template <class S>
BUCKENS_LANES Numbers<S::R> rotation_of(const double* t, int row) {
  return take<S::R>(t, row);
}
template <class S>
BUCKENS_LANES Numbers<S::T> translation_of(const double* t, int row) {
  return take<S::T>(t, row + S::R);
}

template <class S, bool HasMesh>
double move_block(const Constants& is, double* t) {
  using Row = MeshRows<S>;
  using Slot = SlotRows<S>;
  using In = Of<S>;
  Lanes furthest;
  const auto u_turn = rotation_of<S>(t, Row::u);
  const auto u_shift = translation_of<S>(t, Row::u);
  Numbers<S::Q> q = In::product(take<S::Q>(t, Row::q),
                                In::half_turn(u_turn + rotation_of<S>(t, Row::corr), furthest));
  normalize(q);
  const auto A = In::matrix(q);
  const auto p = take<S::T>(t, Row::p) + (u_shift + translation_of<S>(t, Row::corr));
  const auto w = is.s1 * u_turn + rotation_of<S>(t, Row::vel);
  const auto v = is.s1 * u_shift + translation_of<S>(t, Row::vel);
  give(t, Row::qe, q);
  give(t, Row::turn, A);
  give(t, Row::pe, p);
  give(t, Row::we, w);
  give(t, Row::ve, v);
#pragma GCC unroll 2
  for (int k = 0; k < kSlots; ++k) {
    const int slot = slot_rows<S>(k);
    auto z = take<S::T>(t, Row::z0 + k * S::T);
    auto z_dot = In::swing(w, z);
    auto spin = w;
    auto axes = A;
    if constexpr (HasMesh) {
      const int node = k * S::F;
      const auto moved = take<S::T>(t, Row::end + node);
      const auto moving =
          is.s1 * (moved - take<S::T>(t, Row::d + node)) + take<S::T>(t, Row::dv + node);
      z = z + (moved + take<S::T>(t, Row::dc + node));
      z_dot = moving + In::swing(w, z);
      const int turning = node + S::T;
      const auto turned = take<S::R>(t, Row::end + turning);
      const auto rate =
          is.s1 * (turned - take<S::R>(t, Row::d + turning)) + take<S::R>(t, Row::dv + turning);
      Lanes far;
      Numbers<S::R * S::R> jl;
      axes = In::turned_by(A, turned + take<S::R>(t, Row::dc + turning), far, jl);
      furthest = larger(furthest, far);
      spin = w + In::left(jl, rate);
      give(t, Row::jl + k * S::R * S::R, jl);
    }
    give(t, Row::z + k * S::T, z);
    give(t, slot + Slot::p, p + In::turn(A, z));
    give(t, slot + Slot::v, v + In::turn(A, z_dot));
    give(t, slot + Slot::axes, axes);
    give(t, slot + Slot::w, In::turn_rotation(A, spin));
    clear<S::F>(t, slot + Slot::f);
  }
  return largest(furthest);
}

template <class S>
double move(const Constants& is, BodyBlock& block) {
  return block.has_mesh ? move_block<S, true>(is, block.rows)
                        : move_block<S, false>(is, block.rows);
}

}  // namespace
}  // namespace buckens::stepping::strand

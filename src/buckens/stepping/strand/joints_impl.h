// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/strand/coupling_impl.h"

// Included by the sources kernels_*.cpp only. Blocks of joints: rows of eight joints at
// once, as dynamics::JointSet and MultiplierCondensation have them for one.
namespace buckens::stepping::strand {
namespace {

/// What f says of every lane.
template <class F>
BUCKENS_LANES Lanes of_lanes(F&& f) {
  static_assert(kLanes == 8);
  return Lanes{f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)};
}
/// The same row of a table per lane, each lane's table being another.
template <class Table>
BUCKENS_LANES Lanes gather_row(Table* const (&from)[kLanes], int row) {
  return of_lanes([&](int lane) { return from[lane][static_cast<std::ptrdiff_t>(kLanes) * row]; });
}
template <int K, class Table>
BUCKENS_LANES Numbers<K> gather(Table* const (&from)[kLanes], int row) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = gather_row(from, row + k);
  return out;
}
/// Rows of a slot; every lane may use another.
template <int K, class Table>
BUCKENS_LANES Numbers<K> gather_of_slot(Table* const (&from)[kLanes], const int (&which)[kLanes],
                                        int row, int per_slot) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) {
    out[k] = of_lanes([&](int lane) {
      return from[lane][static_cast<std::ptrdiff_t>(kLanes) * (row + which[lane] * per_slot + k)];
    });
  }
  return out;
}

/// Adds forces and moments to the markers at both ends.
template <class S>
BUCKENS_LANES void load_markers(const JointBlock& block, const Numbers<S::T>& force,
                                const Numbers<S::R>& moment) {
  using Slot = SlotRows<S>;
  for (int lane = 0; lane < block.num_lanes; ++lane) {
    double* const first = block.slot[0][lane];
    double* const second = block.slot[1][lane];
    for (int i = 0; i < S::T; ++i) {
      first[kLanes * (Slot::f + i)] -= force[i][lane];
      second[kLanes * (Slot::f + i)] += force[i][lane];
    }
    if (block.num_directions == 0) continue;
    for (int i = 0; i < S::R; ++i) {
      first[kLanes * (Slot::m + i)] += moment[i][lane];
      second[kLanes * (Slot::m + i)] -= moment[i][lane];
    }
  }
}

BUCKENS_LANES void put(const JointBlock& block, int row, const Lanes& value, double* out) {
  for (int lane = 0; lane < block.num_lanes; ++lane) out[block.first_row[lane] + row] = value[lane];
}
BUCKENS_LANES Lanes get(const JointBlock& block, int row, const double* x) {
  Lanes out = {};
  for (int lane = 0; lane < block.num_lanes; ++lane) out[lane] = x[block.first_row[lane] + row];
  return out;
}

/// b × c as a rotation.
template <class S>
BUCKENS_LANES Numbers<S::R> normal_of(const Numbers<S::T>& b, const Numbers<S::T>& c) {
  return Of<S>::cross(b, c);
}

template <class S>
void evaluate_joints(JointBlock& block, double* g, double* g_dot) {
  using Row = JointRows<S>;
  using Slot = SlotRows<S>;
  using In = Of<S>;
  double* const t = block.rows;
  const auto apart = gather<S::T>(block.slot[1], Slot::p) - gather<S::T>(block.slot[0], Slot::p);
  const auto parting = gather<S::T>(block.slot[1], Slot::v) - gather<S::T>(block.slot[0], Slot::v);
  for (int i = 0; i < S::T; ++i) {
    put(block, i, apart[i], g);
    put(block, i, parting[i], g_dot);
  }
  Numbers<S::R> moment = {};
  if (block.num_directions > 0) {
    const auto first = gather<S::M>(block.slot[0], Slot::axes);
    const auto second = gather<S::M>(block.slot[1], Slot::axes);
    const auto spin = gather<S::R>(block.slot[0], Slot::w) - gather<S::R>(block.slot[1], Slot::w);
    for (int k = 0; k < block.num_directions; ++k) {
      const auto b = In::turn(first, take<S::T>(t, Row::b + k * S::T));
      const auto c = In::turn(second, take<S::T>(t, Row::c + k * S::T));
      const auto x = normal_of<S>(b, c);
      give(t, Row::x + k * S::R, x);
      put(block, S::T + k, dot(b, c), g);
      put(block, S::T + k, dot(x, spin), g_dot);
      moment = moment + scaled(load(t, Row::lambda + S::T + k), x);
    }
  }
  load_markers<S>(block, take<S::T>(t, Row::lambda), moment);
}

template <class S>
void freeze_joints(JointBlock& block) {
  using Row = JointRows<S>;
  using In = Of<S>;
  double* const t = block.rows;
  give(t, Row::xf, take<Row::H * S::R>(t, Row::x));
  for (int end = 0; end < 2; ++end) {
    const int side = Row::side + end * Row::side_count;
    const auto A = gather<S::M>(block.body[end], BodyRows<S>::turn0);
    const auto z = gather_of_slot<S::T>(block.body[end], block.which[end], BodyRows<S>::zf, S::T);
    constexpr int kMap = S::R * S::R;
    const auto jl = gather_of_slot<kMap>(block.body[end], block.which[end], BodyRows<S>::jlf, kMap);
    for (int i = 0; i < S::T; ++i) {
      give(t, side + Row::rot_point + i * S::R, In::cross(z, In::row(A, i)));
    }
    for (int k = 0; k < S::R; ++k) {
      if (k >= block.num_directions) {
        clear<S::R>(t, side + Row::rot_direction + k * S::R);
        clear<S::R>(t, side + Row::node_direction + k * S::R);
        continue;
      }
      const auto x = In::back_rotation(A, take<S::R>(t, Row::xf + k * S::R));
      give(t, side + Row::rot_direction + k * S::R, x);
      give(t, side + Row::node_direction + k * S::R, In::left_transposed(jl, x));
    }
  }
}

template <class S>
void apply(JointBlock& block, const double* values) {
  using Row = JointRows<S>;
  Numbers<S::T> force;
  for (int i = 0; i < S::T; ++i) force[i] = get(block, i, values);
  Numbers<S::R> moment = {};
  for (int k = 0; k < block.num_directions; ++k) {
    moment =
        moment + scaled(get(block, S::T + k, values), take<S::R>(block.rows, Row::xf + k * S::R));
  }
  load_markers<S>(block, force, moment);
}

template <class S>
void find_changes(JointBlock& block, double* out) {
  using Row = JointRows<S>;
  using Slot = SlotRows<S>;
  const auto apart = gather<S::T>(block.slot[1], Slot::dp) - gather<S::T>(block.slot[0], Slot::dp);
  for (int i = 0; i < S::T; ++i) put(block, i, apart[i], out);
  if (block.num_directions == 0) return;
  const auto turned = gather<S::R>(block.slot[0], Slot::dr) - gather<S::R>(block.slot[1], Slot::dr);
  for (int k = 0; k < block.num_directions; ++k) {
    put(block, S::T + k, dot(take<S::R>(block.rows, Row::xf + k * S::R), turned), out);
  }
}

/// Derivatives of the rows of one end of a joint with respect to a body.
template <class S>
struct Derivatives {
  Numbers<S::R> rot_point[S::T], rot_direction[S::R], node_direction[S::R];

  BUCKENS_LANES void read(const PairBlock& block, int which) {
    using Row = JointRows<S>;
    for (int k = 0; k < S::T; ++k) {
      rot_point[k] = gather<S::R>(block.side[which], Row::rot_point + k * S::R);
    }
    for (int k = 0; k < S::R; ++k) {
      rot_direction[k] = gather<S::R>(block.side[which], Row::rot_direction + k * S::R);
      node_direction[k] = gather<S::R>(block.side[which], Row::node_direction + k * S::R);
    }
  }
};

/// What a body gives at one of its slots by loads at another.
template <class S>
struct Compliance {
  Numbers<S::R * S::R> W;
  Lanes tau;
  Numbers<S::M> turn;
  Numbers<S::F> node[S::F];  // rows

  BUCKENS_LANES void read(const PairBlock& block) {
    W = gather<S::R * S::R>(block.body, BodyRows<S>::W);
    tau = gather_row(block.body, BodyRows<S>::tau);
    turn = gather<S::M>(block.body, BodyRows<S>::turn0);
    for (int i = 0; i < S::F; ++i) {
      for (int k = 0; k < S::F; ++k) {
        node[i][k] = of_lanes([&](int lane) {
          if (!block.has_mesh) return 0.0;
          const int row = FixedRows<S>::A + symmetric_place(S::F * block.which[0][lane] + i,
                                                            S::F * block.which[1][lane] + k);
          return block.fixed[lane][static_cast<std::ptrdiff_t>(kLanes) * row];
        });
      }
    }
  }
  BUCKENS_LANES Numbers<S::R> turned(const Numbers<S::R>& moment) const {
    Numbers<S::R> out;
#pragma GCC unroll 3
    for (int i = 0; i < S::R; ++i) {
      out[i] = W[S::R * i] * moment[0];
#pragma GCC unroll 3
      for (int k = 1; k < S::R; ++k) out[i] += W[S::R * i + k] * moment[k];
    }
    return out;
  }
};

template <class S>
void add_column(const PairBlock& block, int column, const Lanes (&values)[S::F]) {
  for (int lane = 0; lane < block.num_lanes; ++lane) {
    const int count = S::T + block.directions[0][lane];
    if (column >= S::T + block.directions[1][lane]) continue;
    double* const out = block.out[lane] + static_cast<std::ptrdiff_t>(block.stride[lane]) * column;
    for (int i = 0; i < count; ++i) out[i] += values[i][lane];
  }
}

template <class S, bool HasMesh>
void add_pair_block(const PairBlock& block) {
  using In = Of<S>;
  Derivatives<S> closing, acting;
  closing.read(block, 0);
  acting.read(block, 1);
  Compliance<S> of;
  of.read(block);
  const Lanes sign = of_lanes([&](int lane) { return block.sign[0][lane] * block.sign[1][lane]; });
  for (int column = 0; column < S::F; ++column) {
    const bool is_point = column < S::T;
    const auto turned =
        of.turned(is_point ? acting.rot_point[column] : acting.rot_direction[column - S::T]);
    Numbers<S::T> shifted = {};
    Numbers<S::R> node_turned = {};
    if constexpr (HasMesh) {
      // Displacement and rotation of the closing node, body axes.
      Numbers<S::F> moved;
      if (is_point) {
        const auto f = In::row(of.turn, column);
        for (int i = 0; i < S::F; ++i) {
          moved[i] = of.node[i][0] * f[0];
          for (int k = 1; k < S::T; ++k) moved[i] += of.node[i][k] * f[k];
        }
      } else {
        const auto& m = acting.node_direction[column - S::T];
        for (int i = 0; i < S::F; ++i) {
          moved[i] = of.node[i][S::T] * m[0];
          for (int k = 1; k < S::R; ++k) moved[i] += of.node[i][S::T + k] * m[k];
        }
      }
      Numbers<S::T> shift;
      for (int i = 0; i < S::T; ++i) shift[i] = moved[i];
      shifted = In::turn(of.turn, shift);
      for (int i = 0; i < S::R; ++i) node_turned[i] = moved[S::T + i];
    }
    Lanes values[S::F];
    // Directions act the other way than points.
    const Lanes to_points = is_point ? sign : -sign;
    for (int i = 0; i < S::T; ++i) {
      Lanes sum = dot(closing.rot_point[i], turned) + shifted[i];
      if (is_point && i == column) sum += of.tau;
      values[i] = to_points * sum;
    }
    for (int i = 0; i < S::R; ++i) {
      Lanes sum = dot(closing.rot_direction[i], turned);
      if constexpr (HasMesh) sum += dot(closing.node_direction[i], node_turned);
      values[S::T + i] = -to_points * sum;
    }
    add_column<S>(block, column, values);
  }
}

template <class S>
void add_pairs(const PairBlock& block) {
  block.has_mesh ? add_pair_block<S, true>(block) : add_pair_block<S, false>(block);
}

template <class S>
constexpr Kernels kernels_of() {
  return {start<S>,           move<S>,          freeze<S>,   collect<S>,           find_residual<S>,
          correct<S>,         advance<S>,       complete<S>, evaluate_coupling<S>, take_over<S>,
          evaluate_joints<S>, freeze_joints<S>, apply<S>,    find_changes<S>,      add_pairs<S>};
}

}  // namespace
}  // namespace buckens::stepping::strand

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/stepping/strand/lanes.h"

// Included by the sources kernels_*.cpp only: rotations and inertias of eight bodies in the
// plane and in space.
namespace buckens::stepping::strand {
namespace {

/// sin(a/2)/a and cos(a/2) by their series, for angles a up to 1 rad. @param x square of a/2
struct HalfAngle {
  Lanes s, c;
};
BUCKENS_LANES HalfAngle half_angle(const Lanes& x) {
  constexpr double S[] = {1.0 / 6, 1.0 / 20, 1.0 / 42, 1.0 / 72, 1.0 / 110, 1.0 / 156, 1.0 / 210};
  constexpr double C[] = {1.0 / 2,  1.0 / 12,  1.0 / 30,  1.0 / 56,
                          1.0 / 90, 1.0 / 132, 1.0 / 182, 1.0 / 240};
  Lanes s = 1.0 - x * S[6];
#pragma GCC unroll 16
  for (int k = 5; k >= 0; --k) s = 1.0 - x * S[k] * s;
  Lanes c = 1.0 - x * C[7];
#pragma GCC unroll 16
  for (int k = 6; k >= 0; --k) c = 1.0 - x * C[k] * c;
  return {0.5 * s, c};
}
/// (1 − cos a)/a² and (a − sin a)/a³. @param x square of a, up to 1
struct Versines {
  Lanes b, c;
};
BUCKENS_LANES Versines versines(const Lanes& x) {
  constexpr double B[] = {1.0 / 12, 1.0 / 30, 1.0 / 56, 1.0 / 90, 1.0 / 132, 1.0 / 182, 1.0 / 240};
  constexpr double C[] = {1.0 / 20, 1.0 / 42, 1.0 / 72, 1.0 / 110, 1.0 / 156, 1.0 / 210, 1.0 / 272};
  Lanes b = 1.0 - x * B[6];
  Lanes c = 1.0 - x * C[6];
#pragma GCC unroll 16
  for (int k = 5; k >= 0; --k) {
    b = 1.0 - x * B[k] * b;
    c = 1.0 - x * C[k] * c;
  }
  return {0.5 * b, (1.0 / 6.0) * c};
}

template <int K>
BUCKENS_LANES void normalize(Numbers<K>& q) {
  // One is met to rounding before.
  const Lanes factor = 1.5 - 0.5 * dot(q, q);
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) q[k] *= factor;
}

/// What Plane and Space do differently. Vectors: T translations, R rotations.
template <class S>
struct Of;

template <>
struct Of<Plane> {
  using T = Numbers<2>;
  using R = Numbers<1>;
  using Turn = Numbers<2>;  // cosine, sine

  static BUCKENS_LANES T turn(const Turn& A, const T& v) {
    return {{A[0] * v[0] - A[1] * v[1], A[1] * v[0] + A[0] * v[1]}};
  }
  static BUCKENS_LANES T back(const Turn& A, const T& v) {
    return {{A[0] * v[0] + A[1] * v[1], A[0] * v[1] - A[1] * v[0]}};
  }
  static BUCKENS_LANES R turn_rotation(const Turn&, const R& v) { return v; }
  static BUCKENS_LANES R back_rotation(const Turn&, const R& v) { return v; }
  /// Row k of the matrix.
  static BUCKENS_LANES T row(const Turn& A, int k) {
    if (k == 0) return {{A[0], -A[1]}};
    return {{A[1], A[0]}};
  }
  static BUCKENS_LANES R cross(const T& a, const T& b) { return {{a[0] * b[1] - a[1] * b[0]}}; }
  /// w × z
  static BUCKENS_LANES T swing(const R& w, const T& z) { return {{-w[0] * z[1], w[0] * z[0]}}; }
  static BUCKENS_LANES Numbers<2> product(const Numbers<2>& a, const Numbers<2>& b) {
    return {{a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]}};
  }
  /// Of half the angle to the whole.
  static BUCKENS_LANES Turn matrix(const Numbers<2>& q) {
    return {{q[0] * q[0] - q[1] * q[1], 2.0 * q[0] * q[1]}};
  }
  static BUCKENS_LANES Numbers<2> half_turn(const R& psi, Lanes& x) {
    x = 0.25 * psi[0] * psi[0];
    const HalfAngle h = half_angle(x);
    return {{h.c, h.s * psi[0]}};
  }
  /// A exp(θ), and J_l(θ) by rows.
  static BUCKENS_LANES Turn turned_by(const Turn& A, const R& theta, Lanes& x, Numbers<1>& jl) {
    const Turn by = matrix(half_turn(theta, x));
    jl[0] = Lanes{} + 1.0;
    return product(A, by);
  }
  static BUCKENS_LANES R left(const Numbers<1>&, const R& v) { return v; }
  static BUCKENS_LANES R left_transposed(const Numbers<1>&, const R& v) { return v; }
  /// J v for J as stored.
  static BUCKENS_LANES R inertia(const Numbers<4>& J, const R& v) { return {{J[0] * v[0]}}; }
  /// w × x of rotations.
  static BUCKENS_LANES R gyrate(const R&, const R&) { return {{Lanes{}}}; }
  /// Inertia by second moments xx, yy, xy.
  static BUCKENS_LANES Numbers<4> to_inertia(const Numbers<3>& t) {
    return {{t[0] + t[1], t[1], t[0], -t[2]}};
  }
  static BUCKENS_LANES Numbers<1> invert_tangent(const Numbers<4>& J, const Numbers<4>& J_dot,
                                                 const R&, const R&, double mass, double damping) {
    return {{1.0 / (mass * J[0] + damping * J_dot[0])}};
  }
  static BUCKENS_LANES Numbers<3> centrifugal(const R& w) {
    const Lanes w2 = w[0] * w[0];
    return {{w2, w2, Lanes{}}};
  }
  static BUCKENS_LANES R axial(const Lanes (&T)[2][2]) { return {{T[0][1] - T[1][0]}}; }
  static BUCKENS_LANES Numbers<3> symmetric(const Lanes (&T)[2][2]) {
    return {{T[0][0], T[1][1], T[0][1]}};
  }
  static BUCKENS_LANES Numbers<3> twice_symmetric(const Lanes (&T)[2][2]) {
    return {{2.0 * T[0][0], 2.0 * T[1][1], T[0][1] + T[1][0]}};
  }
  /// Skew matrix with its factor added to A.
  static BUCKENS_LANES void add_skew(double factor, const R& w, Lanes (&A)[2][2]) {
    A[0][1] -= factor * w[0];
    A[1][0] += factor * w[0];
  }
  /// factor (|w|² 1 − w wᵀ)
  static BUCKENS_LANES void add_centrifugal(double factor, const R& w, Lanes (&A)[2][2]) {
    const Lanes w2 = factor * w[0] * w[0];
    A[0][0] += w2;
    A[1][1] += w2;
  }
};

template <>
struct Of<Space> {
  using T = Numbers<3>;
  using R = Numbers<3>;
  using Turn = Numbers<9>;

  static BUCKENS_LANES T turn(const Turn& A, const T& v) {
    return {{A[0] * v[0] + A[1] * v[1] + A[2] * v[2], A[3] * v[0] + A[4] * v[1] + A[5] * v[2],
             A[6] * v[0] + A[7] * v[1] + A[8] * v[2]}};
  }
  static BUCKENS_LANES T back(const Turn& A, const T& v) {
    return {{A[0] * v[0] + A[3] * v[1] + A[6] * v[2], A[1] * v[0] + A[4] * v[1] + A[7] * v[2],
             A[2] * v[0] + A[5] * v[1] + A[8] * v[2]}};
  }
  static BUCKENS_LANES R turn_rotation(const Turn& A, const R& v) { return turn(A, v); }
  static BUCKENS_LANES R back_rotation(const Turn& A, const R& v) { return back(A, v); }
  static BUCKENS_LANES T row(const Turn& A, int k) {
    return {{A[3 * k], A[3 * k + 1], A[3 * k + 2]}};
  }
  static BUCKENS_LANES R cross(const T& a, const T& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
  static BUCKENS_LANES T swing(const R& w, const T& z) { return cross(w, z); }
  static BUCKENS_LANES R gyrate(const R& w, const R& x) { return cross(w, x); }
  static BUCKENS_LANES Numbers<4> product(const Numbers<4>& a, const Numbers<4>& b) {
    return {{a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
             a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
             a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
             a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]}};
  }
  static BUCKENS_LANES Turn matrix(const Numbers<4>& q) {
    const Lanes x = 2.0 * q[1], y = 2.0 * q[2], z = 2.0 * q[3];
    return {{1.0 - (y * q[2] + z * q[3]), y * q[1] - z * q[0], z * q[1] + y * q[0],
             y * q[1] + z * q[0], 1.0 - (x * q[1] + z * q[3]), z * q[2] - x * q[0],
             z * q[1] - y * q[0], z * q[2] + x * q[0], 1.0 - (x * q[1] + y * q[2])}};
  }
  static BUCKENS_LANES Numbers<4> half_turn(const R& psi, Lanes& x) {
    x = 0.25 * dot(psi, psi);
    const HalfAngle h = half_angle(x);
    return {{h.c, h.s * psi[0], h.s * psi[1], h.s * psi[2]}};
  }
  static BUCKENS_LANES Turn turned_by(const Turn& A, const R& theta, Lanes& x, Numbers<9>& jl) {
    const Turn by = matrix(half_turn(theta, x));
    const Versines v = versines(4.0 * x);
    // I + b θ~ + c θ~²
    const Lanes square = 4.0 * x;
#pragma GCC unroll 16
    for (int i = 0; i < 3; ++i) {
#pragma GCC unroll 16
      for (int k = 0; k < 3; ++k) jl[3 * i + k] = v.c * theta[i] * theta[k];
      jl[4 * i] += 1.0 - v.c * square;
    }
    const R skew = scaled(v.b, theta);
    jl[1] -= skew[2];
    jl[2] += skew[1];
    jl[3] += skew[2];
    jl[5] -= skew[0];
    jl[6] -= skew[1];
    jl[7] += skew[0];
    Turn out;
#pragma GCC unroll 16
    for (int i = 0; i < 3; ++i) {
#pragma GCC unroll 16
      for (int k = 0; k < 3; ++k) {
        out[3 * i + k] = A[3 * i] * by[k] + A[3 * i + 1] * by[3 + k] + A[3 * i + 2] * by[6 + k];
      }
    }
    return out;
  }
  static BUCKENS_LANES R left(const Numbers<9>& jl, const R& v) { return turn(jl, v); }
  static BUCKENS_LANES R left_transposed(const Numbers<9>& jl, const R& v) { return back(jl, v); }
  static BUCKENS_LANES R inertia(const Numbers<6>& J, const R& v) {
    return {{J[0] * v[0] + J[3] * v[1] + J[4] * v[2], J[3] * v[0] + J[1] * v[1] + J[5] * v[2],
             J[4] * v[0] + J[5] * v[1] + J[2] * v[2]}};
  }
  static BUCKENS_LANES Numbers<6> to_inertia(const Numbers<6>& t) {
    return {{t[1] + t[2], t[0] + t[2], t[0] + t[1], -t[3], -t[4], -t[5]}};
  }
  /// (mass J + damping (J̇ + w~ J − (J w + l)~))⁻¹ @param momentum J w + l
  static BUCKENS_LANES Numbers<9> invert_tangent(const Numbers<6>& J, const Numbers<6>& J_dot,
                                                 const R& w, const R& momentum, double mass,
                                                 double damping) {
    const Lanes full[9] = {J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2]};
    const Lanes rate[9] = {J_dot[0], J_dot[3], J_dot[4], J_dot[3], J_dot[1],
                           J_dot[5], J_dot[4], J_dot[5], J_dot[2]};
    Lanes a[9];
#pragma GCC unroll 16
    for (int k = 0; k < 3; ++k) {
      const R column = cross(w, {{full[k], full[3 + k], full[6 + k]}});
#pragma GCC unroll 16
      for (int i = 0; i < 3; ++i) {
        a[3 * i + k] = mass * full[3 * i + k] + damping * (rate[3 * i + k] + column[i]);
      }
    }
    const R skew = damping * momentum;
    a[1] += skew[2];
    a[2] -= skew[1];
    a[3] -= skew[2];
    a[5] += skew[0];
    a[6] += skew[1];
    a[7] -= skew[0];
    const Lanes m0 = a[4] * a[8] - a[5] * a[7];
    const Lanes m1 = a[5] * a[6] - a[3] * a[8];
    const Lanes m2 = a[3] * a[7] - a[4] * a[6];
    const Lanes inverse = 1.0 / (a[0] * m0 + a[1] * m1 + a[2] * m2);
    return {{m0 * inverse, (a[2] * a[7] - a[1] * a[8]) * inverse,
             (a[1] * a[5] - a[2] * a[4]) * inverse, m1 * inverse,
             (a[0] * a[8] - a[2] * a[6]) * inverse, (a[2] * a[3] - a[0] * a[5]) * inverse,
             m2 * inverse, (a[1] * a[6] - a[0] * a[7]) * inverse,
             (a[0] * a[4] - a[1] * a[3]) * inverse}};
  }
  static BUCKENS_LANES Numbers<6> centrifugal(const R& w) {
    const Lanes xx = w[0] * w[0], yy = w[1] * w[1], zz = w[2] * w[2];
    return {{yy + zz, xx + zz, xx + yy, -w[0] * w[1], -w[0] * w[2], -w[1] * w[2]}};
  }
  static BUCKENS_LANES R axial(const Lanes (&T)[3][3]) {
    return {{T[1][2] - T[2][1], T[2][0] - T[0][2], T[0][1] - T[1][0]}};
  }
  static BUCKENS_LANES Numbers<6> symmetric(const Lanes (&T)[3][3]) {
    return {{T[0][0], T[1][1], T[2][2], T[0][1], T[0][2], T[1][2]}};
  }
  static BUCKENS_LANES Numbers<6> twice_symmetric(const Lanes (&T)[3][3]) {
    return {{2.0 * T[0][0], 2.0 * T[1][1], 2.0 * T[2][2], T[0][1] + T[1][0], T[0][2] + T[2][0],
             T[1][2] + T[2][1]}};
  }
  static BUCKENS_LANES void add_skew(double factor, const R& w, Lanes (&A)[3][3]) {
    A[0][1] -= factor * w[2];
    A[0][2] += factor * w[1];
    A[1][0] += factor * w[2];
    A[1][2] -= factor * w[0];
    A[2][0] -= factor * w[1];
    A[2][1] += factor * w[0];
  }
  static BUCKENS_LANES void add_centrifugal(double factor, const R& w, Lanes (&A)[3][3]) {
    const Numbers<6> t = centrifugal(w);
    A[0][0] += factor * t[0];
    A[1][1] += factor * t[1];
    A[2][2] += factor * t[2];
    A[0][1] += factor * t[3];
    A[1][0] += factor * t[3];
    A[0][2] += factor * t[4];
    A[2][0] += factor * t[4];
    A[1][2] += factor * t[5];
    A[2][1] += factor * t[5];
  }
};

}  // namespace
}  // namespace buckens::stepping::strand

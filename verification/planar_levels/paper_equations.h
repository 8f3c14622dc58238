// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "buckens/body/coupling_level.h"

/// Free flight of one beam element in its own frame by the equations as the paper prints them, with
/// explicit multipliers Λ and Runge–Kutta. Shares nothing with the program but the names of terms.
namespace buckens::verification::paper {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// ρA = 1, l = 1, EA = 500, EI = 2; v = (u, v, θ) at both ends.
struct Element {
  Matrix6 M, K, h;
  Vector6 n;
  Eigen::Matrix<double, 6, 3> P;

  Element() {
    const double EA = 500;
    const double EI = 2;
    M << 140, 0, 0, 70, 0, 0,    //
        0, 156, 22, 0, 54, -13,  //
        0, 22, 4, 0, 13, -3,     //
        70, 0, 0, 140, 0, 0,     //
        0, 54, 13, 0, 156, -22,  //
        0, -13, -3, 0, -22, 4;
    M /= 420.0;
    K << EA, 0, 0, -EA, 0, 0,                       //
        0, 12 * EI, 6 * EI, 0, -12 * EI, 6 * EI,    //
        0, 6 * EI, 4 * EI, 0, -6 * EI, 2 * EI,      //
        -EA, 0, 0, EA, 0, 0,                        //
        0, -12 * EI, -6 * EI, 0, 12 * EI, -6 * EI,  //
        0, 6 * EI, 2 * EI, 0, -6 * EI, 4 * EI;
    n << -1, 0, 0, 1, 0, 0;  // FM (54), centred: α = 0, Y = X = 0
    n /= 12.0;
    h << 0, 21, 3, 0, 9, -2,  // FM (56) with 21 where the print has 2l
        -21, 0, 0, -9, 0, 0,  //
        -3, 0, 0, -2, 0, 0,   //
        0, 9, 2, 0, 21, -3,   //
        -9, 0, 0, -21, 0, 0,  //
        2, 0, 0, 3, 0, 0;
    h /= 60.0;
    Eigen::Matrix<double, 6, 3> Q;
    Q << 1, 0, 0, 0, 1, -0.5, 0, 0, 1, 1, 0, 0, 0, 1, 0.5, 0, 0, 1;
    P = M * Q;
  }
};

/// φ, v and their rates.
using State = Eigen::Matrix<double, 14, 1>;

inline State rate(const Element& e, const body::CouplingTerms& keep, const State& x) {
  const double w = x[7];
  const Vector6 v = x.segment<6>(1);
  const Vector6 v_dot = x.tail<6>();
  const auto on = [](bool term) { return term ? 1.0 : 0.0; };
  const double quad = on(keep.quad_ref);
  Eigen::Matrix<double, 10, 10> A = Eigen::Matrix<double, 10, 10>::Zero();
  Eigen::Matrix<double, 10, 1> b = Eigen::Matrix<double, 10, 1>::Zero();
  // FM (48): J φ̈ + vᵀh v̈ = −J̇ φ̇
  A(0, 0) = 1.0 / 12.0 + on(keep.jvar) * (2.0 * e.n.dot(v) + quad * v.dot(e.M * v));
  A.block<1, 6>(0, 1) = quad * v.transpose() * e.h;
  b[0] = -on(keep.cor_ref) * 2.0 * (e.n.dot(v_dot) + quad * v.dot(e.M * v_dot)) * w;
  // FM (49): M v̈ + K v − P Λ = 2φ̇ h v̇ + φ̈ h v + φ̇² (n + M v),  Pᵀv̈ = 0
  A.block<6, 6>(1, 1) = e.M;
  A.block<6, 1>(1, 0) = -on(keep.eul_fe) * e.h * v;
  A.block<6, 3>(1, 7) = -e.P;
  A.block<3, 6>(7, 1) = e.P.transpose();
  b.segment<6>(1) = -e.K * v + 2.0 * w * on(keep.cor_fe) * e.h * v_dot +
                    w * w * (on(keep.cent0) * e.n + on(keep.cent1) * e.M * v);
  State out;
  out.head<7>() = x.tail<7>();
  out.tail<7>() = A.partialPivLu().solve(b).head<7>();
  return out;
}

/// Places of the tip at ten equal instants up to 1 s.
inline Eigen::VectorXd free_flight_tips(const body::CouplingTerms& keep) {
  const Element e;
  State x = State::Zero();
  x[7] = 3.0;
  Vector6 v_dot;
  v_dot << -0.5, 0, 0.8, 0.5, 0, -0.8;
  // Y v̇: rigid motion out.
  const Eigen::Matrix<double, 6, 3> Q = e.M.llt().solve(e.P);
  v_dot -= Q * (Q.transpose() * e.P).inverse() * (e.P.transpose() * v_dot);
  x.tail<6>() = v_dot;
  Eigen::VectorXd out(20);
  const double dt = 1e-4;
  for (int k = 1; k <= 10000; ++k) {
    const State k1 = rate(e, keep, x);
    const State k2 = rate(e, keep, x + 0.5 * dt * k1);
    const State k3 = rate(e, keep, x + 0.5 * dt * k2);
    const State k4 = rate(e, keep, x + dt * k3);
    x += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (k % 1000 != 0) continue;
    const double t = k * dt;
    const Eigen::Vector2d s(0.5 + x[4], x[5]);
    out[k / 500 - 2] = 0.5 + 0.3 * t + std::cos(x[0]) * s.x() - std::sin(x[0]) * s.y();
    out[k / 500 - 1] = 1.6 * t + std::sin(x[0]) * s.x() + std::cos(x[0]) * s.y();
  }
  return out;
}

}  // namespace buckens::verification::paper

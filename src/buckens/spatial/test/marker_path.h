// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/rotation.h"

namespace buckens::test {

/// A marker frame that moves with constant acceleration of its origin and of its rotation vector:
/// a path for checking rates by finite differences. Exact derivatives at t = 0.
struct MarkerPath {
  Eigen::Vector3d p, v, a;
  Eigen::Matrix3d R;
  Eigen::Vector3d w, alpha;

  spatial::MarkerMotion at(double t) const {
    spatial::MarkerMotion out;
    const Eigen::Vector3d psi = t * w + 0.5 * t * t * alpha;
    out.p = p + t * v + 0.5 * t * t * a;
    out.v = v + t * a;
    out.R = spatial::exp_rotation(psi).toRotationMatrix() * R;
    out.w = spatial::left_jacobian(psi) * (w + t * alpha);
    return out;
  }

  /// A frame in general position; `seed` selects one.
  static MarkerPath some(int seed) {
    const double s = seed;
    MarkerPath out;
    out.p << 0.3 + 0.2 * s, -0.5 * s, 0.8 - 0.1 * s;
    out.v << 1.1 - s, 0.4, -0.6 + 0.5 * s;
    out.a << -0.7, 2.0 * s, 0.9;
    out.R = spatial::exp_rotation({0.5 - 0.2 * s, 0.3 * s, -0.8}).toRotationMatrix();
    out.w << 0.9, -1.2 + s, 0.4 * s;
    out.alpha << 0.5 * s, 1.3, -0.6;
    return out;
  }
};

/// Two marker frames in general position.
struct MarkerPair {
  MarkerPath F, M;

  /// @param reach of their origins along each axis [m]
  explicit MarkerPair(std::mt19937& chance, double reach = 1.0) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Eigen::Vector3d(any(chance), any(chance), any(chance)); };
    for (MarkerPath* path : {&F, &M}) {
      path->p = reach * vector();
      path->v = vector();
      path->a = vector();
      path->R = spatial::exp_rotation(3 * vector()).toRotationMatrix();
      path->w = vector();
      path->alpha = vector();
    }
  }
};

/// First derivative at zero, fourth order.
template <class F>
auto derivative(F f, double h = 1e-3) {
  using Value = decltype(f(0.0));  // not `auto`: Eigen's differences refer to their operands
  const Value near = f(h) - f(-h);
  const Value far = f(2 * h) - f(-2 * h);
  return Value((8.0 * near - far) / (12.0 * h));
}

/// Second derivative at zero, fourth order.
template <class F>
auto second_derivative(F f, double h = 2e-3) {
  using Value = decltype(f(0.0));
  const Value middle = f(0.0);
  const Value near = f(h) + f(-h) - 2.0 * middle;
  const Value far = f(2 * h) + f(-2 * h) - 2.0 * middle;
  return Value((16.0 * near - far) / (12.0 * h * h));
}

}  // namespace buckens::test

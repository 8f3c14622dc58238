// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_law.h"

#include <algorithm>
#include <cmath>

namespace buckens::loads {

using Eigen::Vector3d;

double loss_factor(double restitution) {
  const double e = restitution;
  if (e >= 1.0) return 0.0;
  // The difference of both sides is positive from 0 to the root and falls without bound towards
  // 1/e.
  const auto open = [e](double a) { return a * (1.0 + e) - std::log1p(a) + std::log1p(-a * e); };
  double low = 1e-3 * (1.0 - e);  // the root is about 3/2 (1 − e) or more
  double high = 1.0 / e;
  constexpr int kBisections = 200;
  for (int k = 0; k < kBisections && high - low > 0.0; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (open(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

double hertz_stiffness(const std::array<double, 2>& modulus, const std::array<double, 2>& poisson,
                       double curvature) {
  const double compliance =
      (1.0 - poisson[0] * poisson[0]) / modulus[0] + (1.0 - poisson[1] * poisson[1]) / modulus[1];
  return 4.0 / 3.0 / compliance / std::sqrt(curvature);
}

NormalForce normal_force(const ContactData& data, double overlap, double rate, double approach) {
  NormalForce out;
  if (!(overlap > 0.0)) return out;
  const double n = data.exponent;
  out.elastic = data.stiffness * std::pow(overlap, n);
  out.energy = out.elastic * overlap / (n + 1.0);
  const double slowness = data.loss / std::max(approach, data.threshold);
  const double factor = data.loss > 0.0 ? 1.0 + slowness * rate : 1.0;
  const double viscous = data.damping * rate;
  const double limited = std::clamp(viscous, -out.elastic, out.elastic);
  // Where it is cut off the tangent stays: a force that hovers about zero would change it for ever.
  out.force = std::max(0.0, out.elastic * factor + limited);
  const bool is_limited = limited != viscous;
  const double gain = factor + (is_limited ? std::copysign(1.0, viscous) : 0.0);
  out.stiffness = std::max(0.0, n * out.elastic / overlap * gain);
  out.damping =
      (data.loss > 0.0 ? out.elastic * slowness : 0.0) + (is_limited ? 0.0 : data.damping);
  return out;
}

FrictionForce friction_force(const ContactData& data, const Vector3d& strain, const Vector3d& slip,
                             double load) {
  FrictionForce out;
  const double k = data.tangential_stiffness;
  // Critical for the inertia alone: sticking does not ring.
  const double c = 2.0 * std::sqrt(k * data.inertia);
  const Vector3d trial = k * strain + c * slip;
  const double size = trial.norm();
  if (size > 0.0) out.along = trial / size;
  const double slowness = data.stribeck_speed > 0.0 ? slip.norm() / data.stribeck_speed : 0.0;
  const double coefficient =
      data.dynamic_coefficient +
      (data.static_coefficient - data.dynamic_coefficient) * std::exp(-slowness * slowness);
  const double bound = coefficient * load;
  out.slides = size > bound;
  out.force = -trial;
  out.strain = strain;
  if (!out.slides) return out;
  out.share = bound / size;
  out.force = -bound * out.along;
  // What the damper alone brings to the bound strains nothing: that would be energy from nowhere.
  const double elastic = k * strain.norm();
  if (elastic > bound) out.strain *= bound / elastic;
  return out;
}

}  // namespace buckens::loads

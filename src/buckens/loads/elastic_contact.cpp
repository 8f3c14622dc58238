// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/elastic_contact.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::loads {

namespace {

constexpr double kHertzExponent = 1.5;
// Of spheres that stick to each other (Mindlin): 2 (1 − ν)/(2 − ν), 0.82 with ν = 0.3.
constexpr double kTangentialShare = 0.8;
// Overlap at which the default is taken where nothing has a weight: a share of the shape's size.
constexpr double kLightOverlap = 1e-4;

/// Across the surface, under the weight of the lighter body [N/m].
double usual_stiffness(const ContactData& data, double size, double gravity) {
  const double weight = data.inertia * gravity;
  if (data.exponent == 1.0) return data.stiffness;
  const double overlap =
      weight > 0.0 ? std::pow(weight / data.stiffness, 1.0 / data.exponent) : kLightOverlap * size;
  return data.exponent * data.stiffness * std::pow(overlap, data.exponent - 1.0);
}

}  // namespace

ElasticContactLaw elastic_law(const ContactForceSpec& spec) {
  ElasticContactLaw out;
  out.stiffness = spec.stiffness.value_or(0.0);
  out.exponent = spec.exponent.value_or(1.0);
  out.loss = loss_factor(spec.restitution.value_or(1.0));
  out.damping = spec.damping;
  out.static_coefficient = spec.coefficient;
  out.dynamic_coefficient = spec.dynamic.value_or(spec.coefficient);
  out.stribeck_speed = spec.stribeck.value_or(0.0);
  out.threshold = spec.threshold;
  out.tangential_stiffness = spec.tangential;
  return out;
}

double size_of(const ContactShape& shape) {
  switch (shape.kind) {
    case ContactShape::Kind::plane:
      return HUGE_VAL;
    case ContactShape::Kind::box: {
      Eigen::Vector3d half = shape.half;
      if (shape.flat >= 0) half[shape.flat] = HUGE_VAL;
      return half.minCoeff();
    }
    case ContactShape::Kind::mesh: {
      // Half of its middle extent: plates are wide, and surfaces of plane ground have no height.
      Eigen::Vector3d half = 0.5 * shape.mesh->box().sizes();
      std::sort(half.begin(), half.end());
      return half[1];
    }
    default:
      return shape.radius;
  }
}

ContactData contact_data(const ElasticContactLaw& law, const ContactPair& pair, double inertia,
                         double gravity) {
  ContactData data;
  data.stiffness = law.stiffness;
  data.exponent = law.exponent;
  if (law.modulus) {
    double curvature = 1.0 / pair.second().radius;
    if (pair.first().kind == ContactShape::Kind::sphere) curvature += 1.0 / pair.first().radius;
    if (pair.first().kind == ContactShape::Kind::socket) curvature -= 1.0 / pair.first().radius;
    data.stiffness = hertz_stiffness(*law.modulus, law.poisson, curvature);
    data.exponent = kHertzExponent;
  }
  data.loss = law.loss;
  data.damping = law.damping;
  data.static_coefficient = law.static_coefficient;
  data.dynamic_coefficient = law.dynamic_coefficient;
  data.stribeck_speed = law.stribeck_speed;
  data.inertia = inertia;
  const double size = std::min(size_of(pair.first()), size_of(pair.second()));
  const double usual = usual_stiffness(data, size, gravity);
  // What comes slower than g √(m/k) is kept there by its weight, and would rest ever more slowly
  // if its losses rose further.
  data.threshold = law.threshold.value_or(
      std::max(gravity * std::sqrt(inertia / usual), RigidStop::kAtRest * size));
  data.tangential_stiffness = law.tangential_stiffness.value_or(kTangentialShare * usual);
  return data;
}

}  // namespace buckens::loads

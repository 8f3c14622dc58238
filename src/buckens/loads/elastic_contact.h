// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/loads/contact_law.h"
#include "buckens/loads/contact_pair.h"
#include "buckens/loads/contact_spec.h"

namespace buckens::loads {

/// What a model says about elastic contacts, before shapes and masses are known.
struct ElasticContactLaw {
  double stiffness = 0;                          ///< K [N/mⁿ], unless there are moduli
  double exponent = 1;                           ///< n
  std::optional<std::array<double, 2>> modulus;  ///< [Pa]
  std::array<double, 2> poisson = {0.3, 0.3};
  double loss = 0;  ///< α of loss_factor(restitution)
  double damping = 0;
  double static_coefficient = 0;
  double dynamic_coefficient = 0;
  double stribeck_speed = 0;
  std::optional<double> threshold, tangential_stiffness;
};

/// All but the moduli.
ElasticContactLaw elastic_law(const ContactForceSpec& spec);

/// Half of its extent [m]; HUGE_VAL for planes.
double size_of(const ContactShape& shape);

/// The law of one pair.
/// @param inertia reduced mass of both bodies [kg], @param gravity its size [m/s²]
ContactData contact_data(const ElasticContactLaw& law, const ContactPair& pair, double inertia,
                         double gravity);

}  // namespace buckens::loads

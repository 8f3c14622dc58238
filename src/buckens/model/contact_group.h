// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "buckens/loads/contact.h"
#include "buckens/loads/elastic_contact.h"
#include "buckens/model/marker_id.h"

namespace buckens::model {

/// A shape among many that can touch each other.
struct ContactMember {
  MarkerId marker;
  loads::ContactShape shape;
  double inverse_mass = 0;  ///< of its body [1/kg]
  bool is_against = false;  ///< stands in the second list
};

/// What a model says about rigid contacts, before shapes are known.
struct RigidPairLaw {
  double restitution = 0;
  std::optional<double> threshold;  ///< [m/s]
  double static_coefficient = 0;
  double dynamic_coefficient = 0;
  double stribeck_speed = 0;
  loads::ContactSettings settings;
};

/// Many bodies that touch each other by one law.
struct ContactGroup {
  std::size_t load = 0;  ///< its place in Model::loads
  std::vector<ContactMember> members;
  loads::ElasticContactLaw law;
  std::optional<RigidPairLaw> rigid;  ///< in place of `law`
  loads::ContactSettings settings;    ///< of `law`
  double gravity = 0;                 ///< [m/s²]
  bool has_two_lists = false;
  /// Bodies that a joint connects, the lower number first; ascending.
  std::vector<std::pair<int, int>> joined;

  /// Whether two members can touch by what they belong to.
  bool can_touch(std::size_t i, std::size_t j) const;
  /// The members as a pair of surface and what touches it. @pre their shapes make a pair
  std::pair<std::size_t, std::size_t> ordered(std::size_t i, std::size_t j) const;
  /// @param first,second as ordered
  loads::Contact contact(std::size_t first, std::size_t second) const;
};

}  // namespace buckens::model

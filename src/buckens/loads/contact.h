// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "buckens/loads/contact_law.h"
#include "buckens/loads/contact_pair.h"
#include "buckens/loads/contact_settings.h"
#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// What a contact does at one instant, summed over the points where it touches.
struct ContactReading {
  double normal = 0;    ///< sum of the forces across the surface [N]
  double friction = 0;  ///< size of the resultant along it [N]
  double gap = 0;       ///< least distance, negative: overlap [m]
};

/// Elastic contact between two shapes, with friction.
///
/// Its states are, per point where shapes can touch, the speed at which it closed; with friction
/// also the strain that it holds, and how both markers stood to each other at the end of the last
/// step, since slip within a step is that of positions, not of rates: nothing creeps.
/// Theory: docs/theory/25-contact.md.
class Contact final : public ForceElement {
 public:
  Contact(const ContactPair& pair, const ContactData& data, const ContactSettings& settings = {})
      : pair_(pair), data_(data), settings_(settings) {}

  /// Nothing: it needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override;
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  int num_states() const override;
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;

  bool has_driven_energy() const override { return settings_.stiffness > 0; }
  /// Whether events change any of its numbers.
  bool is_changed() const { return settings_.any(); }

  ContactReading read(const Sight& sight) const;
  /// Strains its points so that their friction holds a load along the surface from the start, as
  /// far as their bounds go. Each carries in proportion to what presses there.
  /// @param along what friction does to the second marker, @param states those of start_states()
  void hold(const Sight& sight, const spatial::Wrench& along, double* states) const;
  /// As the model says: events do not count.
  const ContactData& data() const { return data_; }
  const ContactPair& pair() const { return pair_; }

 private:
  /// One point at one instant, world axes.
  struct Point {
    Eigen::Vector3d place, normal;
    Eigen::Vector3d couple;  ///< beside the force across, per force [m]
    double gap = 0, gap_rate = 0;
    Eigen::Vector3d slip;  ///< speed of the second body along the surface [m/s]
    double moved = 0;      ///< along the surface since the start of the step [m]
    NormalForce across;
    FrictionForce along;
  };
  /// How the second marker stands to the first, in its axes.
  struct Stand {
    Eigen::Vector3d r;
    Eigen::Quaterniond q;
  };

  /// Memory for them; nothing is allocated in a step.
  template <std::size_t kSize>
  struct Memory {
    std::array<ContactSpot, kSize> spots;
    std::array<Point, kSize> points;
  };

  // Places among the states with friction: instant, relative position and rotation, energy held by
  // friction and its rate; then those of each point.
  static constexpr int kTime = 0, kPosition = 1, kRotation = 4, kEnergy = 8, kPower = 9;
  static constexpr int kCommon = 10;
  // Of each point: speed of approach; with friction also the lever from the second marker and the
  // strain, both in axes of the first.
  static constexpr int kApproach = 0, kLever = 1, kStrain = 4, kOfPoint = 7;

  bool has_friction() const { return data_.static_coefficient > 0.0; }
  static Stand stand_of(const Sight& sight);
  /// Calls f(points), with memory for as many as there can be.
  template <class F>
  auto with_points(const Sight& sight, F&& f) const;
  std::span<const Point> look(const Sight& sight, std::span<ContactSpot> spots,
                              std::span<Point> points) const;
  /// Energy in the strains that friction holds [J].
  double strain_energy(std::span<const Point> points) const;
  /// Rate of that energy: over the step so far, or over the last one where none has begun [W].
  double strain_power(const Sight& sight, double energy) const;
  /// Share of the tangent along the slip that iterations need where sliding may end.
  double braking_share(const Sight& sight, const Point& point) const;
  int regime_of(const Sight& sight, std::span<const Point> points) const;
  void append_tangent_of(const Sight& sight, const Point& point, std::vector<SoftRow>& rows) const;
  /// Place of a point's states.
  int first_state(std::size_t point) const;
  void set_common_states(const Sight& sight, std::span<const Point> points, double* states) const;

  ContactPair pair_;
  ContactData data_;
  ContactSettings settings_;
};

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

// Instants closer than this share of the time are one, computed in two ways.
constexpr double kSameInstant = 1e-13;

// Tangents within one such ratio count as the same.
constexpr double kSameTangent = 1.3;
// From this ratio of what friction can brake within a step to what has slipped, sliding may end in
// it.
constexpr double kMayStop = 0.3;

/// Number of the ratio that a positive value is in.
int bucket(double value) {
  return value > 0.0 ? static_cast<int>(std::floor(std::log(value) / std::log(kSameTangent))) : 0;
}

Vector3d read_vector(const double* states) { return {states[0], states[1], states[2]}; }

/// Row of the relative velocity of both bodies at a place along a direction, and of their turns by
/// what a couple beside a force of one does.
spatial::PairRow row_along(const Vector3d& direction, const Vector3d& place, const Sight& sight,
                           const Vector3d& couple = Vector3d::Zero()) {
  spatial::PairRow J;
  J.segment<3>(0) = -((place - sight.first.p).cross(direction) + couple).transpose();
  J.segment<3>(3) = -direction.transpose();
  J.segment<3>(6) = ((place - sight.second.p).cross(direction) + couple).transpose();
  J.segment<3>(9) = direction.transpose();
  return J;
}

/// A vector of the surface at one instant, turned into the surface at another.
Vector3d into_surface(const Vector3d& v, const Vector3d& normal) {
  const Vector3d flat = v - normal * normal.dot(v);
  const double size = flat.norm();
  return size > 0.0 ? Vector3d(flat * (v.norm() / size)) : Vector3d(Vector3d::Zero());
}

}  // namespace

Action Contact::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                         const spatial::MarkerMotion& /*second*/) const {
  return {};
}

int Contact::num_soft_rows() const { return (has_friction() ? 3 : 1) * pair_.num_spots(); }

int Contact::num_states() const {
  return has_friction() ? kCommon + kOfPoint * pair_.num_spots() : pair_.num_spots();
}

Contact::Stand Contact::stand_of(const Sight& sight) {
  const Eigen::Matrix3d R_FW = sight.first.R.transpose();
  return {R_FW * (sight.second.p - sight.first.p),
          Quaterniond(Eigen::Matrix3d(R_FW * sight.second.R))};
}

template <class F>
auto Contact::with_points(const Sight& sight, F&& f) const {
  // Most pairs touch once or twice; the memory for many takes longer to clear than to look.
  constexpr std::size_t kFew = 2;
  if (pair_.num_spots() <= static_cast<int>(kFew)) {
    Memory<kFew> few;
    return f(look(sight, few.spots, few.points));
  }
  Memory<ContactPair::kMostSpots> many;
  return f(look(sight, many.spots, many.points));
}

std::span<const Contact::Point> Contact::look(const Sight& sight, std::span<ContactSpot> spots,
                                              std::span<Point> points) const {
  const Stand now = stand_of(sight);
  pair_.find(now.r, now.q.toRotationMatrix(), spots);
  ContactData data = data_;
  if (settings_.any()) settings_.put(sight.signals, data);
  const double* states = sight.states;
  Vector3d shift = Vector3d::Zero();
  Vector3d turn = Vector3d::Zero();
  if (has_friction() && states != nullptr) {
    const double* q = states + kRotation;
    shift = now.r - read_vector(states + kPosition);
    turn = spatial::log_rotation(now.q * Quaterniond(q[0], q[1], q[2], q[3]).conjugate());
  }
  const auto count = static_cast<std::size_t>(pair_.num_spots());
  for (std::size_t k = 0; k < count; ++k) {
    const ContactSpot& spot = spots[k];
    Point& point = points[k] = {};
    point.normal = sight.first.R * spot.normal;
    point.place = sight.first.p + sight.first.R * spot.place;
    point.gap = spot.gap;
    const Vector3d v = sight.second.v + sight.second.w.cross(point.place - sight.second.p) -
                       sight.first.v - sight.first.w.cross(point.place - sight.first.p);
    const double across = point.normal.dot(v);
    point.slip = v - across * point.normal;
    point.couple = sight.first.R * spot.couple;
    point.gap_rate = across + point.couple.dot(sight.second.w - sight.first.w);
    const double* own = nullptr;
    if (states != nullptr) own = states + first_state(k);
    point.across =
        normal_force(data, -point.gap, -point.gap_rate, own != nullptr ? own[kApproach] : 0.0);
    if (spot.share != 1.0) point.across *= spot.share;
    if (point.gap < 0.0 && data.exponent == 1.0) {
      point.across.energy += data.stiffness * spot.held;
    }
    if (!has_friction()) continue;
    Vector3d strain = Vector3d::Zero();
    if (own != nullptr) {
      const Vector3d lever = 0.5 * (read_vector(own + kLever) + spot.place - now.r);
      const Vector3d moved = shift + turn.cross(lever);
      const Vector3d slip = moved - spot.normal * spot.normal.dot(moved);
      point.moved = slip.norm();
      strain = sight.first.R * (into_surface(read_vector(own + kStrain), spot.normal) + slip);
    }
    point.along = friction_force(data, strain, point.slip, point.across.force);
  }
  return points.first(count);
}

double Contact::strain_energy(std::span<const Point> points) const {
  double sum = 0;
  for (const Point& point : points) {
    sum += 0.5 * data_.tangential_stiffness * point.along.strain.squaredNorm();
  }
  return sum;
}

double Contact::strain_power(const Sight& sight, double energy) const {
  if (!has_friction() || sight.states == nullptr) return 0.0;
  const double h = sight.t - sight.states[kTime];
  const double rounding = kSameInstant * std::abs(sight.t);
  return h > rounding ? (energy - sight.states[kEnergy]) / h : sight.states[kPower];
}

Action Contact::respond(const Sight& sight) const {
  return with_points(sight, [&](std::span<const Point> points) {
    Action out;
    double power = 0;
    double rubbing = 0;
    for (const Point& point : points) {
      if (!(point.gap < 0.0)) continue;
      const Vector3d force = point.across.force * point.normal + point.along.force;
      const Vector3d couple = point.across.force * point.couple;
      out.on_second += {(point.place - sight.second.p).cross(force) + couple, force};
      out.on_first += {-(point.place - sight.first.p).cross(force) - couple, -force};
      out.stored_energy += point.across.energy;
      const double along = point.along.force.dot(point.slip);
      power += along;
      rubbing += along;
      // Without what the elastic energy takes.
      power += (point.across.force - point.across.elastic) * point.gap_rate;
    }
    const double held = strain_energy(points);
    out.stored_energy += held;
    const double straining = strain_power(sight, held);
    out.active_power = power + straining;
    out.dissipation = -out.active_power;
    out.friction = -(rubbing + straining);
    out.regime = regime_of(sight, points);
    return out;
  });
}

double Contact::braking_share(const Sight& sight, const Point& point) const {
  const double h = sight.states != nullptr ? sight.t - sight.states[kTime] : 0.0;
  if (!(h > 0.0) || !(data_.inertia > 0.0)) return 0.0;
  const double brakes = point.along.force.norm() * h * h / data_.inertia;
  return brakes > kMayStop * point.moved ? point.along.share : 0.0;
}

int Contact::regime_of(const Sight& sight, std::span<const Point> points) const {
  unsigned sum = 0;
  for (const Point& point : points) {
    const bool touches = point.gap < 0.0;
    const int across = touches ? bucket(point.across.elastic / -point.gap) + 1000 : 0;
    int along = 0;
    if (touches && has_friction()) {
      along = point.along.slides ? 500 + bucket(braking_share(sight, point)) : 1;
    }
    sum = sum * 1000003U + static_cast<unsigned>(across * 1000 + along);
  }
  return static_cast<int>(sum & 0x7fffffffU);
}

void Contact::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  with_points(sight, [&](std::span<const Point> points) {
    for (const Point& point : points) append_tangent_of(sight, point, rows);
  });
}

void Contact::append_tangent_of(const Sight& sight, const Point& point,
                                std::vector<SoftRow>& rows) const {
  const double k = data_.tangential_stiffness;
  const double c = 2.0 * std::sqrt(k * data_.inertia);
  SoftRow row;
  row.J = row_along(point.normal, point.place, sight, point.couple);
  row.stiffness = point.across.stiffness;
  row.damping = point.across.damping;
  rows.push_back(row);
  if (!has_friction()) return;
  const Vector3d along =
      point.along.along.isZero(0.0) ? point.normal.unitOrthogonal() : point.along.along;
  // Without states, as in statics, there is no friction.
  const double touches = point.gap < 0.0 && sight.states != nullptr ? 1.0 : 0.0;
  // Sliding turns with the slip; along it the force is the same at any speed.
  const double share = point.along.slides ? braking_share(sight, point) : 1.0;
  for (const bool is_along : {true, false}) {
    const Vector3d direction = is_along ? along : Vector3d(point.normal.cross(along));
    row.J = row_along(direction, point.place, sight);
    row.stiffness = touches * (is_along ? share : point.along.share) * k;
    row.damping = touches * (is_along ? share : point.along.share) * c;
    rows.push_back(row);
  }
}

void Contact::start_states(const Sight& sight, double* states) const {
  Sight fresh = sight;
  fresh.states = nullptr;
  find_states(fresh, states);
  // What overlaps as it is seen for the first time closes with its speed then.
  with_points(fresh, [&](std::span<const Point> points) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      states[first_state(k) + kApproach] = std::max(0.0, -points[k].gap_rate);
    }
  });
}

void Contact::find_states(const Sight& sight, double* states) const {
  with_points(sight, [&](std::span<const Point> points) {
    if (has_friction()) set_common_states(sight, points, states);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point& point = points[k];
      const int first = first_state(k);
      double* own = states + first;
      const double before = sight.states != nullptr ? sight.states[first + kApproach] : 0.0;
      // While it is open: the speed at which it would close.
      own[kApproach] = point.gap < 0.0 ? before : std::max(0.0, -point.gap_rate);
      if (!has_friction()) continue;
      const Vector3d lever = sight.first.R.transpose() * (point.place - sight.second.p);
      Eigen::Map<Vector3d>(own + kLever) = lever;
      Eigen::Map<Vector3d>(own + kStrain) = sight.first.R.transpose() * point.along.strain;
    }
  });
}

int Contact::first_state(std::size_t point) const {
  const int k = static_cast<int>(point);
  return has_friction() ? kCommon + kOfPoint * k : k;
}

void Contact::set_common_states(const Sight& sight, std::span<const Point> points,
                                double* states) const {
  const Stand now = stand_of(sight);
  const double energy = strain_energy(points);
  states[kTime] = sight.t;
  Eigen::Map<Vector3d>(states + kPosition) = now.r;
  states[kRotation] = now.q.w();
  Eigen::Map<Vector3d>(states + kRotation + 1) = now.q.vec();
  states[kEnergy] = energy;
  states[kPower] = strain_power(sight, energy);
}

ContactReading Contact::read(const Sight& sight) const {
  return with_points(sight, [](std::span<const Point> points) {
    ContactReading out;
    out.gap = points.front().gap;
    Vector3d along = Vector3d::Zero();
    for (const Point& point : points) {
      out.normal += point.across.force;
      along += point.along.force;
      out.gap = std::min(out.gap, point.gap);
    }
    out.friction = along.norm();
    return out;
  });
}

}  // namespace buckens::loads

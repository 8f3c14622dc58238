// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bristle_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace buckens::loads {

namespace {

/// dz/ds of bristles where s grows. @param sliding deflection f_s/σ₀ at which they slide
double slope_of_bristles(double z, double sliding, double elastic_share) {
  const double filled = z / sliding;
  // Bent against the way: elastic, but for LuGre's law itself, where they straighten faster.
  if (filled <= 0.0) return elastic_share > 0.0 ? 1.0 : 1.0 - filled;
  double alpha = 1.0;
  if (elastic_share > 0.0) {
    if (filled <= elastic_share) return 1.0;
    const double middle = 0.5 * (1.0 + elastic_share);
    const double width = 1.0 - elastic_share;
    if (filled < 1.0 && width > 0.0) {
      alpha = 0.5 + 0.5 * std::sin(std::numbers::pi * (filled - middle) / width);
    }
  }
  return 1.0 - alpha * filled;
}

// Parts of the deflection at which bristles slide that one step of their integration covers, and
// way over which they have surely come to slide.
constexpr double kPartOfBend = 0.1;
constexpr double kSurelySliding = 60.0;
// A bound that all but vanishes within a step counts as this share of its mean.
constexpr double kLeastBound = 0.1;

/// Deflection after a way along which they were bent by z.
/// @param sliding deflections at which they slide, at its start and at its end
double bent_over(double way, double z, const std::array<double, 2>& sliding, double elastic_share) {
  const double from = sliding[0], to = sliding[1];
  if (way > kSurelySliding * std::max(from, to)) return to;
  if (way == 0.0) return z;
  const double mean = 0.5 * (from + to);
  const int count = static_cast<int>(std::ceil(way / (kPartOfBend * mean)));
  const double ds = way / count;
  const auto slope = [&](double part, double bent) {
    const double now = from + (to - from) * part / count;
    return slope_of_bristles(bent, std::max(now, kLeastBound * mean), elastic_share);
  };
  for (int k = 0; k < count; ++k) {  // Runge-Kutta
    const double a = slope(k, z);
    const double b = slope(k + 0.5, z + 0.5 * ds * a);
    const double c = slope(k + 0.5, z + 0.5 * ds * b);
    const double d = slope(k + 1, z + ds * c);
    z += ds / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return way > kSurelySliding * to ? std::min(z, to) : z;
}

// Slope dz/ds above which they count as elastic; below half of it they nearly slide.
constexpr double kHardlyBent = 0.5;
// Of differences by the load: far above rounding, and what they leave out is of its square.
constexpr double kHeavier = 1e-6;

}  // namespace

BristleFriction::Bend BristleFriction::bend(const Sight& sight) const {
  const double rate = sight.coordinate.rate;
  Bend out;
  const FrictionBound most = bound_.at(sight);
  out.bound = most.at(most.load(sight), rate);
  const double before = sight.states != nullptr ? sight.states[0] : 0.0;
  const double bound_before = sight.states != nullptr ? sight.states[1] : 0.0;
  // Over the way f_s goes from the one at the start of the step to that at its end.
  const double to = out.bound / bristles_.stiffness;
  const double from = bound_before > 0.0 ? bound_before / bristles_.stiffness : to;
  const double way = std::abs(sight.coordinate.change);
  const double sign = sight.coordinate.change < 0.0 ? -1.0 : 1.0;
  out.z =
      to > 0.0 ? sign * bent_over(way, sign * before, {from, to}, bristles_.elastic_share) : 0.0;
  const double ahead = rate < 0.0 ? -out.z : out.z;
  out.slope = to > 0.0 ? slope_of_bristles(ahead, to, bristles_.elastic_share) : 0.0;
  return out;
}

Action BristleFriction::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                                 const spatial::MarkerMotion& /*second*/) const {
  return {};
}

double BristleFriction::force(const Sight& sight, const Bend& now) const {
  const double rate = sight.coordinate.rate;
  return -bristles_.stiffness * now.z - bristles_.damping * rate * now.slope -
         bound_.at(sight).data().viscous * rate;
}

Action BristleFriction::respond(const Sight& sight) const {
  const Bend now = bend(sight);
  const double rate = sight.coordinate.rate;
  const double bent_rate = rate * now.slope;
  const double elastic = bristles_.stiffness * now.z;
  const double force = this->force(sight, now);
  Action out = along_coordinate(sight.coordinate, force);
  out.stored_energy = 0.5 * elastic * now.z;
  out.active_power = force * rate + elastic * bent_rate;
  out.dissipation = -out.active_power;
  // Bristles bend over steps or within one: their tangent is formed again as their slope falls.
  const int bent = now.slope > kHardlyBent ? 0 : now.slope > 0.5 * kHardlyBent ? 1 : 2;
  out.regime = rate < 0.0 ? -bent : bent;
  return out;
}

void BristleFriction::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const double slope = std::max(0.0, bend(sight).slope);
  SoftRow row;
  row.J = sight.coordinate.J;
  row.stiffness = slope * bristles_.stiffness;
  row.damping = slope * bristles_.damping + bound_.at(sight).data().viscous;
  rows.push_back(row);
}

void BristleFriction::append_slopes(const Sight& sight, int /*regime*/,
                                    std::vector<spatial::Wrench>& out) const {
  // Across a whole step z has no simple derivative: a difference. The load grows with the reaction.
  const FrictionBound bound = bound_.at(sight);
  const double load = bound.load(sight);
  const auto with = [&](double factor) {
    Sight other = sight;
    other.reaction.force *= factor;
    other.reaction.torque *= factor;
    return force(other, bend(other));
  };
  const double growth =
      load > 0.0 ? (with(1.0 + kHeavier) - with(1.0 - kHeavier)) / (2.0 * kHeavier * load) : 0.0;
  out.push_back(bound.load_slope(sight, growth));
}

void BristleFriction::find_states(const Sight& sight, double* states) const {
  const Bend now = bend(sight);
  states[0] = now.z;
  states[1] = now.bound;
}

}  // namespace buckens::loads

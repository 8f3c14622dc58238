// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using test::MarkerPath;
using ShapeKind = ContactShape::Kind;

using ContactWrenches = Eigen::Matrix<double, 12, 1>;

ContactShape shape(ShapeKind kind) {
  ContactShape out;
  out.kind = kind;
  out.radius = kind == ShapeKind::bore || kind == ShapeKind::socket ? 0.9 : 0.3;
  out.half_length = 0.4;
  out.half = {0.3, 0.4, 0.2};
  out.axis = Vector3d(0.2, -0.3, 0.9).normalized();
  return out;
}

/// Those that touch with points; lines and volumes have tests of their own.
const std::vector<std::pair<ShapeKind, ShapeKind>> kPairs = {
    {ShapeKind::plane, ShapeKind::sphere},   {ShapeKind::sphere, ShapeKind::sphere},
    {ShapeKind::socket, ShapeKind::sphere},  {ShapeKind::bore, ShapeKind::sphere},
    {ShapeKind::capsule, ShapeKind::sphere}, {ShapeKind::cylinder, ShapeKind::sphere},
    {ShapeKind::box, ShapeKind::sphere},     {ShapeKind::plane, ShapeKind::capsule},
    {ShapeKind::plane, ShapeKind::cylinder}, {ShapeKind::plane, ShapeKind::box},
    {ShapeKind::bore, ShapeKind::cylinder}};

/// Second markers along a line through the first, so that some of them touch.
MarkerPath second_at(double distance) {
  MarkerPath out = MarkerPath::some(2);
  const MarkerPath first = MarkerPath::some(1);
  out.p = first.p + distance * (first.R * Vector3d(0.5, -0.4, 0.75).normalized());
  return out;
}

ContactData rough() {
  ContactData data;
  data.stiffness = 50.0;
  data.exponent = 1.5;
  data.loss = loss_factor(0.7);
  data.threshold = 2.0;
  data.damping = 0.3;
  data.static_coefficient = data.dynamic_coefficient = 0.4;
  data.tangential_stiffness = 30.0;
  data.inertia = 0.2;
  return data;
}

ContactWrenches stacked(const Action& action) {
  ContactWrenches out;
  out << action.on_first.torque, action.on_first.force, action.on_second.torque,
      action.on_second.force;
  return out;
}

TEST(ContactPair, GapsChangeAsTheirRowsSay) {
  // The gap's rate from velocities at the place equals the derivative of the distance: place and
  // normal are right, for every pair and every point.
  for (const auto& [a, b] : kPairs) {
    const ContactPair pair(shape(a), shape(b));
    const MarkerPath first = MarkerPath::some(1);
    const MarkerPath second = second_at(0.45);
    ContactPair::Spots spots;
    const auto find = [&](double t) {
      const MarkerMotion F = first.at(t), M = second.at(t);
      pair.find(F.R.transpose() * (M.p - F.p), F.R.transpose() * M.R, spots);
    };
    for (int k = 0; k < pair.num_spots(); ++k) {
      const double rate = test::derivative(
          [&](double t) {
            find(t);
            return spots[static_cast<std::size_t>(k)].gap;
          },
          1e-4);
      find(0.0);
      const ContactSpot& spot = spots[static_cast<std::size_t>(k)];
      EXPECT_NEAR(spot.normal.norm(), 1.0, 1e-14);
      const Vector3d place = first.p + first.R * spot.place;
      const Vector3d v =
          second.v + second.w.cross(place - second.p) - first.v - first.w.cross(place - first.p);
      // Corners move as they are; the lowest points of rims move on along them, across the normal
      // only for the lowest and highest, which are every second.
      const bool slides_along_rim = b == ShapeKind::cylinder && a == ShapeKind::plane && k % 2 == 1;
      if (slides_along_rim) continue;
      // Differences of positions of size 1 over 1e-4, fourth order.
      EXPECT_NEAR(rate, (first.R * spot.normal).dot(v), 1e-9)
          << static_cast<int>(a) << " " << static_cast<int>(b) << " " << k;
    }
  }
}

TEST(ContactPair, DistancesAreTheSmallest) {
  // Against brute force: no point of the sphere's centre line to the surface is shorter.
  const Vector3d centre(0.7, -0.5, 0.4);
  ContactPair::Spots spots;
  for (const ShapeKind kind : {ShapeKind::capsule, ShapeKind::cylinder, ShapeKind::box}) {
    const ContactShape solid = shape(kind);
    const ContactPair pair(solid, shape(ShapeKind::sphere));
    pair.find(centre, Matrix3d::Identity(), spots);
    const double own = spots[0].gap + 0.3;
    const Vector3d on_surface = centre - own * spots[0].normal;
    // The foot lies on the surface: its distance is zero, and there the normal is the same.
    pair.find(on_surface + 1e-6 * spots[0].normal, Matrix3d::Identity(), spots);
    EXPECT_NEAR(spots[0].gap + 0.3, 1e-6, 1e-12);
    // No sampled point of the solid is nearer.
    double least = HUGE_VAL;
    constexpr int kSamples = 40;
    for (int i = 0; i <= kSamples; ++i) {
      for (int j = 0; j <= kSamples; ++j) {
        for (int k = 0; k <= kSamples; ++k) {
          const Vector3d x = (2.0 / kSamples * Vector3d(i, j, k) - Vector3d::Ones()) * 0.8;
          pair.find(x, Matrix3d::Identity(), spots);
          if (spots[0].gap + 0.3 <= 0.0) least = std::min(least, (x - centre).norm());
        }
      }
    }
    EXPECT_GE(least, own - 1e-12);
    EXPECT_LE(least, own + 0.07);  // width of the samples
  }
}

TEST(ContactLaw, ItsLossGivesTheRestitution) {
  // Fourth-order Runge-Kutta of m d'' = -K d^n (1 + a d'/v), m = K = v = 1, until it parts.
  for (const double n : {1.0, 1.5}) {
    for (const double e : {0.05, 0.3, 0.7, 0.95}) {
      const double a = loss_factor(e);
      const auto acceleration = [&](double d, double v) {
        return d > 0.0 ? -std::pow(d, n) * (1.0 + a * v) : 0.0;
      };
      double d = 0, v = 1;
      const double h = 1e-4;
      do {
        const double k1 = v, l1 = acceleration(d, v);
        const double k2 = v + 0.5 * h * l1, l2 = acceleration(d + 0.5 * h * k1, k2);
        const double k3 = v + 0.5 * h * l2, l3 = acceleration(d + 0.5 * h * k2, k3);
        const double k4 = v + h * l3, l4 = acceleration(d + h * k3, k4);
        d += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
      } while (d > 0.0);
      EXPECT_NEAR(-v, e, 1e-6) << "n = " << n;  // of the last step, that d leaves zero in
    }
  }
  EXPECT_EQ(loss_factor(1.0), 0.0);
}

TEST(ContactLaw, HertzOfSteelBallsIsTheTextbookOne) {
  // Two equal steel balls, R 10 mm: E* = E/2/(1 - nu^2), K = 4/3 E* sqrt(R/2).
  const double K = hertz_stiffness({210e9, 210e9}, {0.3, 0.3}, 2.0 / 0.01);
  EXPECT_NEAR(K, 4.0 / 3.0 * 210e9 / 2 / 0.91 * std::sqrt(0.005), 1e-4);
}

/// A contact in the middle of a step, with states of an earlier instant.
struct Midway {
  explicit Midway(const Contact& contact) {
    const ShapeKind around = contact.pair().first().kind;
    second = second_at(around == ShapeKind::bore || around == ShapeKind::socket ? 0.8 : 0.3);
    states.resize(static_cast<std::size_t>(contact.num_states()));
    const MarkerMotion F = first.at(-0.01), M = second.at(-0.01);
    contact.start_states(Sight{-0.01, F, M}, states.data());
  }
  Action at(const Contact& contact, double t) const {
    const MarkerMotion F = first.at(t), M = second.at(t);
    Sight sight{t, F, M};
    sight.states = states.data();
    return contact.respond(sight);
  }

  MarkerPath first = MarkerPath::some(1);
  MarkerPath second;
  std::vector<double> states;
};

TEST(Contact, ActsAndReactsAtOnePlace) {
  for (const auto& [a, b] : kPairs) {
    const Contact contact({shape(a), shape(b)}, rough());
    const Midway step(contact);
    const Action action = step.at(contact, 0.0);
    EXPECT_LE((action.on_first.force + action.on_second.force).norm(), 1e-13);
    const Vector3d moment = action.on_first.torque + action.on_second.torque +
                            step.first.p.cross(action.on_first.force) +
                            step.second.p.cross(action.on_second.force);
    EXPECT_LE(moment.norm(), 1e-12);
  }
}

TEST(Contact, PowerIsLossOfStoredEnergyAndActivePower) {
  int touching = 0;
  for (const auto& [a, b] : kPairs) {
    ContactData data = rough();
    data.static_coefficient = data.dynamic_coefficient = 0.0;
    const Contact contact({shape(a), shape(b)}, data);
    const Midway step(contact);
    const Action action = step.at(contact, 0.0);
    if (action.on_second.force.norm() == 0.0) continue;
    if (a == ShapeKind::plane && b == ShapeKind::cylinder) continue;  // points that move along rims
    ++touching;
    ContactWrenches twists;
    twists << step.first.w, step.first.v, step.second.w, step.second.v;
    const double rate =
        test::derivative([&](double t) { return step.at(contact, t).stored_energy; }, 1e-4);
    EXPECT_NEAR(stacked(action).dot(twists), action.active_power - rate, 1e-8);
    EXPECT_NEAR(action.dissipation, -action.active_power, 1e-14);
  }
  EXPECT_GE(touching, 7);
}

/// Change of the force predicted by the tangent, for displacements or velocities.
ContactWrenches predicted(const Contact& contact, const Sight& sight, const ContactWrenches& change,
                          bool elastic) {
  std::vector<SoftRow> rows;
  contact.append_tangent(sight, rows);
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(contact.num_soft_rows()));
  ContactWrenches out = ContactWrenches::Zero();
  for (const SoftRow& row : rows) {
    out -= (elastic ? row.stiffness : row.damping) * row.J.dot(change) * row.J.transpose();
  }
  return out;
}

/// A sphere that sticks on a plane with a force along it.
TEST(Contact, TangentOfStickingIsTheDerivative) {
  ContactData data = rough();
  data.loss = data.damping = 0.0;
  data.static_coefficient = data.dynamic_coefficient = 5.0;
  ContactShape plane = shape(ShapeKind::plane);
  plane.axis = Vector3d::UnitZ();
  const Contact contact({plane, shape(ShapeKind::sphere)}, data);
  MarkerMotion F, M;
  M.p = {0.0, 0.0, 0.2};
  std::vector<double> states(static_cast<std::size_t>(contact.num_states()));
  contact.start_states(Sight{0.0, F, M}, states.data());
  const auto force = [&](const Vector3d& shift, const Vector3d& v) {
    MarkerMotion moved = M;
    moved.p += shift;
    moved.v = v;
    Sight sight{0.01, F, moved};
    sight.states = states.data();
    return stacked(contact.respond(sight));
  };
  Sight sight{0.01, F, M};
  sight.states = states.data();
  for (int axis = 0; axis < 3; ++axis) {
    ContactWrenches change = ContactWrenches::Zero();
    change[9 + axis] = 1.0;
    const ContactWrenches by_place = test::derivative(
        [&](double x) {
          return ContactWrenches(force(x * Vector3d::Unit(axis), Vector3d::Zero()));
        },
        1e-4);
    // Forces of size 1 at levers that change with the place: the part without them.
    ContactWrenches expected = predicted(contact, sight, change, true);
    EXPECT_LE((by_place.segment<3>(9) - expected.segment<3>(9)).norm(), 1e-8) << axis;
    const ContactWrenches by_rate = test::derivative(
        [&](double x) {
          return ContactWrenches(force(Vector3d::Zero(), x * Vector3d::Unit(axis)));
        },
        1e-4);
    expected = predicted(contact, sight, change, false);
    EXPECT_LE((by_rate - expected).norm(), 1e-8) << axis;
  }
}

TEST(Contact, RollingDoesNotSlip) {
  // A sphere that rolls by large steps: positions say exactly that nothing slips.
  ContactShape plane = shape(ShapeKind::plane);
  plane.axis = Vector3d::UnitZ();
  const Contact contact({plane, shape(ShapeKind::sphere)}, rough());
  MarkerMotion F, M;
  M.p = {0.0, 0.0, 0.29};
  std::vector<double> states(static_cast<std::size_t>(contact.num_states()));
  contact.start_states(Sight{0.0, F, M}, states.data());
  const double radius = 0.5 * (0.3 + 0.29);  // halfway between both surfaces
  for (int k = 1; k <= 40; ++k) {
    const double angle = 0.4 * k;
    M.p.x() = radius * angle;
    M.R = spatial::exp_rotation({0.0, angle, 0.0}).toRotationMatrix();
    Sight sight{0.01 * k, F, M};
    sight.states = states.data();
    EXPECT_LE(contact.read(sight).friction, 1e-12) << k;
    std::vector<double> next(states.size());
    contact.find_states(sight, next.data());
    states = next;
  }
}

TEST(Contact, SlidingDoesNotStoreAndTurnsWithTheSlip) {
  ContactShape plane = shape(ShapeKind::plane);
  plane.axis = Vector3d::UnitZ();
  const ContactData data = rough();
  const Contact contact({plane, shape(ShapeKind::sphere)}, data);
  MarkerMotion F, M;
  M.p = {0.0, 0.0, 0.2};
  std::vector<double> states(static_cast<std::size_t>(contact.num_states()));
  contact.start_states(Sight{0.0, F, M}, states.data());
  M.p += Vector3d(3.0, 4.0, 0.0);
  M.v = {3.0, 4.0, 0.0};
  Sight sight{1.0, F, M};
  sight.states = states.data();
  const Action action = contact.respond(sight);
  const double load = contact.read(sight).normal;
  EXPECT_NEAR(load, 50.0 * std::pow(0.1, 1.5), 1e-12);
  EXPECT_LE((action.on_second.force - Vector3d(-0.24 * load, -0.32 * load, load)).norm(), 1e-12);
  // The strain is what the force would hold.
  std::vector<double> next(states.size());
  contact.find_states(sight, next.data());
  const double held = 0.5 * std::pow(0.4 * load, 2) / data.tangential_stiffness;
  EXPECT_NEAR(action.stored_energy, load * 0.1 / 2.5 + held, 1e-12);
}

}  // namespace
}  // namespace buckens::loads

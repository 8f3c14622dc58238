// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cable.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/loads/capstan_slip.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

/// An end, three pulleys, an end, all of them moving.
struct Tackle {
  std::vector<spatial::MarkerMotion> at;
  CableData data;
  std::vector<double> states;

  explicit Tackle(std::optional<double> coefficient, double pretension = 400.0) {
    const std::array<Vector3d, 5> places = {Vector3d(-0.5, -1, 0), Vector3d(-0.2, 0.1, 0),
                                            Vector3d(0.1, -0.7, 0), Vector3d(0.5, 0.2, 0),
                                            Vector3d(0.8, -0.9, 0)};
    const std::array<double, 5> radii = {0, -0.1, 0.12, -0.15, 0};
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> speed(-0.5, 0.5);
    for (std::size_t k = 0; k < 5; ++k) {
      at.push_back({places[k], Eigen::Matrix3d::Identity(), Vector3d::Zero(), Vector3d::Zero()});
      at[k].v = Vector3d(speed(engine), speed(engine), 0);
      at[k].w = Vector3d(0, 0, 3 * speed(engine));
      data.nodes.push_back({radii[k], Vector3d::UnitX(), {}});
      if (radii[k] != 0.0) data.nodes.back().coefficient = coefficient;
    }
    data.first_pulley = 1;
    data.stiffness = 3e4;
    const std::array<int, 3> turns{};
    data.placed = Cable::placed_states(data, at, pretension, turns);
    states = data.placed;
  }
  std::vector<spatial::MarkerMotion> others() const { return {at.begin() + 2, at.end()}; }
  void move(double time) {
    for (spatial::MarkerMotion& m : at) {
      m.p += time * m.v;
      m.R = spatial::exp_rotation(time * m.w).toRotationMatrix() * m.R;
    }
  }
};

struct Seen {
  Action action;
  double power = 0;
  CableReading reading;
};

Seen look(const Cable& cable, const Tackle& t) {
  const auto others = t.others();
  Sight sight{0.0, t.at[0], t.at[1]};
  sight.states = t.states.data();
  sight.others = others;
  std::vector<spatial::Wrench> on_others(others.size());
  cable.add_to_others(sight, on_others);
  Seen out{cable.respond(sight), 0, cable.read(sight)};
  const auto add = [&](const spatial::Wrench& w, const spatial::MarkerMotion& m) {
    out.power += w.force.dot(m.v) + w.torque.dot(m.w);
  };
  add(out.action.on_first, t.at[0]);
  add(out.action.on_second, t.at[1]);
  for (std::size_t k = 0; k < others.size(); ++k) add(on_others[k], others[k]);
  return out;
}

TEST(Cable, GivesAndTakesThePowerOfItsStrain) {
  Tackle t(std::nullopt);
  const Cable cable(t.data);
  constexpr double kTime = 1e-6;
  Tackle before = t, behind = t;
  before.move(-kTime);
  behind.move(kTime);
  const Seen now = look(cable, t);
  const double rate =
      (look(cable, behind).action.stored_energy - look(cable, before).action.stored_energy) /
      (2 * kTime);
  // −dE/dt and what the strain carried over the rims takes, of the order of the strain.
  EXPECT_NEAR(now.power, now.action.active_power - rate, 1e-6 * std::abs(rate));
  EXPECT_LT(std::abs(now.action.active_power), 0.02 * std::abs(rate));
}

TEST(Cable, PassesForcesOnWithoutLeavingAny) {
  const Tackle t(std::nullopt);
  const Cable cable(t.data);
  const auto others = t.others();
  Sight sight{0.0, t.at[0], t.at[1]};
  sight.states = t.states.data();
  sight.others = others;
  std::vector<spatial::Wrench> on_others(3);
  cable.add_to_others(sight, on_others);
  const Action action = cable.respond(sight);
  Vector3d force = action.on_first.force + action.on_second.force;
  Vector3d moment = action.on_first.torque + t.at[0].p.cross(action.on_first.force) +
                    action.on_second.torque + t.at[1].p.cross(action.on_second.force);
  for (std::size_t k = 0; k < 3; ++k) {
    force += on_others[k].force;
    moment += on_others[k].torque + others[k].p.cross(on_others[k].force);
  }
  EXPECT_LT(force.norm(), 1e-10 * 400);
  EXPECT_LT(moment.norm(), 1e-10 * 400);
  for (const double tension : look(cable, t).reading.tensions) EXPECT_NEAR(tension, 400.0, 1e-9);
}

TEST(Cable, CountsWhatPulleysTakeInAndGiveOut) {
  Tackle t(std::nullopt);
  const Cable cable(t.data);
  // All motions in small steps, then back at once: spans are what they were.
  const auto follow = [&](double time) {
    t.move(time);
    const auto others = t.others();
    Sight sight{0.0, t.at[0], t.at[1]};
    sight.states = t.states.data();
    sight.others = others;
    std::vector<double> next(t.states.size());
    cable.find_states(sight, next.data());
    t.states = next;
  };
  for (int k = 0; k < 20; ++k) follow(0.01);
  for (int k = 0; k < 4; ++k) follow(-0.05);
  constexpr std::size_t kOfPulley = 7, kRates = 5;  // the last two of each are rates, which go on
  for (std::size_t k = 0; k < t.states.size(); ++k) {
    if (k < kOfPulley * cable.num_pulleys() && k % kOfPulley >= kRates) continue;
    EXPECT_NEAR(t.states[k], t.data.placed[k], 1e-12) << k;
  }
}

TEST(Cable, ResistsAlongItsRows) {
  for (const std::optional<double>& coefficient : {std::optional<double>(), {0.0}, {0.2}}) {
    Tackle t(coefficient);
    const Cable cable(t.data);
    t.move(2e-3);  // what slips has slipped
    const auto others = t.others();
    Sight sight{0.0, t.at[0], t.at[1]};
    sight.states = t.states.data();
    sight.others = others;
    std::vector<SoftRow> rows;
    std::vector<TwistRow> more;
    cable.append_tangent(sight, rows);
    cable.append_others_of_rows(sight, more);
    ASSERT_EQ(rows.size(), 4u);
    ASSERT_EQ(more.size(), 12u);
    RowMix mix = RowMix::Identity(4, 4);
    EXPECT_EQ(cable.mix_rows(sight, mix), coefficient == 0.0);  // 0.2 holds
    Eigen::Vector4d rates, forces;
    for (std::size_t n = 0; n < rows.size(); ++n) {
      Eigen::Matrix<double, 12, 1> V;
      V << t.at[0].w, t.at[0].v, t.at[1].w, t.at[1].v;
      double rate = rows[n].J.dot(V);
      for (std::size_t k = 0; k < 3; ++k) {
        Eigen::Matrix<double, 6, 1> W;
        W << others[k].w, others[k].v;
        rate += more[3 * n + k].dot(W);
      }
      rates[static_cast<int>(n)] = rate;
      forces[static_cast<int>(n)] = rows[n].stiffness * rate;
    }
    const double by_rows = rates.dot(mix * forces);
    // −d(power)/dt without the change of the rows: second difference of the work.
    constexpr double kTime = 1e-5;
    Tackle before = t, behind = t;
    before.move(-kTime);
    behind.move(kTime);
    const double tensions = -(look(cable, behind).power - look(cable, before).power) / (2 * kTime);
    // Rows turn, too: with tensions of 400 N in spans of a metre, 400 v²/L.
    EXPECT_NEAR(by_rows, tensions, 0.05 * tensions + 2500) << coefficient.value_or(-1);
    if (coefficient == 0.0) {
      Eigen::FullPivLU<RowMix> lu(mix);
      EXPECT_EQ(lu.setThreshold(1e-9).rank(), 1);  // one cable, one spring
    }
  }
}

TEST(CapstanSlip, LeavesTensionsWithinTheirBounds) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> tension(0.0, 500.0), stiffness(1e3, 1e5), wrap(0.0, 6.0);
  for (int trial = 0; trial < 200; ++trial) {
    CapstanSlip slip;
    const bool is_closed = trial % 2 == 0;
    const std::size_t pulleys = 5, spans = is_closed ? 5 : 6;
    slip.reset(spans, pulleys, is_closed);
    std::array<double, 6> k{}, before{};
    double length = 0.0, longer = 0.0;
    for (std::size_t j = 0; j < spans; ++j) {
      k[j] = stiffness(engine);
      before[j] = tension(engine) - (trial % 5 == 0 ? 100.0 : 0.0);
      slip.set_span(j, k[j], trial % 7 == 0 ? 0.5 * k[j] : 0.0, before[j], 0.0);
      length += before[j] / k[j];
    }
    std::array<double, 5> factor{};
    for (std::size_t i = 0; i < pulleys; ++i) {
      factor[i] = trial % 3 == 0 ? 1.0 : std::exp(0.2 * wrap(engine));
      slip.set_pulley(i, factor[i]);
    }
    ASSERT_TRUE(slip.solve());
    for (std::size_t j = 0; j < spans; ++j) longer += slip.elastic(j) / k[j];
    EXPECT_NEAR(longer, length, 1e-12);  // what one span loses another gets
    for (std::size_t i = 0; i < pulleys; ++i) {
      const std::size_t a = is_closed ? (i + spans - 1) % spans : i, b = is_closed ? i : i + 1;
      const double T_a = slip.tension(a), T_b = slip.tension(b);
      EXPECT_LE(T_b, factor[i] * T_a + 1e-9) << trial;
      EXPECT_LE(T_a, factor[i] * T_b + 1e-9) << trial;
      if (slip.slipped(i) > 0.0) {
        EXPECT_NEAR(T_b, factor[i] * T_a, 1e-9);
      }
      if (slip.slipped(i) < 0.0) {
        EXPECT_NEAR(T_a, factor[i] * T_b, 1e-9);
      }
    }
  }
}

TEST(CapstanSlip, MixesForcesAsItsDerivativesDo) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> tension(50.0, 500.0), stiffness(1e3, 1e5), wrap(0.0, 6.0);
  constexpr double kForce = 1e-4;  // of which no regime takes notice [N]
  int slipping = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const bool is_closed = trial % 2 == 0;
    const std::size_t pulleys = 4, spans = is_closed ? 4 : 5;
    std::array<double, 5> k{}, before{};
    std::array<double, 4> factor{};
    for (std::size_t j = 0; j < spans; ++j) k[j] = stiffness(engine), before[j] = tension(engine);
    for (double& m : factor) m = std::exp(0.2 * wrap(engine));
    const auto solved = [&](std::size_t pulled, double force) {
      CapstanSlip slip;
      slip.reset(spans, pulleys, is_closed);
      for (std::size_t j = 0; j < spans; ++j) {
        slip.set_span(j, k[j], 0.0, before[j] + (j == pulled ? force : 0.0), 0.0);
      }
      for (std::size_t i = 0; i < pulleys; ++i) slip.set_pulley(i, factor[i]);
      EXPECT_TRUE(slip.solve());
      return slip;
    };
    const CapstanSlip now = solved(0, 0.0);
    const RowMix mix = now.mix();
    for (std::size_t j = 0; j < spans; ++j) {
      const CapstanSlip less = solved(j, -kForce), more = solved(j, kForce);
      if (less.regime() != now.regime() || more.regime() != now.regime()) continue;
      slipping += now.has_slipped() ? 1 : 0;
      for (std::size_t i = 0; i < spans; ++i) {
        const double slope = (more.tension(i) - less.tension(i)) / (2.0 * kForce);
        // Sweeps end at 1e-15 of the largest tension: 1e-12 N of 2e-4 N.
        EXPECT_NEAR(mix(static_cast<int>(i), static_cast<int>(j)), slope, 1e-7) << trial;
      }
    }
  }
  EXPECT_GT(slipping, 200);
}

TEST(Cable, SaysWhichSpanCannotBeFormed) {
  Tackle t(std::nullopt);
  t.at[2].p = t.at[1].p + Vector3d(0.2, 0, 0);
  const std::array<int, 3> turns{};
  EXPECT_THROW(Cable::placed_states(t.data, t.at, 0.0, turns), InputError);
  const Cable cable(t.data);
  EXPECT_THROW(look(cable, t), NumericalError);
}

}  // namespace
}  // namespace buckens::loads

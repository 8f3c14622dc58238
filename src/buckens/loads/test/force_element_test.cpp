// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/force_element.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/loads/applied_load.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using test::MarkerPath;

using Wrenches = Eigen::Matrix<double, 12, 1>;

constexpr double kTime = 0.2;
const MarkerPath kFirst = MarkerPath::some(1);
const MarkerPath kSecond = MarkerPath::some(2);

base::TimeLaw law(const std::string& text) {
  return base::TimeLaw::expression(base::Expression(text, {"t"}, {}, {}));
}

Bushing::Coefficients coefficients() {
  Bushing::Coefficients k;
  k.stiffness << 30, 50, 20;
  k.rotational_stiffness << 4, 7, 5;
  k.damping << 0.7, 0.2, 0.5;
  k.rotational_damping << 0.3, 0.6, 0.1;
  return k;
}

/// Elements between kFirst and kSecond, away from their position without force.
std::vector<std::pair<const char*, std::unique_ptr<ForceElement>>> stretched() {
  std::vector<std::pair<const char*, std::unique_ptr<ForceElement>>> out;
  out.emplace_back("spring-damper",
                   std::make_unique<SpringDamper>(40.0, 2.0, 0.3, law("1+sin(3*t)")));
  const Matrix3d R_FM = kFirst.R.transpose() * kSecond.R;
  const Matrix3d before = spatial::exp_rotation({0.4, -0.3, 0.6}).toRotationMatrix() * R_FM;
  out.emplace_back("bushing",
                   std::make_unique<Bushing>(coefficients(), before, Vector3d(0.1, 0.2, -0.3)));
  out.emplace_back("torsional spring", std::make_unique<TorsionalSpring>(Vector3d(0.3, -0.5, 0.8),
                                                                         before, 12.0, 0.8, 0.2));
  return out;
}

Wrenches stack(const Action& action) {
  Wrenches out;
  out << action.on_first.torque, action.on_first.force, action.on_second.torque,
      action.on_second.force;
  return out;
}

Wrenches twists(const MarkerMotion& first, const MarkerMotion& second) {
  Wrenches out;
  out << first.w, first.v, second.w, second.v;
  return out;
}

TEST(ForceElement, PowerIsLossOfStoredEnergyAndActivePower) {
  for (const auto& [name, element] : stretched()) {
    const Action action = element->evaluate(kTime, kFirst.at(0), kSecond.at(0));
    const double energy_rate = test::derivative([&, &e = element](double t) {
      return e->evaluate(kTime, kFirst.at(t), kSecond.at(t)).stored_energy;
    });
    const double power = stack(action).dot(twists(kFirst.at(0), kSecond.at(0)));
    if (std::string(name) == "torsional spring") continue;  // its own test: other rotations
    // Truncation h⁴ times fifth derivatives of energies of some 10 J.
    EXPECT_NEAR(power, action.active_power - energy_rate, 1e-8) << name;
  }
}

TEST(ForceElement, TorsionalSpringKeepsEnergyForTurnsAboutItsAxis) {
  const Vector3d axis = Vector3d(0.3, -0.5, 0.8).normalized();
  const Matrix3d R_FM = kFirst.R.transpose() * kSecond.R;
  const TorsionalSpring spring(axis, R_FM, 12.0, 0.8, 0.2);
  MarkerPath second = kSecond;
  second.w = kFirst.w + 1.7 * (kFirst.R * axis);
  second.alpha = kFirst.alpha;
  second.R = spatial::exp_rotation(0.9 * (kFirst.R * axis)).toRotationMatrix() * second.R;
  const Action action = spring.evaluate(kTime, kFirst.at(0), second.at(0));
  EXPECT_NEAR(action.stored_energy, 0.5 * 12.0 * 0.7 * 0.7, 1e-13);
  const double power = stack(action).dot(twists(kFirst.at(0), second.at(0)));
  EXPECT_NEAR(power, -12.0 * 0.7 * 1.7 - 0.8 * 1.7 * 1.7, 1e-12);
  EXPECT_NEAR(action.active_power, -0.8 * 1.7 * 1.7, 1e-13);
}

TEST(ForceElement, ActsAndReacts) {
  for (const auto& [name, element] : stretched()) {
    const Action a = element->evaluate(kTime, kFirst.at(0), kSecond.at(0));
    EXPECT_LE((a.on_first.force + a.on_second.force).norm(), 1e-14) << name;
    const Vector3d moment = a.on_first.torque + a.on_second.torque +
                            kFirst.p.cross(a.on_first.force) + kSecond.p.cross(a.on_second.force);
    EXPECT_LE(moment.norm(), 1e-13) << name;
  }
}

Wrenches soft_force(const ForceElement& element, const MarkerMotion& first,
                    const MarkerMotion& second, const Wrenches& change, bool elastic) {
  std::vector<SoftRow> rows;
  element.append_tangent({0.0, first, second}, rows);
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(element.num_soft_rows()));
  Wrenches out = Wrenches::Zero();
  for (const SoftRow& row : rows) {
    out -= (elastic ? row.stiffness : row.damping) * row.J.dot(change) * row.J.transpose();
  }
  return out;
}

TEST(ForceElement, SoftRowsAreTheDerivativeByVelocities) {
  // Forces are affine in the velocities, at any displacement.
  for (const auto& [name, element] : stretched()) {
    MarkerMotion first = kFirst.at(0);
    MarkerMotion second = kSecond.at(0);
    const Wrenches moving = stack(element->evaluate(kTime, first, second));
    const Wrenches expected = soft_force(*element, first, second, twists(first, second), false);
    first.w = first.v = second.w = second.v = Vector3d::Zero();
    const Wrenches resting = stack(element->evaluate(kTime, first, second));
    EXPECT_LE((moving - resting - expected).norm(), 1e-13 * moving.norm()) << name;
  }
}

TEST(ForceElement, SoftRowsAreTheDerivativeByDisplacementsWithoutForce) {
  const Matrix3d R_FM = kFirst.R.transpose() * kSecond.R;
  const Vector3d r_F = kFirst.R.transpose() * (kSecond.p - kFirst.p);
  std::vector<std::pair<const char*, std::unique_ptr<ForceElement>>> elements;
  elements.emplace_back(
      "spring-damper",
      std::make_unique<SpringDamper>(40.0, 2.0, (kSecond.p - kFirst.p).norm(), std::nullopt));
  elements.emplace_back("bushing", std::make_unique<Bushing>(coefficients(), R_FM, r_F));
  elements.emplace_back("torsional spring", std::make_unique<TorsionalSpring>(
                                                Vector3d(0.3, -0.5, 0.8), R_FM, 12.0, 0.8, 0.0));
  for (const auto& [name, element] : elements) {
    const auto resting = [](MarkerMotion m) {
      m.w = m.v = Vector3d::Zero();
      return m;
    };
    const Wrenches change = test::derivative([&, &e = element](double t) {
      return Wrenches(stack(e->evaluate(kTime, resting(kFirst.at(t)), resting(kSecond.at(t)))));
    });
    const Wrenches expected = soft_force(*element, kFirst.at(0), kSecond.at(0),
                                         twists(kFirst.at(0), kSecond.at(0)), true);
    EXPECT_LE((change - expected).norm(), 1e-8 * expected.norm()) << name;
  }
}

TEST(ForceElement, SpringDamperPullsWithItsTension) {
  const SpringDamper spring(100.0, 5.0, 1.5, law("2*t"));
  MarkerMotion first, second;
  second.p << 2, 0, 0;
  second.v << 0.4, 3, 0;  // only 0.4 along the line
  const Action action = spring.evaluate(kTime, first, second);
  const double tension = 100 * 0.5 + 5 * 0.4 + 2 * kTime;
  EXPECT_LE((action.on_first.force - Vector3d(tension, 0, 0)).norm(), 1e-13);
  EXPECT_NEAR(action.stored_energy, 0.5 * 100 * 0.25, 1e-13);
  EXPECT_FALSE(spring.is_constant());
}

TEST(ForceElement, AppliedLoadsStandInTheWorldOrFollow) {
  const std::array<base::TimeLaw, 3> value = {base::TimeLaw::constant(1.0), law("t"),
                                              base::TimeLaw::constant(-2.0)};
  const Vector3d at_time(1.0, kTime, -2.0);
  const MarkerMotion m = kFirst.at(0);
  const AppliedLoad fixed(AppliedLoad::Kind::force, LoadAxes::fixed, value);
  EXPECT_LE((fixed.evaluate(kTime, m, {}).on_first.force - at_time).norm(), 1e-15);
  EXPECT_NEAR(fixed.evaluate(kTime, m, {}).active_power, at_time.dot(m.v), 1e-14);
  const AppliedLoad following(AppliedLoad::Kind::torque, LoadAxes::following, value);
  EXPECT_LE((following.evaluate(kTime, m, {}).on_first.torque - m.R * at_time).norm(), 1e-15);
  EXPECT_NEAR(following.evaluate(kTime, m, {}).active_power, (m.R * at_time).dot(m.w), 1e-14);
  EXPECT_FALSE(fixed.is_constant());
  EXPECT_EQ(fixed.num_soft_rows(), 0);
}

TEST(ForceElement, RefusesWhatHasNoDirectionOrNoAngle) {
  const auto message = [](const ForceElement& element, const MarkerMotion& second) {
    try {
      element.evaluate(0.0, {}, second);
    } catch (const NumericalError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message(SpringDamper(1.0, 0.0, 1.0, std::nullopt), {}),
              testing::HasSubstr("no direction"));
  EXPECT_EQ(message(SpringDamper(1.0, 0.0, 0.0, std::nullopt), {}), "no error");
  MarkerMotion wound;
  wound.R = spatial::exp_rotation({0, 0, 3.1}).toRotationMatrix();
  const TorsionalSpring spring(Vector3d::UnitZ(), Matrix3d::Identity(), 1.0, 0.0, 0.0);
  EXPECT_THAT(message(spring, wound), testing::HasSubstr("3 rad"));
  const auto bushing = [](const Vector3d& rotational) {
    return Bushing({{1, 1, 1}, rotational, {}, {}}, Matrix3d::Identity(), Vector3d::Zero());
  };
  EXPECT_THAT(message(bushing({50, 50, 1}), wound), testing::HasSubstr("3.1 rad"));
  EXPECT_THAT(message(bushing({50, 50, 1}), wound), testing::HasSubstr("limit the motion"));
  EXPECT_EQ(message(bushing({50, 50, 0}), wound), "no error") << "nothing resists the turn";
  wound.R = spatial::exp_rotation({0, 0, 2.9}).toRotationMatrix();
  EXPECT_EQ(message(bushing({50, 50, 1}), wound), "no error");
}

}  // namespace
}  // namespace buckens::loads

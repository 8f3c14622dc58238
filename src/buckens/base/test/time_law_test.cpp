// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/time_law.h"

#include <cmath>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/differentiate.h"
#include "buckens/base/errors.h"

namespace buckens::base {
namespace {

using testing::HasSubstr;

const SourceLocation kPlace{"model.yaml", 7, 20};

TimeLaw law(const std::string& text, double scale = 1.0) {
  return TimeLaw::expression(Expression(text, {"t"}, {{"L", 0.3}}, kPlace), scale);
}

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(TimeLaw, ConstantHasNoDerivatives) {
  EXPECT_EQ(TimeLaw().value(3.0), 0.0);
  const TimeLaw five = TimeLaw::constant(5.0);
  EXPECT_EQ(five.value(1.0), 5.0);
  EXPECT_EQ(five.rate(1.0), 0.0);
  EXPECT_EQ(five.acceleration(1.0), 0.0);
  EXPECT_TRUE(five.is_constant());
  EXPECT_TRUE(law("2*L + sin(pi/2)").is_constant());
  EXPECT_DOUBLE_EQ(law("2*L").value(9.0), 0.6);
  EXPECT_FALSE(law("t").is_constant());
}

TEST(TimeLaw, ScaleAppliesToTheLawAndItsDerivatives) {
  const TimeLaw degrees = law("90*t^2", M_PI / 180);
  EXPECT_NEAR(degrees.value(2.0), 2 * M_PI, 1e-14);
  EXPECT_NEAR(degrees.rate(2.0), 2 * M_PI, 1e-11 * 2 * M_PI);
  EXPECT_NEAR(degrees.acceleration(2.0), M_PI, 1e-11 * M_PI);
}

struct Smooth {
  const char* text;
  std::function<double(double)> rate, acceleration;
  double rate_scale, acceleration_scale;
};

// 1e-11 of the derivative's own scale is what the drives need: their error in the constraints is
// then far below the Newton tolerance.
TEST(TimeLaw, DerivativesOfSmoothFormulasAreExactToElevenDigits) {
  using std::cos, std::exp, std::sin;
  const std::vector<Smooth> cases = {
      {"sin(150*t)", [](double t) { return 150 * cos(150 * t); },
       [](double t) { return -22500 * sin(150 * t); }, 150, 22500},
      {"0.5*150*t^2", [](double t) { return 150 * t; }, [](double) { return 150.0; }, 1, 150},
      {"exp(t)", [](double t) { return exp(t); }, [](double t) { return exp(t); }, 1, 1},
      {"exp(-40*t)", [](double t) { return -40 * exp(-40 * t); },
       [](double t) { return 1600 * exp(-40 * t); }, 40, 1600},
      {"150*t", [](double) { return 150.0; }, [](double) { return 0.0; }, 150, 1500},
      {"sin(8*pi*t)", [](double t) { return 8 * M_PI * cos(8 * M_PI * t); },
       [](double t) { return -64 * M_PI * M_PI * sin(8 * M_PI * t); }, 25, 632},
      {"6/15*(t - 15/(2*pi)*sin(2*pi*t/15))",
       [](double t) { return 0.4 * (1 - cos(2 * M_PI * t / 15)); },
       [](double t) { return 0.4 * 2 * M_PI / 15 * sin(2 * M_PI * t / 15); }, 0.8, 0.17}};
  for (const Smooth& smooth : cases) {
    const TimeLaw formula = law(smooth.text);
    for (const double t : {0.0, 1e-4, 0.013, 0.25, 0.5, 1.0, 2.7}) {
      EXPECT_NEAR(formula.rate(t), smooth.rate(t), 1e-11 * smooth.rate_scale)
          << smooth.text << " at " << t;
      EXPECT_NEAR(formula.acceleration(t), smooth.acceleration(t),
                  1e-11 * smooth.acceleration_scale)
          << smooth.text << " at " << t;
    }
  }
}

// Wide differences give equal values on both sides here; they must not be trusted.
TEST(TimeLaw, PulsesAndKinksElsewhereDoNoHarm) {
  const TimeLaw gauss = law("exp(-((t - 0.1)/0.01)^2)");
  const double x = 0.5, f = std::exp(-x * x);
  EXPECT_NEAR(gauss.rate(0.105), -2 * x / 0.01 * f, 1e-9);
  EXPECT_NEAR(gauss.acceleration(0.105), (4 * x * x - 2) / 1e-4 * f, 1e-6);
  const TimeLaw window = law("t > 0.1 && t < 0.2 ? 100*t : 0");
  EXPECT_NEAR(window.rate(0.15), 100.0, 1e-8);
  EXPECT_NEAR(window.acceleration(0.15), 0.0, 1e-3);
  EXPECT_NEAR(window.rate(0.3), 0.0, 1e-12);
  const TimeLaw ramp = law("t < 1 ? 3*t^2 : 6*t - 3");
  EXPECT_NEAR(ramp.acceleration(0.99), 6.0, 1e-6);
  EXPECT_NEAR(ramp.acceleration(1.01), 0.0, 1e-6);
}

TEST(TimeLaw, LinearTableIsHeldOutsideOfItsRangeWhereAskedFor) {
  const TimeLaw table =
      TimeLaw::table({0, 1, 3}, {2, 4, 0}, Interpolation::linear, Extrapolation::hold);
  EXPECT_FALSE(table.range().has_value());
  EXPECT_EQ(table.value(-5), 2);
  EXPECT_EQ(table.value(9), 0);
  EXPECT_DOUBLE_EQ(table.value(0.5), 3);
  EXPECT_DOUBLE_EQ(table.value(2), 2);
  EXPECT_EQ(table.rate(-1), 0);
  EXPECT_DOUBLE_EQ(table.rate(0), 2);
  EXPECT_DOUBLE_EQ(table.rate(1), -2);
  EXPECT_EQ(table.rate(3), 0);
  EXPECT_EQ(table.acceleration(0.5), 0);
  EXPECT_TRUE(TimeLaw::table({0, 1}, {2, 2}, Interpolation::linear).is_constant());
}

TEST(TimeLaw, TablesRefuseToGoOnBeyondTheirRange) {
  for (const Interpolation between : {Interpolation::linear, Interpolation::spline}) {
    const TimeLaw table = TimeLaw::table({0.5, 1, 3}, {2, 4, 0}, between, Extrapolation::refuse,
                                         {"model.yaml", 7, 3});
    ASSERT_TRUE(table.range().has_value());
    EXPECT_EQ(table.range()->first, 0.5);
    EXPECT_EQ(table.range()->last, 3);
    EXPECT_THAT(message([&] { table.value(3.1); }),
                testing::AllOf(HasSubstr("model.yaml:7:3"), HasSubstr("covers t = 0.5 s to 3 s"),
                               HasSubstr("at t = 3.1 s"), HasSubstr("extrapolation: hold")));
    EXPECT_THROW(table.value(0.4), NumericalError);
    EXPECT_THROW(table.rate(-1), NumericalError);
    EXPECT_THROW(table.acceleration(4), NumericalError);
    // The last step of a run ends where rounding puts it.
    EXPECT_EQ(table.value(3 + 1e-12), 0);
    EXPECT_EQ(table.value(0.5 - 1e-12), 2);
    EXPECT_NEAR(table.rate(3 + 1e-12), table.rate(3 - 1e-12), 1e-9);
  }
  const TimeLaw linear = TimeLaw::table({0, 1, 3}, {2, 4, 0}, Interpolation::linear);
  EXPECT_DOUBLE_EQ(linear.rate(3), -2);
  EXPECT_EQ(linear.corners(), std::vector<double>{1.0}) << "its ends are no corners";
  EXPECT_FALSE(TimeLaw::table({1}, {5}, Interpolation::linear).range().has_value());
  EXPECT_EQ(TimeLaw::table({1}, {5}, Interpolation::linear).value(9), 5);
}

TEST(TimeLaw, ASplineThatIsHeldHasCornersWhereItDoesNotRestAtItsEnds) {
  const std::vector<double> times = {0.5, 1, 2, 3};
  const auto corners = [&](const std::vector<double>& values, Extrapolation outside) {
    return TimeLaw::table(times, values, Interpolation::spline, outside).corners();
  };
  EXPECT_THAT(corners({0, 1, 3, 4}, Extrapolation::hold), testing::ElementsAre(0.5, 3));
  EXPECT_THAT(corners({0, 1, 3, 4}, Extrapolation::refuse), testing::IsEmpty());
  EXPECT_THAT(corners({2, 2, 2, 2}, Extrapolation::hold), testing::IsEmpty());
}

TEST(TimeLaw, SplineIsNaturalAndSmooth) {
  const TimeLaw spline = TimeLaw::table({0, 1, 2.5, 3}, {0, 1, -1, 2}, Interpolation::spline,
                                        Extrapolation::hold);  // differences go beyond its end
  EXPECT_NEAR(spline.acceleration(0), 0, 1e-14);
  EXPECT_NEAR(spline.acceleration(3 - 1e-12), 0, 1e-9);
  const double h = 1e-9;
  for (const double t : {1.0, 2.5}) {
    // Second derivatives are bounded by about 30 here.
    EXPECT_NEAR(spline.rate(t - h), spline.rate(t + h), 100 * h);
    EXPECT_NEAR(spline.acceleration(t - h), spline.acceleration(t + h), 1e-6);
  }
  const auto f = [&](double t) { return spline.value(t); };
  EXPECT_NEAR(spline.rate(1.7), *derivative(f, 1.7, 1), 1e-9);
  EXPECT_NEAR(spline.acceleration(1.7), *derivative(f, 1.7, 2), 1e-7);
  const TimeLaw line = TimeLaw::table({0, 1, 2, 5}, {1, 3, 5, 11}, Interpolation::spline);
  EXPECT_NEAR(line.value(3.3), 7.6, 1e-14);
}

TEST(TimeLaw, BadTablesAreRefused) {
  EXPECT_THAT(message([] {
                TimeLaw::table({0, 0}, {1, 2}, Interpolation::linear);
              }),
              HasSubstr("must increase"));
  EXPECT_THAT(message([] { TimeLaw::table({0}, {}, Interpolation::linear); }),
              HasSubstr("as many times as values"));
  EXPECT_THAT(message([] {
                TimeLaw::table({0, 1}, {0, NAN}, Interpolation::linear);
              }),
              HasSubstr("finite"));
}

TEST(TimeLaw, BadValuesNameFormulaPlaceAndTime) {
  const TimeLaw pole = law("1/(t - 0.5)");
  EXPECT_EQ(pole.value(1.0), 2.0);
  const std::string text = message([&] { pole.value(0.5); });
  EXPECT_THAT(text, HasSubstr("model.yaml:7:20"));
  EXPECT_THAT(text, HasSubstr("1/(t - 0.5)"));
  EXPECT_THAT(text, HasSubstr("t = 0.5"));
  EXPECT_THAT(text, HasSubstr("inf"));
  EXPECT_THROW(law("sqrt(t - 1)").value(0.0), NumericalError);
  EXPECT_THROW(law("sqrt(t - 1)").rate(0.0), NumericalError);
  EXPECT_THAT(message([] { law("(t - 1)^1.5").rate(1.0); }), HasSubstr("max(t, 0)"));
  EXPECT_NEAR(law("log(t + 0.001)").rate(0.0), 1000, 1e-6);
}

TEST(Expression, RefusesWhatIsWrongWhenItIsRead) {
  EXPECT_THAT(message([] { law("1/0"); }), HasSubstr("value inf"));
  EXPECT_THAT(message([] { law("0/0*L"); }), HasSubstr("value"));
  EXPECT_THAT(message([] { law("2*sni(t)"); }), HasSubstr("Did you mean \"sin\"?"));
  EXPECT_THAT(message([] { law("2*sni(t)"); }), HasSubstr("model.yaml:7:22"));
  EXPECT_THAT(message([] { law("2*(t"); }), HasSubstr("expression \"2*(t\""));
  EXPECT_THAT(message([] { law("t = 3"); }), HasSubstr("equality is =="));
  EXPECT_THAT(message([] { law("1,5"); }), HasSubstr("1.5"));
  EXPECT_THAT(message([] { law("x"); }), HasSubstr("unknown name \"x\""));
  EXPECT_THROW(law(""), InputError);
  EXPECT_THROW(law(std::string(30000, '(')), InputError);
  EXPECT_THROW(law(std::string(15000, '(')), InputError);
}

TEST(TimeLaw, SeveralThreadsGetTheSameNumbers) {
  const TimeLaw shared = law("sin(150*t) + L");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    threads.emplace_back([&, k] {
      for (int i = 0; i < 2000; ++i) {
        const double t = 1e-3 * i + 10.0 * static_cast<double>(k);
        if (shared.value(t) != std::sin(150 * t) + 0.3) ++wrong[k];
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(wrong, testing::Each(0));
}

// The upswing law loses digits inside the formula; the estimate must not be misled by chance
// anywhere.
TEST(TimeLaw, DerivativesHoldAllAlongAFormulaThatCancels) {
  const TimeLaw upswing = law("6/15*(t - 15/(2*pi)*sin(2*pi*t/15))");
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.01 * i;
    EXPECT_NEAR(upswing.rate(t), 0.4 * (1 - std::cos(2 * M_PI * t / 15)), 1e-10) << t;
    // Rounding of the terms (15 m) over the law's own time scale squared (2.4 s)² would be 6e-16;
    // three digits are lost where the widening stops early.
    EXPECT_NEAR(upswing.acceleration(t), 0.8 * M_PI / 15 * std::sin(2 * M_PI * t / 15), 1e-9) << t;
  }
}

TEST(TimeLaw, AtTheStartOnlyWhatFollowsCounts) {
  // A kink at t = 0 has the slope on its right, as the motion that begins there.
  EXPECT_NEAR(law("2*max(t, 0)").rate(0.0), 2.0, 1e-8);
  EXPECT_NEAR(law("abs(t)").rate(0.0), 1.0, 1e-8);
  EXPECT_NEAR(law("t < 0 ? 5 : 3 + 4*t + 6*t^2").rate(0.0), 4.0, 1e-6);
  // One-sided differences of rounded values over 1e-5: (1e-5)^2 and 1e-16/1e-10.
  EXPECT_NEAR(law("t < 0 ? 5 : 3 + 4*t + 6*t^2").acceleration(0.0), 12.0, 1e-3);
  EXPECT_NEAR(law("t < 0 ? 0 : t + sin(t)").acceleration(0.0), 0.0, 1e-4);
  // Not defined before the start; of the order of the root of the distance.
  EXPECT_NEAR(law("t^1.5").rate(0.0), 0.0, 1e-3);
  EXPECT_TRUE(std::isfinite(law("t^1.5").acceleration(0.0)));
  // Elsewhere a kink is straddled as before, and smooth laws have all their digits.
  EXPECT_NEAR(law("sin(150*t)").rate(0.0), 150.0, 1e-8);
  EXPECT_EQ(law("1000 + 1e-3*t^2").rate(0.0), 0.0);
  EXPECT_NEAR(law("3*t^2").acceleration(0.0), 6.0, 1e-9);
}

}  // namespace
}  // namespace buckens::base

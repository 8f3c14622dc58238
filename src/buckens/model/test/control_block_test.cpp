// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/control_block.h"

#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>

namespace buckens::model::test {
namespace {

/// Gain of a linear block at s = σ on the real axis, by solving σ x = f(x, 1).
double gain(const ControlBlock& block, double sigma) {
  const auto n = static_cast<std::size_t>(block.num_states());
  const auto count = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd A(count, count);
  std::vector<double> x(n, 0.0), zero_rates(n), rates(n);
  block.rates(x, 1.0, zero_rates);
  for (std::size_t k = 0; k < n; ++k) {
    x[k] = 1.0;
    block.rates(x, 1.0, rates);
    x[k] = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (i == k ? sigma : 0.0) - (rates[i] - zero_rates[i]);
    }
  }
  const Eigen::VectorXd b = Eigen::Map<Eigen::VectorXd>(zero_rates.data(), count);
  const Eigen::VectorXd states = A.partialPivLu().solve(b);
  return block.value({states.data(), n}, 1.0);
}

TEST(ControlBlock, IsTheQuotientOfItsPolynomials) {
  const auto block = make_transfer_function({2.0, 0.0, 3.0}, {4.0, 5.0, 6.0, 7.0});
  EXPECT_FALSE(block->feeds_through());
  const auto proper = make_transfer_function({2.0, 1.0}, {4.0, 5.0});
  EXPECT_TRUE(proper->feeds_through());
  EXPECT_EQ(make_transfer_function({3.0}, {2.0})->value({}, 4.0), 6.0);
  for (const double s : {0.3, 1.0, 7.0}) {
    EXPECT_NEAR(gain(*block, s), (2 * s * s + 3) / (4 * s * s * s + 5 * s * s + 6 * s + 7), 1e-13);
    EXPECT_NEAR(gain(*proper, s), (2 * s + 1) / (4 * s + 5), 1e-14);
  }
}

TEST(ControlBlock, PidHasThreeParts) {
  PidData data;
  data.proportional = 3.0;
  data.integral = 2.0;
  data.derivative = 0.5;
  data.filter = 0.1;
  data.lowest = -HUGE_VAL;
  data.highest = HUGE_VAL;
  const auto block = make_pid(data);
  for (const double s : {0.5, 4.0}) {
    EXPECT_NEAR(gain(*block, s), 3.0 + 2.0 / s + 0.5 * s / (1 + 0.1 * s), 1e-12);
  }
}

TEST(ControlBlock, LimitedIntegralsFollow) {
  PidData data;
  data.integral = 2.0;
  data.lowest = -1.0;
  data.highest = 1.0;
  data.tracking = 0.25;
  const auto block = make_pid(data);
  const std::array<double, 2> x = {1.5, 0.0};
  std::array<double, 2> rates{};
  block->rates(x, 0.3, rates);
  EXPECT_EQ(block->value(x, 0.3), 1.0);
  EXPECT_DOUBLE_EQ(rates[0], 2.0 * 0.3 + (1.0 - 1.5) / 0.25);

  data.sample = 0.1;
  const auto sampled = make_pid(data);
  std::array<double, 5> held{};
  sampled->start(held);
  for (int k = 0; k < 20; ++k) sampled->sample(held, 1.0);
  EXPECT_EQ(sampled->value(held, 0.0), 1.0);
  // Once above the limit it grows no further: 1 plus at most one sample of 0.2.
  EXPECT_LE(held[1], 1.2 + 1e-12);
}

}  // namespace
}  // namespace buckens::model::test

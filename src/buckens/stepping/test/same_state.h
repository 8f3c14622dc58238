// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <gtest/gtest.h>

#include "buckens/model/state.h"

namespace buckens::test {

inline void expect_same(const model::Coupling& a, const model::Coupling& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.load.whole(), b.load.whole());
  EXPECT_EQ(a.moments.J, b.moments.J);
  EXPECT_EQ(a.moments.J_dot, b.moments.J_dot);
  EXPECT_EQ(a.moments.l, b.moments.l);
  EXPECT_EQ(a.moments.l_dot, b.moments.l_dot);
}

inline void expect_same(const model::PastStep& a, const model::PastStep& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.lambda, b.lambda);
  EXPECT_EQ(a.accelerations, b.accelerations);
}

/// All numbers of both are bitwise equal.
inline void expect_same(const model::State& a, const model::State& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.lambda, b.lambda);
  EXPECT_EQ(a.lambda_time, b.lambda_time);
  EXPECT_EQ(a.last_step, b.last_step);
  EXPECT_EQ(a.had_rounds, b.had_rounds);
  EXPECT_EQ(a.history, b.history);
  expect_same(a.before, b.before);
  expect_same(a.earlier, b.earlier);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    const model::BodyState& x = a.bodies[k];
    const model::BodyState& y = b.bodies[k];
    EXPECT_EQ(x.frame.X_WB.p, y.frame.X_WB.p);
    EXPECT_EQ(x.frame.X_WB.q.coeffs(), y.frame.X_WB.q.coeffs());
    EXPECT_EQ(x.frame.v, y.frame.v);
    EXPECT_EQ(x.frame.w, y.frame.w);
    EXPECT_EQ(x.v_dot, y.v_dot);
    EXPECT_EQ(x.w_dot, y.w_dot);
    EXPECT_EQ(x.v_alg, y.v_alg);
    EXPECT_EQ(x.w_alg, y.w_alg);
    EXPECT_EQ(x.d.whole(), y.d.whole());
    EXPECT_EQ(x.d_dot.whole(), y.d_dot.whole());
    EXPECT_EQ(x.d_ddot.whole(), y.d_ddot.whole());
    EXPECT_EQ(x.d_alg.whole(), y.d_alg.whole());
    expect_same(x.coupling, y.coupling);
    expect_same(x.coupling_before, y.coupling_before);
    expect_same(x.coupling_earlier, y.coupling_earlier);
  }
}

}  // namespace buckens::test

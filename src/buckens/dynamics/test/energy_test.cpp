// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/energy.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"

namespace buckens::dynamics {
namespace {

using body::CouplingLevel;

/// A bent beam that turns and vibrates.
model::State moving(const model::Model& model) {
  model::State out = model::placed_state(model);
  model::BodyState& s = out.bodies[0];
  s.frame.w = {0.3, -0.8, 2.0};
  s.frame.v = {1.0, 0.5, -0.2};
  linalg::Vector &d = s.d.change(), &d_dot = s.d_dot.change();
  for (Eigen::Index k = 0; k < d.size(); ++k) {
    d[k] = 0.02 * std::sin(1.0 + 1.3 * static_cast<double>(k));
    d_dot[k] = std::cos(2.1 * static_cast<double>(k));
  }
  model.bodies[0].flexible->sieve.apply(d);
  model.bodies[0].flexible->sieve.apply(d_dot);
  return out;
}

TEST(Energy, IsThatOfTheInertiaThatALevelKeepsWithGeometricStiffnessToo) {
  double last = 0;
  for (const CouplingLevel level :
       {CouplingLevel::none, CouplingLevel::first_order, CouplingLevel::full}) {
    SCOPED_TRACE(body::to_string(level));
    const model::Model model = test::spatial_beam_pendulum({}, level);
    model::State state = moving(model);
    const Energy plain = energy(model, state);
    const Momentum momentum_plain = momentum(model, state);
    EXPECT_NE(plain.kinetic, last) << "the levels differ here";
    last = plain.kinetic;
    state.bodies[0].terms.stiffening = true;
    EXPECT_EQ(energy(model, state).kinetic, plain.kinetic);
    EXPECT_EQ(momentum(model, state).angular, momentum_plain.angular);
  }
}

}  // namespace
}  // namespace buckens::dynamics

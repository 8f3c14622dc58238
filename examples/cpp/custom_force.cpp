// SPDX-License-Identifier: Apache-2.0
// A ball falls through air: a force law of one's own, evaluated within each step. After four
// seconds a parachute opens, which a callback between steps does by a load with a value from
// outside.
#include <cmath>
#include <cstdio>

#include <buckens/buckens.h>

int main() {
  constexpr double g = 9.81, mass = 0.5, drag = 0.02, pull = 20;  // drag [N s²/m²], pull [N]
  using Eigen::Vector3d;

  buckens::ModelBuilder model("Ball in air");
  model.gravity({0, 0, -g});
  model.add_rigid("ball", mass, {0, 0, 0}, {1e-3, 1e-3, 1e-3});
  model.add_force_law("air", "ball",
                      [](double, const buckens::spatial::MarkerMotion& ball) -> Vector3d {
                        return -drag * ball.v.norm() * ball.v;
                      });
  model.add_force("parachute", "ball", {0, 0, 0});
  model.simulation(/*duration*/ 5, /*step*/ 1e-3);
  const auto built = model.build();

  buckens::Simulation simulation(*built);
  simulation.advance_to(2);
  const double terminal = std::sqrt(mass * g / drag);
  std::printf("speed %.6f exact %.6f m/s\n", -simulation.frame("ball").v.z(),
              terminal * std::tanh(2 * g / terminal));

  simulation.on_step([&](const buckens::StepView& now) {
    if (now.time() > 4 - 1e-9) now.set_load("parachute", {0, 0, pull});
    if (now.simulation().frame("ball").v.z() > -4) now.stop();
  });
  const buckens::RunSummary summary = simulation.run();
  std::printf("stopped %d at %.3f s with %.2f m/s\n", !summary.finished, summary.end_time,
              -simulation.frame("ball").v.z());
}

// SPDX-License-Identifier: Apache-2.0
// A uniform rod falls from the horizontal about a hinge at its end. The model is made in code and
// advanced step by step until the rod hangs down; then the state is saved, and a second simulation
// goes on from it. `pendulum OUT` records the motion in the run directory OUT, for `buckens view`.
#include <cmath>
#include <cstdio>

#include <buckens/buckens.h>

int main(int argc, char** argv) {
  constexpr double g = 9.81, length = 1, mass = 2;

  buckens::ModelBuilder model("Falling rod");
  model.gravity({0, -g, 0}).planar(buckens::spatial::Plane::xy);
  model.add_rigid("rod", mass, {length / 2, 0, 0}, {0, 0, mass * length * length / 12});
  model.add_marker("rod", "pin", {0, 0, 0});
  model.add_joint("hinge", buckens::joints::RevoluteSpec(), "ground", "rod/pin");
  auto& angle = model.add_sensor("angle", buckens::model::RelativeSensor());
  angle.between = {buckens::ModelBuilder::marker("ground"), buckens::ModelBuilder::marker("rod")};
  angle.quantity = buckens::model::RelativeQuantity::angle;
  model.simulation(/*duration*/ 1, /*step*/ 1e-3);

  const auto built = model.build();
  buckens::Simulation simulation(*built);
  while (simulation.sensor("angle")[0] > -M_PI / 2 && simulation.step()) {
  }
  std::printf("upright at %.4f s\n", simulation.time());
  std::printf("speed %.6f exact %.6f rad/s\n", -simulation.frame("rod").w.z(),
              std::sqrt(3 * g / length));

  buckens::Simulation second(*built);
  second.restore(simulation.save());
  simulation.run();
  second.run();
  std::printf("difference %g rad\n", second.sensor("angle")[0] - simulation.sensor("angle")[0]);

  if (argc > 1) {
    buckens::RunDirectory directory(argv[1], {"Falling rod", "", {}});
    buckens::Simulation recorded(*built);
    recorded.record_into(directory);
    recorded.run();
  }
}

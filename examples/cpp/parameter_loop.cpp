// SPDX-License-Identifier: Apache-2.0
// A flexible cantilever with a weight at its tip, for several diameters: how far it sags, and its
// frequency from the zero crossings of the swing after the weight was let go.
#include <cmath>
#include <cstdio>

#include <buckens/buckens.h>

int main() {
  constexpr double length = 0.5, load = 10, E = 2e11, rho = 7850;
  using buckens::ModelBuilder;

  for (const double diameter : {8e-3, 10e-3, 12e-3}) {
    ModelBuilder model("Cantilever");
    model.planar(buckens::spatial::Plane::xy);
    buckens::fem::BeamSpec beam;
    beam.to = {length, 0, 0};
    beam.elements = 8;
    beam.section.value.shape = buckens::fem::CircleSpec{diameter};
    beam.material.value.E = E;
    beam.material.value.nu = 0.3;
    beam.material.value.rho = rho;
    model.add_body("beam", beam);
    model.add_joint("clamp", buckens::joints::FixedSpec(), "ground", "beam/start");
    model.add_force("weight", "beam/end", {0, -load, 0});
    model.add_sensor("tip", buckens::model::PositionSensor()).of = ModelBuilder::marker("beam/end");
    model.description().initial.start = buckens::model::StartKind::static_equilibrium;
    model.simulation(/*duration*/ 1, /*step*/ 1e-4);

    const auto built = model.build();
    buckens::Simulation simulation(*built);
    const double I = M_PI * std::pow(diameter, 4) / 64, A = M_PI * diameter * diameter / 4;
    const double sag = -simulation.sensor("tip")[1];

    simulation.set_load("weight", {0, 0, 0});
    int crossings = 0;
    double first = 0, last = 0, before = -sag;
    while (crossings < 21 && simulation.step()) {
      const double now = simulation.sensor("tip")[1];
      if (now * before < 0 && crossings++ == 0) first = simulation.time();
      if (now * before < 0) last = simulation.time();
      before = now;
    }
    const double frequency = (crossings - 1) / (2 * (last - first));
    const double exact =
        1.8751041 * 1.8751041 / (2 * M_PI) * std::sqrt(E * I / (rho * A)) / (length * length);
    std::printf("diameter %.3f sag %.6e exact %.6e m frequency %.3f exact %.3f Hz\n", diameter, sag,
                load * std::pow(length, 3) / (3 * E * I), frequency, exact);
  }
}

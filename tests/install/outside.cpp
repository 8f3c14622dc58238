// SPDX-License-Identifier: Apache-2.0
// Uses the installed package the way a stranger's program would: headers, own code, and through it
// every library the package has to find again (CHOLMOD, OpenBLAS, muParser, yaml-cpp, HDF5).
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <buckens/buckens.h>

#if __has_include(<buckens/analysis/simulation/run.h>) || __has_include(<buckens/stepping/stepper.h>)
#error "headers are installed that are not public"
#endif

namespace {

constexpr const char* kModel = R"(buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies: {rod: {beam: {to: [1, 0, 0], elements: 4, section: {circle: {diameter: 10 mm}}, material: steel}}}
joints: {hinge: {revolute: {between: [ground, rod/start]}}}
loads: {push: {force: {on: rod/end, value: [0, "2*cos(3*t) N", 0]}}}
simulation: {duration: 10 ms, step: 1 ms}
output: {sensors: {tip: {position: rod/end}}}
)";

bool missing_run_is_refused() {
  try {
    const buckens::RunReader reader("no-such-run");
  } catch (const buckens::IoError&) {
    return true;
  }
  return false;
}

/// A run from a model file, into a run directory; half of it once more from a saved state.
bool runs_agree() {
  std::ofstream("model.yaml") << kModel;
  const std::shared_ptr<const buckens::BuiltModel> model = buckens::load_model("model.yaml");
  buckens::Simulation whole(model), rest(model);
  buckens::RunDirectory directory("out", {model->description.title, kModel, {}});
  whole.record_into(directory);
  whole.advance_to(5e-3);
  buckens::write_state(whole.save(), "half.h5");
  rest.restore(buckens::read_state("half.h5"));
  return whole.run().finished && rest.run().finished && whole.sensor("tip") == rest.sensor("tip") &&
         buckens::RunReader("out").times().size() == 11;
}

/// The fields of a spec with their keys and members.
bool fields_are_there() {
  buckens::loads::ForceSpec force;
  for (const buckens::Field& field : buckens::member_of(force).fields()) {
    if (field.note.name == "on") return field.member.get<buckens::base::MarkerRef>() == &force.on;
  }
  return false;
}

}  // namespace

int main() {
  if (!fields_are_there() || !missing_run_is_refused() || !runs_agree() ||
      std::strlen(buckens::kVersion) == 0) {
    std::puts("the installed library answers wrongly");
    return 1;
  }
  std::printf("outside project runs with buckens %s\n", buckens::kVersion);
  return 0;
}

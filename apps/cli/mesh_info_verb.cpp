// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/mesh_arguments.h"
#include "cli/mesh_report_text.h"
#include "cli/output.h"
#include "cli/verbs.h"

namespace buckens::cli {

namespace {

ExitCode tell_of_mesh(const MeshArguments& arguments, bool json) {
  const double length = fem::size_of(arguments.unit_of_length());
  const double mass = fem::size_of(arguments.unit_of_mass());
  const fem::ImportedMesh mesh = fem::in_si(arguments.read(), length, mass);
  const bool units_given = !arguments.length_unit.empty() || arguments.is_step();
  const fem::MeshReport report = fem::report_mesh(mesh, units_given);
  print(json ? to_text(mesh_report_json(mesh, report)) : mesh_report_text(mesh, report));
  return ExitCode::ok;
}

constexpr char kMeshInfoFooter[] = R"(
Examples:
  buckens mesh-info housing.inp --length-unit mm
  buckens mesh-info rod.step --size "5 mm"

Reads a mesh and reports its content: nodes and elements, sets and their names, size, volume, mass,
mass centre and inertia, the worst element, inverted elements, coincident nodes, disconnected pieces,
what was left out, and units that are probably wrong. Everything is shown in SI units. Writes no
files.

Exit codes: 0 done, 2 bad input, 5 files. Details: docs/tutorials/meshes.md)";

}  // namespace

void add_mesh_info_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("mesh-info", "Describe a mesh or STEP file");
  const auto arguments = std::make_shared<MeshArguments>();
  verb.add_option("FILE", arguments->file, "Mesh of another program, or STEP file")->required();
  add_mesh_options(verb, *arguments);
  add_json_option(verb, invocation);
  verb.footer(kMeshInfoFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] {
      return tell_of_mesh(*arguments, invocation.json);
    };
  });
}

}  // namespace buckens::cli

// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/mesh_arguments.h"
#include "cli/mesh_report_text.h"
#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/mesh_conversion.h"
#include "buckens/mesh_io/mesh_model.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  MeshArguments mesh;
  std::string out;
  std::string version = "4.1";
  bool binary = false;
};

mesh_io::GmshFormat gmsh_format(const ConvertArguments& arguments) {
  if (arguments.version == "4.1") {
    return arguments.binary ? mesh_io::GmshFormat::binary_4_1 : mesh_io::GmshFormat::ascii_4_1;
  }
  if (arguments.version == "2.2") {
    return arguments.binary ? mesh_io::GmshFormat::binary_2_2 : mesh_io::GmshFormat::ascii_2_2;
  }
  throw InputError({}, fmt::format("--msh-version cannot be \"{}\"; 4.1 and 2.2 can be written",
                                   arguments.version));
}

ExitCode convert(const ConvertArguments& arguments, bool json) {
  const fs::path out = arguments.out;
  const std::string ending = out.extension().string();
  if (ending != ".msh" && ending != ".vtu") {
    throw InputError(
        {}, fmt::format("meshes can be written as .msh and .vtu, not as \"{}\"", out.string()));
  }
  const fem::LengthUnit length = arguments.mesh.unit_of_length();
  const fem::MassUnit mass = arguments.mesh.unit_of_mass();
  const mesh_io::GmshFormat format = gmsh_format(arguments);
  const fem::ImportedMesh mesh = arguments.mesh.read();
  std::vector<std::string> notes;
  const auto tell = [&notes](const std::vector<fem::ImportNote>& all) {
    for (const fem::ImportNote& note : all) notes.push_back(note_text(note));
  };
  tell(mesh.notes);
  std::string side_car;
  if (ending == ".vtu") {
    tell(mesh_io::losses_in_vtu(mesh));
    mesh_io::write_vtu(out, mesh_io::vtu_grid(mesh));
  } else {
    tell(mesh_io::losses_in_gmsh(mesh));
    files::replace_text_file(out, mesh_io::gmsh_bytes(mesh, format));
    side_car = out.string() + ".yaml";
    const mesh_io::MeshModel model =
        mesh_io::model_of_mesh(mesh, out.filename().string(), length, mass);
    tell(model.notes);
    files::replace_text_file(side_car, model.text);
  }
  if (json) {
    const nlohmann::ordered_json told = {
        {"mesh", out.string()},
        {"model",
         side_car.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(side_car)},
        {"nodes", mesh.num_nodes()},
        {"elements", mesh.num_elements()},
        {"notes", notes}};
    print(to_text(told));
    return ExitCode::ok;
  }
  std::string text = fmt::format("{}: {} nodes, {} elements\n", out.string(), mesh.num_nodes(),
                                 mesh.num_elements());
  if (!side_car.empty()) {
    text += fmt::format("{}: units, materials, sections, masses and links\n", side_car);
  }
  for (const std::string& note : notes) text += "note: " + note + '\n';
  print(text);
  return ExitCode::ok;
}

constexpr char kConvertFooter[] = R"(
Examples:
  buckens convert housing.inp housing.msh --length-unit mm
  buckens convert rod.step rod.vtu --size "5 mm"

Writes a mesh in its own units, for Gmsh (.msh, text; --binary, --msh-version 2.2) or for VTK and
ParaView (.vtu). Node numbers, element numbers and all sets are kept. The model file OUT.msh.yaml is
written next to OUT.msh with what .msh cannot hold: units, materials, sections, point masses, links
and springs. Run `buckens modes` on it, or copy parts of it. Whatever neither file can hold is
reported.

Exit codes: 0 done, 2 bad input, 5 files. Details: docs/tutorials/meshes.md)";

}  // namespace

void add_convert_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("convert", "Write a mesh as .msh or .vtu");
  const auto arguments = std::make_shared<ConvertArguments>();
  verb.add_option("IN", arguments->mesh.file, "Mesh from another program, or STEP file")
      ->required();
  verb.add_option("OUT", arguments->out, "File to write, ending in .msh or .vtu")->required();
  add_mesh_options(verb, arguments->mesh);
  verb.add_option("--msh-version", arguments->version, "Version of the .msh format: 4.1 or 2.2");
  verb.add_flag("--binary", arguments->binary, "Write .msh in binary form");
  add_json_option(verb, invocation);
  verb.footer(kConvertFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return convert(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli

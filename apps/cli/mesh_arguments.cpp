// SPDX-License-Identifier: Apache-2.0
#include "cli/mesh_arguments.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/base/units.h"
#include "buckens/mesh_io/mesh_file.h"
#include "buckens/mesh_io/step/mesh.h"

namespace buckens::cli {

namespace {

template <class Enum>
Enum choice(const char* option, const std::string& word) {
  const auto names = choice_names(Enum{});
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) {
    throw InputError({}, fmt::format("{} cannot be \"{}\".{}", option, word,
                                     base::suggestion(word, {names.begin(), names.end()})));
  }
  return static_cast<Enum>(found - names.begin());
}

double length(const char* option, const std::string& text) {
  const base::QuantityText parts = base::split_quantity(text);
  const auto number = base::parse_number(parts.formula);
  const auto unit = base::parse_unit(parts.unit.empty() ? "m" : parts.unit);
  if (!number || !unit || !(unit->dimension == base::kLength) || !(*number > 0)) {
    throw InputError(
        {}, fmt::format("{} cannot be \"{}\"; write a length such as \"5 mm\"", option, text));
  }
  return *number * unit->factor;
}

}  // namespace

bool MeshArguments::is_step() const {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".step" || ending == ".stp" || ending == ".p21";
}

fem::LengthUnit MeshArguments::unit_of_length() const {
  return length_unit.empty() ? fem::LengthUnit::m
                             : choice<fem::LengthUnit>("--length-unit", length_unit);
}

fem::MassUnit MeshArguments::unit_of_mass() const {
  if (!mass_unit.empty()) return choice<fem::MassUnit>("--mass-unit", mass_unit);
  return unit_of_length() == fem::LengthUnit::mm ? fem::MassUnit::t : fem::MassUnit::kg;
}

fem::ImportedMesh MeshArguments::read() const {
  if (!is_step()) return mesh_io::read_mesh_file(file, {{}, skip, only});
  if (!length_unit.empty()) {
    throw InputError({file, 0, 0}, "a STEP file states its units; leave out --length-unit");
  }
  mesh_io::StepRequest request{{}, order, solid};
  if (!size.empty()) request.size = length("--size", size);
  return mesh_io::mesh_step(file, request);
}

void add_mesh_options(CLI::App& verb, MeshArguments& arguments) {
  verb.add_option("--length-unit", arguments.length_unit,
                  "Unit of the lengths in the file: m, dm, cm, mm, um, in or ft; m by default");
  verb.add_option("--mass-unit", arguments.mass_unit,
                  "Unit of mass of the constants in the file: kg, t, g, lb or slinch; by default\n"
                  "t with millimetres, otherwise kg");
  verb.add_option("--only", arguments.only,
                  "Mesh files: use only these element sets, groups or properties")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--skip", arguments.skip,
                  "Decks: keywords, cards and element types to leave out although they have\n"
                  "mass or stiffness, such as --skip CELAS2,CONM1")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--size", arguments.size,
                  "STEP files: edge length of the elements; by default a twentieth of the part's\n"
                  "diagonal, less where walls are thin")
      ->type_name("LENGTH");
  verb.add_option("--solid", arguments.solid,
                  "STEP files: use only this solid, given by name or number");
  verb.add_option("--order", arguments.order, "STEP files: order of the elements, 1 or 2")
      ->check(CLI::Range(1, 2));
}

}  // namespace buckens::cli

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/deck.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/nastran/bulk.h"
#include "buckens/mesh_io/nastran/card_reader.h"
#include "buckens/mesh_io/nastran/connections.h"
#include "buckens/mesh_io/nastran/control.h"
#include "buckens/mesh_io/nastran/coordinates.h"
#include "buckens/mesh_io/nastran/elements.h"
#include "buckens/mesh_io/nastran/points.h"
#include "buckens/mesh_io/nastran/properties.h"
#include "buckens/mesh_io/nastran/sets.h"

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kLargestDeck = std::size_t{2} << 30;

void note_sections(const NastranControl& control, bool found_end, const NastranFile& file,
                   NastranNotes& notes) {
  if (control.num_lines > 0) {
    notes.add(fmt::format("executive and case control, {} lines: left out except for SET, MPC, NSM "
                          "and PARAM,WTMASS",
                          control.num_lines),
              {&file, 1}, true);
  }
  if (control.present && !found_end) {
    notes.add("ENDDATA is missing; is the deck complete?", {&file, 0});
  }
  for (const NastranMatrixChoice& choice : control.matrices) {
    notes.add(fmt::format("{} = {}: matrices of the deck (DMIG) are left out, and their mass or "
                          "stiffness with them",
                          choice.keyword, choice.name),
              {choice.file, choice.line}, false, true);
  }
}

}  // namespace

fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load, SkipList& skip) {
  NastranSource source(name, std::move(text), load);
  NastranNotes notes(source.main_file());
  std::optional<NastranLine> first;
  const NastranControl control = read_nastran_control(source, first);
  NastranCardReader reader(source, first);
  NastranBulk bulk = read_nastran_bulk(reader, skip, notes);
  if (control.weight_to_mass) bulk.weight_to_mass = *control.weight_to_mass;
  note_sections(control, reader.found_end(), source.main_file(), notes);
  if (bulk.grids.empty()) {
    throw InputError({source.main_file().name, 0, 0}, "the deck has no nodes (GRID)");
  }

  fem::ImportedMesh mesh;
  mesh.file = source.main_file().name;
  mesh.format = "Nastran";
  NastranCoordinates coordinates(bulk, notes);
  std::vector<NastranGrid>().swap(bulk.grids);
  NastranMaterials materials(bulk, source.names(), notes);
  NastranProperties properties(bulk, source.names(), coordinates, materials, notes);
  NastranNonstructuralMass nonstructural(bulk, control.present, control.nsm_set, notes);
  const std::vector<std::int64_t> element_ids =
      add_nastran_elements(bulk, coordinates, properties, nonstructural, notes, mesh);
  mesh.properties = properties.take();
  mesh.materials = materials.take();
  add_nastran_points(bulk, coordinates, notes, mesh);
  add_nastran_connections(bulk, control.present, control.mpc_set, coordinates, notes, mesh);
  add_nastran_sets(bulk, control, source.names(), coordinates, element_ids, notes, mesh);
  mesh.node_ids = coordinates.node_ids();
  mesh.positions = coordinates.positions();
  mesh.notes = notes.take();
  return mesh;
}

fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load) {
  SkipList skip;
  return read_nastran_text(std::move(text), name, load, skip);
}

fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path, SkipList& skip) {
  fem::ImportedMesh mesh = read_nastran_text(
      files::read_text_file(path, "Nastran deck", kLargestDeck), path, load_nastran_file, skip);
  if (mesh.num_elements() == 0 && mesh.masses.empty()) {
    throw InputError({mesh.file, 0, 0},
                     "the deck has nodes, but no elements and no masses; is it complete?");
  }
  return mesh;
}

fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path) {
  SkipList skip;
  return read_nastran_deck(path, skip);
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/structure_from_spec.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/log.h"
#include "buckens/base/stopwatch.h"
#include "buckens/base/timed_phase.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/element/node_number.h"
#include "buckens/fem/mesh/curved_beam.h"
#include "buckens/fem/mesh/generate_mesh.h"
#include "buckens/fem/mesh/plate_mesh.h"
#include "buckens/model/build/imported_structure.h"
#include "buckens/model/build/interface_regions.h"
#include "buckens/model/build/links_from_spec.h"
#include "buckens/model/build/shell_from_spec.h"
#include "buckens/model/build/spec_properties.h"

namespace buckens::model {

namespace {

// Variables from which on it is worth a line in the log how long their assembly took.
constexpr Eigen::Index kManyVariables = 20000;

class StructureBuilder {
 public:
  explicit StructureBuilder(const body::BodySpec& spec) : spec_(spec) {}

  NamedStructure run() {
    if (const auto* beam = std::get_if<fem::BeamSpec>(&spec_.kind)) {
      add_single_beam(*beam);
    } else if (const auto* mesh = std::get_if<fem::MeshSpec>(&spec_.kind)) {
      if (mesh->is_file()) {
        add_imported(*mesh, mesh->where);
      } else {
        add_generated(*mesh);
      }
    } else if (const auto* part = std::get_if<fem::GeometrySpec>(&spec_.kind)) {
      add_imported(*part, part->where);
    } else if (const auto* matrices = std::get_if<fem::MatricesSpec>(&spec_.kind)) {
      add_matrices(*matrices);
    } else {
      add_structure(std::get<fem::StructureSpec>(spec_.kind));
    }
    return std::move(out_);
  }

 private:
  fem::BeamProperties make_properties(const fem::BeamPropertySpec& spec) const {
    fem::BeamProperties properties;
    properties.material = make_material(*spec.material, spec_.damping);
    properties.section = make_section(*spec.section);
    properties.theory = spec.theory;
    properties.rotary_inertia = spec.has_rotary_inertia();
    properties.up = spec.up;
    if (spec.end_section) properties.taper = make_taper(*spec.section, **spec.end_section);
    return properties;
  }
  void add_beam(const fem::BeamPropertySpec& spec, int first, int last,
                const SourceLocation& where);

  void name_place(const std::string& name, MeshPlace place) {
    out_.names.push_back(name);
    out_.places.push_back(place);
  }

  void add_single_beam(const fem::BeamSpec& beam);
  void add_generated(const fem::MeshSpec& mesh);
  void add_imported(const fem::GroupMaterials& source, const SourceLocation& where);
  void add_matrices(const fem::MatricesSpec& matrices);
  void add_structure(const fem::StructureSpec& structure);
  void add_solid(const fem::SolidMemberSpec& solid);
  void add_shell(const fem::ShellMemberSpec& shell);
  int node_called(const std::string& name, const SourceLocation& where) const;
  void add_mass(const fem::PointMassSpec& mass);
  void add_given_links(const fem::StructureLinksSpec& links);

  const body::BodySpec& spec_;
  NamedStructure out_;
};

void StructureBuilder::add_beam(const fem::BeamPropertySpec& spec, int first, int last,
                                const SourceLocation& where) {
  const fem::BeamProperties properties = make_properties(spec);
  try {
    out_.beams.push_back(fem::add_curved_beam(out_.structure, first, last, spec.path, spec.through,
                                              spec.elements, properties));
  } catch (const ModelError& error) {
    throw InputError(where, fmt::format("body \"{}\": {}", spec_.name, error.what()));
  }
}

void StructureBuilder::add_single_beam(const fem::BeamSpec& beam) {
  fem::Structure& structure = out_.structure;
  const int start = fem::add_node(structure, "start", beam.from);
  const int end = fem::add_node(structure, "end", beam.to);
  add_beam(beam, start, end, beam.where);
  const fem::BeamDivision& division = out_.beams.back();
  const int half = beam.elements / 2;
  name_place("start", {start, -1, 0});
  name_place("end", {end, -1, 0});
  if (beam.elements % 2 == 0) {
    name_place("mid", {division.nodes[static_cast<std::size_t>(half)], -1, 0});
  } else {
    name_place("mid", {-1, division.first_element + half, 0.5});
  }
  for (const fem::PointMassSpec& mass : beam.masses) add_mass(mass);
}

void StructureBuilder::add_structure(const fem::StructureSpec& spec) {
  fem::Structure& structure = out_.structure;
  for (const fem::NodeSpec& node : spec.nodes) {
    name_place(node.name, {fem::add_node(structure, node.name, node.position), -1, 0});
  }
  for (const fem::BeamMemberSpec& beam : spec.beams) {
    add_beam(beam, node_called(beam.between[0], beam.where),
             node_called(beam.between[1], beam.where), beam.where);
  }
  for (const fem::BarMemberSpec& bar : spec.bars) {
    const fem::Section section =
        bar.section ? make_section(**bar.section) : fem::Section::area(bar.area.value_or(0.0));
    fem::add_bar(structure, node_called(bar.between[0], bar.where),
                 node_called(bar.between[1], bar.where), bar.elements,
                 make_material(*bar.material, spec_.damping), section);
  }
  for (const fem::SolidMemberSpec& solid : spec.solids) add_solid(solid);
  for (const fem::ShellMemberSpec& shell : spec.shells) add_shell(shell);
  for (const fem::PointMassSpec& mass : spec.masses) add_mass(mass);
  if (spec.links) add_given_links(*spec.links);
}

void StructureBuilder::add_given_links(const fem::StructureLinksSpec& links) {
  add_links(
      links,
      [this](const std::string& name, const SourceLocation& where) {
        return node_called(name, where);
      },
      out_.structure);
}

/// A mass beside its node gets a node of its own, linked rigidly.
void StructureBuilder::add_mass(const fem::PointMassSpec& mass) {
  fem::Structure& structure = out_.structure;
  int node = node_called(mass.at, mass.where);
  if (!mass.offset.isZero(0.0)) {
    const Eigen::Vector3d at = structure.nodes[static_cast<std::size_t>(node)].position;
    const int own = fem::add_node(structure, "", at + mass.offset);
    structure.links.rigid.push_back(
        {fmt::format("the offset of the point mass at \"{}\"", mass.at), node, {own}});
    node = own;
  }
  structure.masses.add(node, mass.mass, mass.inertia_matrix());
}

void StructureBuilder::add_shell(const fem::ShellMemberSpec& shell) {
  std::vector<int> nodes;
  for (const std::string& name : shell.nodes) nodes.push_back(node_called(name, shell.where));
  fem::ShellBlock& block = out_.structure.shells;
  block.add(nodes, block.add_section(make_shell_section(shell, *shell.material, spec_.damping)));
}

void StructureBuilder::add_solid(const fem::SolidMemberSpec& solid) {
  std::vector<int> nodes;
  for (const std::string& name : solid.nodes) nodes.push_back(node_called(name, solid.where));
  fem::SolidBlock& block = out_.structure.solids;
  block.add(solid.form(), nodes, block.add_material(make_material(*solid.material, spec_.damping)));
}

void StructureBuilder::add_generated(const fem::MeshSpec& spec) {
  const auto* plate = std::get_if<fem::PlateMeshSpec>(&spec.shape);
  const fem::GeneratedMesh mesh =
      plate != nullptr
          ? fem::add_plate(out_.structure, *plate,
                           make_shell_section(*plate, **spec.material, spec_.damping))
          : fem::add_mesh(out_.structure, spec, make_material(**spec.material, spec_.damping));
  for (const auto& [name, node] : mesh.names) name_place(name, {node, -1, 0});
  for (const fem::PointMassSpec& mass : spec.masses) add_mass(mass);
}

void StructureBuilder::add_imported(const fem::GroupMaterials& source,
                                    const SourceLocation& where) {
  if (!source.imported) throw InputError(where, "the file of the mesh has not been read");
  ImportedStructure imported = imported_structure(*source.imported, source, spec_.damping, where);
  out_.structure = std::move(imported.structure);
  out_.numbers = std::move(imported.numbers);
  out_.notes = std::move(imported.notes);
  if (spec_.geometric_stiffness &&
      out_.structure.beams.num_elements() + out_.structure.bars.num_elements() == 0) {
    throw InputError(where, fmt::format("{}: `geometric-stiffness` belongs to beams and bars, and "
                                        "this mesh has none; remove the key, or give the body more "
                                        "`frames`",
                                        source.imported->file));
  }
  for (const fem::PointMassSpec& mass : source.masses) add_mass(mass);
  if (source.links) add_given_links(*source.links);
}

void StructureBuilder::add_matrices(const fem::MatricesSpec& matrices) {
  if (!matrices.imported) throw InputError(matrices.where, "the matrices have not been read");
  out_.matrices = matrices.imported;
  out_.structure.nodes = matrices.imported->nodes;
  for (std::size_t k = 0; k < matrices.imported->numbers.size(); ++k) {
    out_.numbers.emplace(matrices.imported->numbers[k], static_cast<int>(k));
  }
  if (!spec_.damping) return;
  out_.rayleigh = {spec_.damping->alpha(), spec_.damping->beta(),
                   spec_.damping->is_of_held_motion()};
}

int StructureBuilder::node_called(const std::string& name, const SourceLocation& where) const {
  const auto place = out_.find(name);
  if (!place && !out_.numbers.empty()) {
    throw InputError(where,
                     fmt::format("body \"{}\" has no node \"{}\"; nodes of a file are written "
                                 "`n` and the number, such as \"n{}\"",
                                 spec_.name, name, out_.numbers.begin()->first));
  }
  if (!place) {
    throw InputError(where, fmt::format("body \"{}\" has no node \"{}\"; nodes there: {}",
                                        spec_.name, name, fmt::join(out_.names, ", ")));
  }
  if (place->node < 0) {
    throw InputError(where, fmt::format("body \"{}\": \"{}\" lies inside an element; use an even "
                                        "number of elements so that a node is there",
                                        spec_.name, name));
  }
  return place->node;
}

}  // namespace

std::optional<MeshPlace> NamedStructure::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    const auto number = fem::node_number(name);
    const auto node = number ? numbers.find(*number) : numbers.end();
    if (node == numbers.end()) return std::nullopt;
    return MeshPlace{node->second, -1, 0};
  }
  return places[static_cast<std::size_t>(found - names.begin())];
}

const InterfaceRegion* NamedStructure::find_interface(const std::string& name) const {
  return base::find_named(interfaces, name);
}

fem::FeModel assemble(const NamedStructure& mesh, std::optional<spatial::Plane> planar) {
  const base::TimedPhase phase("assembly");
  const base::Stopwatch watch;
  // Matrices keep all variables in a plane model, as solids do.
  fem::FeModel out = mesh.matrices ? fem::assemble(*mesh.matrices, mesh.rayleigh)
                                   : fem::assemble(mesh.structure, planar);
  if (out.M.rows() >= kManyVariables) {
    base::log(base::LogLevel::debug,
              fmt::format("assembling {} variables: {:.2f} s", out.M.rows(), watch.seconds()));
  }
  return out;
}

NamedStructure structure_from_spec(const body::BodySpec& spec) {
  NamedStructure out = StructureBuilder(spec).run();
  out.interfaces = find_interfaces(spec, out);
  return out;
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_structure.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/imported_links.h"
#include "buckens/model/build/imported_materials.h"
#include "buckens/model/build/imported_sections.h"
#include "buckens/model/build/shell_from_spec.h"
#include "buckens/model/build/spec_properties.h"

namespace buckens::model {

namespace {

using fem::CellKind;

std::optional<fem::SolidKind> solid_kind(CellKind kind) {
  switch (kind) {
    case CellKind::hex8:
      return fem::SolidKind::hex8;
    case CellKind::hex20:
      return fem::SolidKind::hex20;
    case CellKind::tet4:
      return fem::SolidKind::tet4;
    case CellKind::tet10:
      return fem::SolidKind::tet10;
    case CellKind::wedge6:
      return fem::SolidKind::wedge6;
    case CellKind::wedge15:
      return fem::SolidKind::wedge15;
    case CellKind::pyramid5:
      return fem::SolidKind::pyramid5;
    default:
      return std::nullopt;
  }
}

/// Where an element of the file went.
struct Place {
  enum class Block { none, beams, bars, solids, shells };
  Block block = Block::none;
  int index = -1;
};

class Import {
 public:
  Import(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given,
         const std::optional<fem::DampingSpec>& damping, const SourceLocation& where)
      : mesh_(mesh),
        given_(given),
        damping_(damping),
        materials_(mesh, given, damping, where),
        sections_(mesh, given),
        where_(where) {}

  ImportedStructure run() {
    number_nodes();
    for (const fem::ImportedBlock& block : mesh_.blocks) add_block(block);
    out_.notes = add_imported_links(mesh_, new_numbers_, where_, out_.structure);
    add_sets();
    return std::move(out_);
  }

 private:
  void number_nodes();
  void add_block(const fem::ImportedBlock& block);
  void add_solid(const fem::ImportedBlock& block, const std::vector<int>& nodes, int element,
                 std::int64_t id);
  void add_line(const fem::ImportedBlock& block, int in_block, const std::vector<int>& nodes,
                int element);
  void add_shell(const fem::ImportedBlock& block, const std::vector<int>& nodes, int element,
                 std::int64_t id);
  fem::ShellSection shell_section(const fem::ImportedBlock& block, int element);
  fem::ShellSection given_shell_section(const fem::GroupSectionSpec& section,
                                        const fem::ImportedBlock& block, int element) const;
  [[noreturn]] void refuse_without_section(const fem::ImportedBlock& block, const char* what,
                                           const char* example) const;
  void add_sets();
  fem::ShellSide shell_side(const fem::ImportedFace& face) const;
  fem::ElementFace solid_face(const fem::ImportedFace& face, const std::string& set) const;
  int node(int imported) const { return new_numbers_[static_cast<std::size_t>(imported)]; }
  const fem::ImportedProperty* property(const fem::ImportedBlock& block) const {
    return block.property < 0 ? nullptr
                              : &mesh_.properties[static_cast<std::size_t>(block.property)];
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(where_, fmt::format("{}: {}", mesh_.file, what));
  }

  const fem::ImportedMesh& mesh_;
  const fem::GroupMaterials& given_;
  const std::optional<fem::DampingSpec>& damping_;
  ImportedMaterials materials_;
  ImportedSections sections_;
  SourceLocation where_;
  ImportedStructure out_;
  std::vector<int> new_numbers_;        // per node of the file, −1 where nothing uses it
  std::vector<Place> places_;           // per element of the file
  std::map<int, int> solid_materials_;  // number in the block by that of ImportedMaterials
  // By section of the model file, property and material.
  std::map<std::tuple<const fem::GroupSectionSpec*, int, const fem::MaterialSpec*>, int>
      shell_sections_;
};

void Import::number_nodes() {
  const auto count = static_cast<std::size_t>(mesh_.num_nodes());
  std::vector<bool> used(count, false);
  const auto use = [&used](int k) { used[static_cast<std::size_t>(k)] = true; };
  for (const fem::ImportedBlock& block : mesh_.blocks) {
    std::for_each(block.nodes.begin(), block.nodes.end(), use);
  }
  mark_linked_nodes(mesh_, used);
  mark_given_nodes(mesh_, given_, used);
  new_numbers_.assign(count, -1);
  for (std::size_t k = 0; k < count; ++k) {
    if (!used[k]) continue;
    new_numbers_[k] = static_cast<int>(out_.structure.nodes.size());
    out_.numbers.emplace(mesh_.node_ids[k], new_numbers_[k]);
    out_.structure.nodes.push_back({fmt::format("n{}", mesh_.node_ids[k]), mesh_.positions[k]});
  }
}

void Import::add_block(const fem::ImportedBlock& block) {
  const int per_element = fem::num_nodes(block.kind);
  for (int k = 0; k < block.num_elements(); ++k) {
    const int element = static_cast<int>(places_.size());
    std::vector<int> nodes;
    for (int i = 0; i < per_element; ++i) {
      nodes.push_back(node(block.nodes[static_cast<std::size_t>(k * per_element + i)]));
    }
    places_.emplace_back();
    if (fem::dimension_of(block.kind) == 3) {
      add_solid(block, nodes, element, block.ids[static_cast<std::size_t>(k)]);
    } else if (block.kind == CellKind::line2) {
      add_line(block, k, nodes, element);
    } else if (fem::dimension_of(block.kind) == 2) {
      add_shell(block, nodes, element, block.ids[static_cast<std::size_t>(k)]);
    } else {
      refuse(fmt::format("elements {} ({}) cannot be used in a body", block.source,
                         fem::name_of(block.kind)));
    }
  }
}

void Import::add_solid(const fem::ImportedBlock& block, const std::vector<int>& nodes, int element,
                       std::int64_t id) {
  const auto kind = solid_kind(block.kind);
  if (!kind) {
    refuse(fmt::format("elements {} ({}) cannot be used in a body", block.source,
                       fem::name_of(block.kind)));
  }
  fem::SolidBlock& solids = out_.structure.solids;
  const int number = materials_.number(block, element);
  const auto [known, is_new] = solid_materials_.emplace(number, 0);
  if (is_new) known->second = solids.add_material(materials_.material(number));
  fem::SolidForm form = fem::SolidForm::usual(*kind);
  if (*kind == fem::SolidKind::hex8)
    form.integration = given_.integration.value_or(form.integration);
  places_.back() = {Place::Block::solids, solids.add(form, nodes, known->second)};
  solids.set_number(places_.back().index, id);
}

void Import::refuse_without_section(const fem::ImportedBlock& block, const char* what,
                                    const char* example) const {
  const fem::ImportedProperty* of = property(block);
  const bool has_name = of != nullptr && !of->name.empty();
  const std::string why = of == nullptr || of->lacking.empty() ? "" : " (" + of->lacking + ")";
  refuse(fmt::format(
      "the {} elements {} have no {}{}; write it in the model file beside the name of "
      "the mesh file, for example {}",
      block.source, has_name ? fmt::format("of \"{}\"", of->name) : "without a property", what, why,
      has_name ? fmt::format("sections: {{\"{}\": {}}}", of->name, example)
               : fmt::format("section: {}", example)));
}

void Import::add_line(const fem::ImportedBlock& block, int in_block, const std::vector<int>& nodes,
                      int element) {
  const fem::ImportedProperty* of = property(block);
  const fem::GroupSectionSpec* given = sections_.of(element);
  if (given == nullptr && (of == nullptr || !of->section)) {
    refuse_without_section(block, "cross-section", "{beam: {circle: {diameter: 6 mm}}}");
  }
  const fem::Material material = given != nullptr && given->material
                                     ? make_material(**given->material, damping_)
                                     : materials_.material(materials_.number(block, element));
  const bool is_bar =
      given != nullptr ? given->bar.has_value() : of->kind == fem::PropertyKind::bar;
  const fem::Section section =
      make_section(given == nullptr ? *of->section : (is_bar ? **given->bar : **given->beam));
  if (is_bar) {
    places_.back() = {Place::Block::bars,
                      out_.structure.bars.add(nodes[0], nodes[1], material, section)};
    return;
  }
  fem::BeamProperties beam;
  beam.material = material;
  beam.section = section;
  if (given != nullptr) {
    beam.theory = given->theory.value_or(fem::BeamTheory::euler_bernoulli);
  } else if (of->shear_flexible.value_or(false)) {
    beam.theory = fem::BeamTheory::timoshenko;
  }
  beam.rotary_inertia = beam.theory == fem::BeamTheory::timoshenko;
  if (given != nullptr) beam.rotary_inertia = given->rotary_inertia.value_or(beam.rotary_inertia);
  if (!block.up.empty()) beam.up = block.up[static_cast<std::size_t>(in_block)];
  if (given != nullptr && given->up) beam.up = given->up;
  fem::BeamBlock& beams = out_.structure.beams;
  places_.back() = {Place::Block::beams, beams.add(nodes[0], nodes[1], beams.add_properties(beam))};
}

fem::ShellSection Import::given_shell_section(const fem::GroupSectionSpec& section,
                                              const fem::ImportedBlock& block, int element) const {
  const bool every_layer_has_its_own =
      !section.layers.empty() &&
      std::all_of(section.layers.begin(), section.layers.end(),
                  [](const fem::ShellLayerSpec& layer) { return layer.material.has_value(); });
  const fem::MaterialSpec& material = section.material          ? **section.material
                                      : every_layer_has_its_own ? **section.layers.front().material
                                                                : materials_.spec(block, element);
  fem::ShellSection out = make_shell_section(section, material, damping_);
  out.along_first_side = section.along_first_side;
  return out;
}

fem::ShellSection Import::shell_section(const fem::ImportedBlock& block, int element) {
  if (const fem::GroupSectionSpec* given = sections_.of(element)) {
    return given_shell_section(*given, block, element);
  }
  const fem::ImportedProperty* of = property(block);
  if (of == nullptr || of->kind != fem::PropertyKind::shell ||
      (!of->thickness && of->layers.empty())) {
    refuse_without_section(block, "thickness", "{thickness: 2 mm}");
  }
  fem::ShellSection out;
  out.offset = of->offset;
  if (of->axes) out.direction = of->axes->col(0);
  out.along_first_side = of->along_first_side;
  if (of->layers.empty()) {
    out.layers.push_back(
        {materials_.material(materials_.number(block, element)), *of->thickness, 0.0});
  }
  for (const fem::ImportedLayer& layer : of->layers) {
    const int number = layer.material.empty() ? materials_.number(block, element)
                                              : materials_.number(layer.material);
    out.layers.push_back({materials_.material(number), layer.thickness, layer.angle});
  }
  return out;
}

void Import::add_shell(const fem::ImportedBlock& block, const std::vector<int>& nodes, int element,
                       std::int64_t id) {
  const fem::GroupSectionSpec* given = sections_.of(element);
  const fem::MaterialSpec* material = materials_.find(block, element);
  fem::ShellBlock& shells = out_.structure.shells;
  const auto [known, is_new] = shell_sections_.try_emplace({given, block.property, material}, -1);
  if (is_new) known->second = shells.add_section(shell_section(block, element));
  places_.back() = {Place::Block::shells, shells.add(nodes, known->second)};
  shells.set_number(places_.back().index, id);
}

/// The side from which the corners run counter-clockwise.
fem::ShellSide Import::shell_side(const fem::ImportedFace& face) const {
  const int element = places_.at(static_cast<std::size_t>(face.element)).index;
  const auto all = out_.structure.shells.nodes(element);
  const auto num_corners = fem::num_shell_corners(static_cast<Eigen::Index>(all.size()));
  const auto own = all.first(static_cast<std::size_t>(num_corners));
  const auto first = std::find(own.begin(), own.end(), node(face.corners.at(0)));
  const auto next = first == own.end() || first + 1 == own.end() ? own.begin() : first + 1;
  return {element, *next != node(face.corners.at(1))};
}

fem::ElementFace Import::solid_face(const fem::ImportedFace& face, const std::string& set) const {
  const Place& place = places_.at(static_cast<std::size_t>(face.element));
  if (place.block != Place::Block::solids) {
    refuse(fmt::format("surface \"{}\" has a face of an element that is neither solid nor shell",
                       set));
  }
  std::vector<int> corners;
  for (const int corner : face.corners) corners.push_back(node(corner));
  std::sort(corners.begin(), corners.end());
  const fem::SolidBlock& solids = out_.structure.solids;
  const auto& faces = fem::solid_topology(solids.form(place.index).kind).faces;
  const auto nodes = solids.nodes(place.index);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::vector<int> own;
    for (const int corner : faces[f].corners) {
      own.push_back(nodes[static_cast<std::size_t>(corner)]);
    }
    std::sort(own.begin(), own.end());
    if (own == corners) return {place.index, static_cast<int>(f)};
  }
  refuse(fmt::format("surface \"{}\" has a face that its element does not have", set));
}

void Import::add_sets() {
  fem::Structure& structure = out_.structure;
  for (const fem::ImportedNodeSet& set : mesh_.node_sets) {
    fem::NodeSet& own = structure.node_sets.emplace_back(fem::NodeSet{set.name, {}});
    for (const int imported : set.nodes) {
      if (node(imported) >= 0) own.nodes.push_back(node(imported));
    }
  }
  for (const fem::ImportedElementSet& set : mesh_.element_sets) {
    fem::ElementSet& own = structure.element_sets.emplace_back();
    own.name = set.name;
    for (const int element : set.elements) {
      const Place& place = places_.at(static_cast<std::size_t>(element));
      if (place.block == Place::Block::beams) own.beams.push_back(place.index);
      if (place.block == Place::Block::bars) own.bars.push_back(place.index);
      if (place.block == Place::Block::solids) own.solids.push_back(place.index);
      if (place.block == Place::Block::shells) own.shells.push_back(place.index);
    }
  }
  for (const fem::ImportedFaceSet& set : mesh_.face_sets) {
    fem::FaceSet& own = structure.face_sets.emplace_back(fem::FaceSet{set.name, {}});
    for (const fem::ImportedFace& face : set.faces) {
      if (places_.at(static_cast<std::size_t>(face.element)).block == Place::Block::shells) {
        own.shells.push_back(shell_side(face));
      } else {
        own.faces.push_back(solid_face(face, set.name));
      }
    }
  }
}

}  // namespace

ImportedStructure imported_structure(const fem::ImportedMesh& mesh,
                                     const fem::GroupMaterials& materials,
                                     const std::optional<fem::DampingSpec>& damping,
                                     const SourceLocation& where) {
  return Import(mesh, materials, damping, where).run();
}

}  // namespace buckens::model

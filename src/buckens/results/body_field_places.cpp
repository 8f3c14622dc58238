// SPDX-License-Identifier: Apache-2.0
// Which quantities a body records, and at which nodes.
#include <algorithm>
#include <string>
#include <utility>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/results/body_fields.h"
#include "buckens/results/field_quantity_note.h"

namespace buckens::results {

using Eigen::Index;
using model::FieldQuantity;

void BodyFields::choose_quantities(const model::FieldOutputSpec& spec, bool has_solids,
                                   bool has_shells) {
  for (const FieldQuantity quantity : spec.record) {
    const auto add = [quantity](std::vector<FieldQuantity>& list) {
      if (std::find(list.begin(), list.end(), quantity) == list.end()) list.push_back(quantity);
    };
    if (quantity == FieldQuantity::interface_load) continue;
    if (is_motion(quantity)) {
      add(at_nodes_);
    } else {
      const bool is_at_nodes = spec.at != model::FieldLocation::elements;
      const bool is_at_elements = spec.at != model::FieldLocation::nodes;
      if (is_at_nodes && (has_solids || has_shells)) add(at_nodes_);
      if (is_at_elements && has_solids) add(at_elements_);
    }
  }
}

void BodyFields::add_part(int body, const std::vector<bool>& wanted) {
  const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(whole_)];
  const body::FlexiblePart& flexible = *model_.bodies[static_cast<std::size_t>(body)].flexible;
  PartFields& part = parts_.emplace_back();
  part.body = body;
  part.first_place = static_cast<Index>(nodes_.size());
  std::vector<int> part_elements;
  for (std::size_t row = 0; row < elements_.size(); ++row) {
    model::MeshCopy copy{body, elements_[row]};
    if (whole.is_divided()) copy = whole.solids[static_cast<std::size_t>(elements_[row])];
    if (copy.body != body) continue;
    part_elements.push_back(copy.index);
    part.element_rows.push_back(static_cast<Index>(row));
  }
  const std::vector<int> whole_nodes = whole_nodes_of(model_, whole, body);
  std::vector<int> own;
  for (std::size_t n = 0; n < whole_nodes.size(); ++n) {
    if (whole_nodes[n] >= 0 && wanted[static_cast<std::size_t>(whole_nodes[n])]) {
      own.push_back(static_cast<int>(n));
    }
  }
  if (has_stresses_) {
    part.strains = std::make_unique<fem::SolidStrains>(flexible.mesh(), own, part_elements);
    for (const fem::StrainPlace& place : part.strains->places()) {
      part.nodes.push_back(place.node);
      has_stress_.push_back(place.material >= 0);
    }
    add_shell_places(flexible.mesh(), own, part);
  } else {
    part.nodes = own;
    has_stress_.insert(has_stress_.end(), own.size(), false);
  }
  for (const int node : part.nodes) nodes_.push_back(whole_nodes[static_cast<std::size_t>(node)]);
  part.compose(flexible, std::any_of(at_nodes_.begin(), at_nodes_.end(), is_motion));
}

/// Shells take the place of a node that no solid has, further ones follow behind.
void BodyFields::add_shell_places(const fem::FeModel& mesh, const std::vector<int>& nodes,
                                  PartFields& part) {
  part.first_shell = volume_elements(mesh);
  if (fem::num_solids(mesh) == part.first_shell || nodes.empty()) return;
  part.shells = std::make_unique<fem::ShellNodeStresses>(mesh, nodes);
  const Index num_known = part.strains->num_places();
  Index known = 0;  // both lists follow the order of the nodes
  for (const fem::ShellPlace& place : part.shells->places()) {
    const auto at = [&] { return static_cast<std::size_t>(known); };
    while (known < num_known && part.nodes[at()] < place.node) ++known;
    const auto own = static_cast<std::size_t>(part.first_place) + at();
    if (known < num_known && part.nodes[at()] == place.node && !has_stress_[own]) {
      has_stress_[own] = true;
      part.shell_columns.push_back(known);
    } else {
      part.shell_columns.push_back(part.num_places());
      part.nodes.push_back(place.node);
      has_stress_.push_back(true);
    }
  }
}

void BodyFields::add_channels(FieldLayout& layout) const {
  const std::string body = "bodies/" + model_.wholes[static_cast<std::size_t>(whole_)].name;
  const auto add = [&](const char* location, const std::vector<FieldQuantity>& quantities,
                       std::size_t count) {
    const int extent = static_cast<int>(count);
    for (const FieldQuantity quantity : quantities) {
      const QuantityNote note = note_of(quantity);
      std::vector<int> shape = {extent};
      if (!note.components.empty()) shape.push_back(static_cast<int>(note.components.size()));
      layout.fields.add({"fields/" + body + "/" + location + "/" + note.name, note.unit,
                         std::move(shape), note.description, note.components});
    }
    if (!has_extremes_ || !has_tensors(quantities)) return;
    const std::string path = "extremes/" + body + "/" + location + "/von_mises";
    layout.extremes.add({path, "Pa", {extent}, "largest over the run so far", {}});
    layout.extremes.add({path + "_time", "s", {extent}, "when it was largest", {}});
  };
  add("nodes", at_nodes_, nodes_.size());
  add("elements", at_elements_, elements_.size());
}

void BodyFields::add_places(GeometryBody& shape) const {
  const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(whole_)];
  shape.field_nodes = nodes_;
  shape.field_elements = elements_;
  if (nodes_.empty()) return;
  // Per part: first place of each node of the whole mesh.
  const auto num_nodes = static_cast<std::size_t>(shape.nodes.rows());
  std::vector<std::vector<int>> first(parts_.size(), std::vector<int>(num_nodes, -1));
  bool is_one_to_one = parts_.size() == 1;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (Index p = parts_[k].num_places(); p-- > 0;) {
      const auto place = static_cast<std::size_t>(parts_[k].first_place + p);
      int& there = first[k][static_cast<std::size_t>(nodes_[place])];
      is_one_to_one = is_one_to_one && there < 0;
      there = static_cast<int>(p);
    }
  }
  const auto place_of = [&](int element, int node) {
    model::MeshCopy copy{whole.first, element};
    if (whole.is_divided()) copy = whole.solids[static_cast<std::size_t>(element)];
    const auto k = static_cast<std::size_t>(copy.body - whole.first);
    const int local = node < 0 ? -1 : first[k][static_cast<std::size_t>(node)];
    if (local < 0) return -1;
    const PartFields& part = parts_[k];
    const int own = part.nodes[static_cast<std::size_t>(local)];
    const Index found = part.strains ? part.place_of(own, copy.index) : Index{local};
    return found < 0 ? -1 : static_cast<int>(part.first_place + found);
  };
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    const int e = shape.face_elements[f];
    shape.face_places.push_back(
        {place_of(e, face[0]), place_of(e, face[1]), place_of(e, face[2]), place_of(e, face[3])});
  }
  if (is_one_to_one) return;
  std::size_t corner = 0;
  for (std::size_t e = 0; e < shape.cell_kinds.size(); ++e) {
    for (int k = 0; k < fem::num_nodes(shape.cell_kinds[e]); ++k) {
      shape.cell_places.push_back(place_of(static_cast<int>(e), shape.cell_nodes[corner++]));
    }
  }
}

}  // namespace buckens::results

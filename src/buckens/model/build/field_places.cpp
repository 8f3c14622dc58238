// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/field_places.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

namespace {

void sort_unique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The places of one mesh by name.
class PlaceFinder {
 public:
  explicit PlaceFinder(const NamedStructure& mesh) : mesh_(mesh) {}

  /// @return whether there is such a place
  bool add(const std::string& name, FieldPlaces& out) const {
    if (const InterfaceRegion* interface = mesh_.find_interface(name)) {
      add_nodes(interface->region.nodes, out);
      return true;
    }
    if (const fem::FaceSet* faces = fem::find_face_set(mesh_.structure, name)) {
      const std::vector<int> nodes = fem::face_set_nodes(mesh_.structure, *faces);
      out.nodes.insert(out.nodes.end(), nodes.begin(), nodes.end());
      for (const fem::ElementFace& face : faces->faces) out.solids.push_back(face.element);
      return true;
    }
    if (const auto* nodes = base::find_named(mesh_.structure.node_sets, name)) {
      add_nodes(nodes->nodes, out);
      return true;
    }
    if (const auto* elements = base::find_named(mesh_.structure.element_sets, name)) {
      for (const int e : elements->solids) {
        const auto own = mesh_.structure.solids.nodes(e);
        out.nodes.insert(out.nodes.end(), own.begin(), own.end());
      }
      for (const int e : elements->shells) {
        const auto own = mesh_.structure.shells.nodes(e);
        out.nodes.insert(out.nodes.end(), own.begin(), own.end());
      }
      out.solids.insert(out.solids.end(), elements->solids.begin(), elements->solids.end());
      return true;
    }
    if (const auto place = mesh_.find(name); place && place->node >= 0) {
      add_nodes({place->node}, out);
      return true;
    }
    return false;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const InterfaceRegion& interface : mesh_.interfaces) out.push_back(interface.name);
    for (const fem::FaceSet& faces : mesh_.structure.face_sets) out.push_back(faces.name);
    for (const fem::NodeSet& nodes : mesh_.structure.node_sets) out.push_back(nodes.name);
    for (const fem::ElementSet& set : mesh_.structure.element_sets) out.push_back(set.name);
    return out;
  }

 private:
  void add_nodes(const std::vector<int>& nodes, FieldPlaces& out) const {
    out.nodes.insert(out.nodes.end(), nodes.begin(), nodes.end());
    std::vector<bool> is_in(mesh_.structure.nodes.size());
    for (const int node : nodes) is_in[static_cast<std::size_t>(node)] = true;
    const fem::SolidBlock& solids = mesh_.structure.solids;
    for (int e = 0; e < solids.num_elements(); ++e) {
      const auto own = solids.nodes(e);
      const bool touches = std::any_of(
          own.begin(), own.end(), [&](int node) { return is_in[static_cast<std::size_t>(node)]; });
      if (touches) out.solids.push_back(e);
    }
  }

  const NamedStructure& mesh_;
};

[[noreturn]] void fail_unknown_body(const FieldOutputSpec& spec, const Model& model,
                                    const std::string& name) {
  std::vector<std::string> known;
  for (const WholeBody& whole : model.wholes) known.push_back(whole.name);
  throw InputError(spec.where, fmt::format("output.fields.on: there is no body \"{}\".{}", name,
                                           base::suggestion(name, known)));
}

/// Names of the places of a body where joints and loads act.
std::vector<std::string> loaded_places(const Model& model, int whole) {
  std::set<std::string> out;
  const auto add = [&](const MarkerId& id) {
    if (id.body == kGround || model.whole_of(id.body) != whole) return;
    out.insert(model.bodies[static_cast<std::size_t>(id.body)]
                   .markers[static_cast<std::size_t>(id.marker)]
                   .name);
  };
  for (const Joint& joint : model.joints) {
    if (joint.is_tie) continue;
    if (!joint.track) add(joint.first);
    add(joint.second);
  }
  for (const Load& load : model.loads) {
    if (!load.region) {
      add(load.first);
      add(load.second);
      for (const MarkerId& id : load.others) add(id);
    } else if (model.whole_of(load.first.body) == whole) {
      out.insert(part_of_place(load.region->place));
    }
  }
  out.erase("");  // of loads on the whole body
  return {out.begin(), out.end()};
}

template <class Value>
bool contains(const std::vector<Value>& list, const Value& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// @param mesh null if the body is rigid
void add_place(const FieldOutputSpec& spec, const Model& model, const NamedStructure* mesh,
               const std::string& place, FieldPlaces& places) {
  places.names.push_back(place);
  const bool has_loads = contains(spec.record, FieldQuantity::interface_load);
  std::vector<std::string> known;
  if (has_loads) known = loaded_places(model, places.whole);
  bool is_known = contains(known, place);
  if (mesh != nullptr) {
    const PlaceFinder finder(*mesh);
    is_known = finder.add(place, places) || is_known;
    const std::vector<std::string> names = finder.names();
    known.insert(known.end(), names.begin(), names.end());
  }
  if (is_known) return;
  throw InputError(
      spec.where,
      fmt::format("output.fields.on: body \"{}\" has no {} \"{}\".{}",
                  model.wholes[static_cast<std::size_t>(places.whole)].name,
                  has_loads ? "interface, face, set, node or marker with a joint or load"
                            : "interface, face, set or node",
                  place, base::suggestion(place, known)));
}

}  // namespace

std::string part_of_place(const std::string& text) {
  const std::size_t slash = text.find('/');
  return slash == text.npos ? std::string() : text.substr(slash + 1);
}

std::vector<FieldPlaces> find_field_places(
    const FieldOutputSpec& spec, const Model& model,
    const std::vector<std::unique_ptr<NamedStructure>>& meshes) {
  const bool has_loads = contains(spec.record, FieldQuantity::interface_load);
  std::map<int, FieldPlaces> found;
  if (spec.on.empty()) {
    for (std::size_t w = 0; w < meshes.size(); ++w) {
      const int whole = static_cast<int>(w);
      if (meshes[w] || has_loads) found[whole] = {whole, true, {}, {}, {}};
    }
  }
  for (const std::string& text : spec.on) {
    const std::string body = text.substr(0, text.find('/'));
    const int whole = model.find_whole(body);
    if (whole < 0) fail_unknown_body(spec, model, body);
    const NamedStructure* mesh = meshes[static_cast<std::size_t>(whole)].get();
    if (mesh == nullptr && !has_loads) {
      throw InputError(spec.where, fmt::format("output.fields.on: body \"{}\" is rigid and has no "
                                               "mesh; remove it from the list, or record its "
                                               "`interface-load`",
                                               body));
    }
    FieldPlaces& places =
        found.try_emplace(whole, FieldPlaces{whole, false, {}, {}, {}}).first->second;
    const std::string place = part_of_place(text);
    if (text == body) {
      places.is_everywhere = true;
      continue;
    }
    add_place(spec, model, mesh, place, places);
  }
  std::vector<FieldPlaces> out;
  for (auto& [whole, places] : found) {
    if (places.is_everywhere) {
      places.nodes.clear();
      places.solids.clear();
      places.names.clear();
    }
    sort_unique(places.nodes);
    sort_unique(places.solids);
    out.push_back(std::move(places));
  }
  return out;
}

}  // namespace buckens::model

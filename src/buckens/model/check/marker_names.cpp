// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/marker_names.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/fem/element/node_number.h"
#include "buckens/fem/mesh/generate_mesh.h"

namespace buckens::model {

namespace {

/// Numbers of the nodes in the file of the body, null if it has none.
const std::vector<std::int64_t>* node_numbers(const body::BodySpec& body) {
  const fem::GroupMaterials* source = std::get_if<fem::MeshSpec>(&body.kind);
  if (source == nullptr) source = std::get_if<fem::GeometrySpec>(&body.kind);
  if (source != nullptr) return source->imported ? &source->imported->node_ids : nullptr;
  const auto* matrices = std::get_if<fem::MatricesSpec>(&body.kind);
  return matrices != nullptr && matrices->imported ? &matrices->imported->numbers : nullptr;
}

}  // namespace

std::vector<std::string> marker_names(const body::BodySpec& body) {
  std::vector<std::string> out = {"origin", "com"};
  if (std::holds_alternative<fem::BeamSpec>(body.kind)) {
    out.insert(out.end(), {"start", "mid", "end"});
  }
  if (const auto* structure = std::get_if<fem::StructureSpec>(&body.kind)) {
    for (const auto& node : structure->nodes) out.push_back(node.name);
  }
  if (const auto* mesh = std::get_if<fem::MeshSpec>(&body.kind)) {
    const auto names = fem::named_nodes(*mesh);
    out.insert(out.end(), names.begin(), names.end());
  }
  for (const auto& interface : body.interfaces) out.push_back(interface.name);
  for (const auto& marker : body.markers) out.push_back(marker.name);
  return out;
}

bool is_numbered_node(const body::BodySpec& body, const std::string& name) {
  const std::vector<std::int64_t>* known = node_numbers(body);
  const auto number = fem::node_number(name);
  if (known == nullptr || !number) return false;
  return std::find(known->begin(), known->end(), *number) != known->end();
}

std::string text_of(const base::MarkerRef& marker) {
  if (!marker.text.empty()) return marker.text;
  if (marker.point) {
    return fmt::format("ground [{:g}, {:g}, {:g}]", marker.point->x(), marker.point->y(),
                       marker.point->z());
  }
  return marker.marker.empty() ? marker.body : marker.body + "/" + marker.marker;
}

Found marker_problem(const base::MarkerRef& marker, const ModelDescription& model,
                     base::NameIndex& bodies) {
  // Places of distributed loads have their own markers, "#load NAME", which trial runs observe
  // (analysis/choose_modes). build_model() knows them and refuses others of this kind.
  if (marker.marker.starts_with('#')) return std::nullopt;
  if (marker.is_ground()) {
    if (marker.marker.empty()) return std::nullopt;
    return Finding{"", fmt::format("\"{}\": the ground has no markers; write {{ground: [x, y, z]}}",
                                   text_of(marker))};
  }
  const body::BodySpec* body = bodies.find(model.bodies, marker.body);
  if (body == nullptr) {
    std::vector<std::string> known = names_of(model.bodies);
    known.push_back("ground");
    // "rod.start" where a slash is meant.
    const std::size_t mark = marker.body.find_first_of(".:");
    const std::string head = marker.body.substr(0, mark);
    if (mark != std::string::npos && base::find_named(model.bodies, head) != nullptr) {
      return Finding{"", fmt::format("unknown body \"{}\". Did you mean \"{}/{}\"? A slash "
                                     "separates the body from its marker",
                                     text_of(marker), head, text_of(marker).substr(mark + 1))};
    }
    return Finding{"", fmt::format("unknown body \"{}\".{}", marker.body,
                                   base::suggestion(marker.body, known))};
  }
  if (marker.marker.empty()) return std::nullopt;
  const std::vector<std::string> markers = marker_names(*body);
  if (std::find(markers.begin(), markers.end(), marker.marker) != markers.end() ||
      is_numbered_node(*body, marker.marker)) {
    return std::nullopt;
  }
  return Finding{"", fmt::format("body \"{}\" has no marker \"{}\".{}", marker.body, marker.marker,
                                 base::suggestion(marker.marker, markers))};
}

Found names_problem(const body::BodySpec& body) {
  std::vector<std::string> places = marker_names(body);
  const auto is_taken = [&places](const std::string& name) {
    return std::count(places.begin(), places.end(), name) > 1;
  };
  const auto taken = [](const char* list, const std::string& name) {
    return Finding{join_path(list, name),
                   fmt::format("the name \"{}\" is taken by a node or predefined marker; choose "
                               "another",
                               name)};
  };
  for (const auto& marker : body.markers) {
    if (is_taken(marker.name)) return taken("markers", marker.name);
  }
  for (const auto& interface : body.interfaces) {
    if (is_taken(interface.name)) return taken("interfaces", interface.name);
  }
  for (const auto& marker : body.markers) std::erase(places, marker.name);
  for (const auto& marker : body.markers) {
    if (marker.at.empty() || is_numbered_node(body, marker.at) ||
        std::find(places.begin(), places.end(), marker.at) != places.end()) {
      continue;
    }
    return Finding{fmt::format("markers.{}.at", marker.name),
                   fmt::format("body \"{}\" has no place \"{}\".{}", body.name, marker.at,
                               base::suggestion(marker.at, places))};
  }
  return std::nullopt;
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/body.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/files/base64.h"
#include "buckens/files/vector_json.h"

namespace buckens::page {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPoseSize = 7;
constexpr std::size_t kPageNodeSize = 6;
constexpr std::array<const char*, 3> kPageKinds = {"rigid", "beam", "solid"};

/// Where a number stands in an increasing list that holds it.
int index_in(const std::vector<std::size_t>& list, int number) {
  const auto at = std::lower_bound(list.begin(), list.end(), static_cast<std::size_t>(number));
  return static_cast<int>(at - list.begin());
}

}  // namespace

VisibleParts::VisibleParts(const results::GeometryBody& body) {
  const auto count = static_cast<std::size_t>(body.nodes.rows());
  std::vector<bool> seen(count, body.faces.empty());
  const auto see = [&seen](int node) {
    if (node >= 0) seen.at(static_cast<std::size_t>(node)) = true;
  };
  for (const auto& face : body.faces) std::for_each(face.begin(), face.end(), see);
  for (const auto& element : body.elements) std::for_each(element.begin(), element.end(), see);
  for (const auto& marker : body.markers) {
    if (marker.node < body.nodes.rows()) see(marker.node);
  }
  number.assign(count, -1);
  for (std::size_t n = 0; n < count; ++n) {
    if (!seen[n]) continue;
    number[n] = static_cast<int>(nodes.size());
    nodes.push_back(n);
  }
  for (const int e : body.face_elements) solids.push_back(static_cast<std::size_t>(e));
  for (const auto& face : body.face_places) {
    for (const int place : face) {
      if (place >= 0) places.push_back(static_cast<std::size_t>(place));
    }
  }
  for (auto* list : {&solids, &places}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
}

PageBody::PageBody(const results::GeometryBody& body) : body_(body), visible_(body) {}

/// Rotations of the nodes of solids mean nothing.
std::size_t PageBody::values_per_node() const {
  return !body_.faces.empty() && body_.elements.empty() ? 3 : kPageNodeSize;
}

std::size_t PageBody::displacements_per_frame(const run_store::RunReader& run) const {
  const int index = run.layout().find(fmt::format("bodies/{}/displacement", body_.name));
  return index < 0 ? 0 : values_per_node() * visible_.nodes.size();
}

Json PageBody::json(const FrameReader& reader) const {
  const auto number = [this](int node) {
    return visible_.number.at(static_cast<std::size_t>(node));
  };
  std::vector<double> nodes;
  std::vector<int> numbers;
  for (const std::size_t n : visible_.nodes) {
    const auto row = body_.nodes.row(static_cast<Eigen::Index>(n));
    nodes.insert(nodes.end(), row.begin(), row.end());
    numbers.push_back(static_cast<int>(n));
  }
  Json elements = Json::array();
  for (const auto& [a, b] : body_.elements) elements.push_back({number(a), number(b)});
  const bool all = numbers.size() == visible_.number.size();
  Json out = {{"name", body_.name},
              {"kind", kPageKinds[static_cast<std::size_t>(body_.kind)]},
              {"nodes", files::base64_float32(nodes)},
              {"nodeNumbers", all ? Json(nullptr) : Json(files::base64_int32(numbers))},
              {"elements", std::move(elements)},
              {"radius", body_.radius},
              {"markers", markers()},
              {"pose", pose(reader)},
              {"displacement", displacement(reader)},
              {"motion", motion(reader)}};
  if (!body_.sections.empty()) sections_into(out);
  return body_.faces.empty() ? out : faces_into(std::move(out));
}

void PageBody::sections_into(Json& out) const {
  Json sections = Json::array();
  for (const auto& loops : body_.sections) {
    Json all = Json::array();
    for (const fem::SectionLoop& loop : loops) {
      std::vector<double> points;
      for (const Eigen::Vector2d& p : loop) points.insert(points.end(), {p.x(), p.y()});
      all.push_back(files::base64_float32(points));
    }
    sections.push_back(std::move(all));
  }
  std::vector<int> numbers;
  for (const auto& ends : body_.element_sections) {
    numbers.insert(numbers.end(), ends.begin(), ends.end());
  }
  std::vector<double> axes;
  for (const Eigen::Vector3d& y : body_.element_y) axes.insert(axes.end(), y.data(), y.data() + 3);
  out["sections"] = std::move(sections);
  out["elementSections"] = files::base64_int32(numbers);
  out["elementAxes"] = files::base64_float32(axes);
}

/// Per face which of its sides are edges of its element, as bits. Faces of quadratic elements fall
/// into pieces that meet in lines between mid-side nodes.
std::vector<int> PageBody::face_edges() const {
  std::vector<std::size_t> first;  // of the nodes of each element
  std::size_t next = 0;
  for (const fem::CellKind kind : body_.cell_kinds) {
    first.push_back(next);
    next += static_cast<std::size_t>(fem::num_nodes(kind));
  }
  std::vector<int> edges;
  for (std::size_t f = 0; f < body_.faces.size(); ++f) {
    const auto e = static_cast<std::size_t>(body_.face_elements[f]);
    const auto is_corner = [&](int node) {
      if (e >= first.size()) return true;
      const auto* at = body_.cell_nodes.data() + first[e];
      const auto* end = at + fem::num_corners(body_.cell_kinds[e]);
      return std::find(at, end, node) != end;
    };
    const auto& face = body_.faces[f];
    const std::size_t count = face[3] < 0 ? 3 : 4;
    int bits = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (is_corner(face[k]) || is_corner(face[(k + 1) % count])) bits |= 1 << k;
    }
    edges.push_back(bits);
  }
  return edges;
}

Json PageBody::faces_into(Json out) const {
  std::vector<int> faces, of_face, places;
  for (std::size_t f = 0; f < body_.faces.size(); ++f) {
    for (const int node : body_.faces[f]) {
      faces.push_back(node < 0 ? node : visible_.number.at(static_cast<std::size_t>(node)));
    }
    of_face.push_back(index_in(visible_.solids, body_.face_elements[f]));
  }
  for (const auto& face : body_.face_places) {
    for (const int place : face) {
      places.push_back(place < 0 ? place : index_in(visible_.places, place));
    }
  }
  out["faces"] = files::base64_int32(faces);
  out["faceElements"] = files::base64_int32(of_face);
  const std::vector<int> edges = face_edges();
  const auto is_whole = [&](std::size_t f) { return edges[f] == (body_.faces[f][3] < 0 ? 7 : 15); };
  bool all_whole = true;
  for (std::size_t f = 0; f < edges.size(); ++f) all_whole = all_whole && is_whole(f);
  out["faceEdges"] = all_whole ? Json(nullptr) : Json(files::base64_int32(edges));
  out["facePlaces"] = places.empty() ? Json(nullptr) : Json(files::base64_int32(places));
  return out;
}

Json PageBody::markers() const {
  Json all = Json::array();
  for (const results::GeometryMarker& marker : body_.markers) {
    const Eigen::Quaterniond& q = marker.X_BF.q;
    const bool on_node = marker.node >= 0 && marker.node < body_.nodes.rows();
    const int node = on_node ? visible_.number[static_cast<std::size_t>(marker.node)] : marker.node;
    all.push_back({{"name", marker.name},
                   {"position", files::json_of(marker.X_BF.p)},
                   {"orientation", {q.w(), q.x(), q.y(), q.z()}},
                   {"node", node}});
  }
  return all;
}

/// Poses; those of a body that was not recorded stand at the origin.
Json PageBody::pose(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/pose", body_.name);
  if (reader.size_of(path) == kPoseSize) return reader.values(path);
  std::vector<double> poses(reader.num_frames() * kPoseSize, 0.0);
  for (std::size_t i = 3; i < poses.size(); i += kPoseSize) poses[i] = 1.0;
  return files::base64_float32(poses);
}

/// Nodal displacements, null if not recorded.
Json PageBody::displacement(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/displacement", body_.name);
  const auto size = static_cast<std::size_t>(body_.nodes.rows()) * kPageNodeSize;
  if (size == 0 || reader.size_of(path) != size) return nullptr;
  std::vector<std::size_t> places;
  for (const std::size_t n : visible_.nodes) {
    for (std::size_t k = 0; k < values_per_node(); ++k) places.push_back(kPageNodeSize * n + k);
  }
  return reader.rows(path, [&](const auto& all) { return values_at(all, places); });
}

/// Motion of the body's frame in a vibration, null in runs.
Json PageBody::motion(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/motion", body_.name);
  if (reader.size_of(path) != kPageNodeSize) return nullptr;
  return reader.values(path);
}

}  // namespace buckens::page

// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "buckens/io/base64.h"

namespace buckens::io {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPoseSize = 7;
constexpr std::size_t kNodeSize = 6;
constexpr std::array<const char*, 3> kKinds = {"rigid", "beam", "solid"};

Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

PageBody::PageBody(const results::GeometryBody& body) : body_(body) {
  choose_nodes();
  for (const int e : body.face_elements) solids_.push_back(static_cast<std::size_t>(e));
  std::sort(solids_.begin(), solids_.end());
  solids_.erase(std::unique(solids_.begin(), solids_.end()), solids_.end());
}

void PageBody::choose_nodes() {
  const auto count = static_cast<std::size_t>(body_.nodes.rows());
  std::vector<bool> seen(count, !is_solid());
  const auto see = [&seen](int node) {
    if (node >= 0) seen.at(static_cast<std::size_t>(node)) = true;
  };
  for (const auto& face : body_.faces) std::for_each(face.begin(), face.end(), see);
  for (const auto& element : body_.elements) std::for_each(element.begin(), element.end(), see);
  for (const auto& marker : body_.markers) {
    if (marker.node < body_.nodes.rows()) see(marker.node);
  }
  number_.assign(count, -1);
  for (std::size_t n = 0; n < count; ++n) {
    if (!seen[n]) continue;
    number_[n] = static_cast<int>(nodes_.size());
    nodes_.push_back(n);
  }
}

std::size_t PageBody::values_per_frame() const {
  return kPoseSize + values_per_node() * nodes_.size() + body_.elements.size() + solids_.size();
}

Json PageBody::json(const FrameReader& reader) const {
  const auto number = [this](int node) {
    return node < 0 ? node : number_.at(static_cast<std::size_t>(node));
  };
  Json nodes = Json::array();
  for (const std::size_t n : nodes_) {
    nodes.push_back(json_of(body_.nodes.row(static_cast<Eigen::Index>(n)).transpose()));
  }
  Json elements = Json::array();
  for (const auto& [a, b] : body_.elements) elements.push_back({number(a), number(b)});
  Json out = {{"name", body_.name},        {"kind", kKinds[static_cast<std::size_t>(body_.kind)]},
              {"nodes", std::move(nodes)}, {"elements", std::move(elements)},
              {"radius", body_.radius},    {"markers", markers()},
              {"pose", pose(reader)},      {"displacement", displacement(reader)},
              {"motion", motion(reader)},  {"stress", stress(reader)}};
  if (!is_solid()) return out;
  Json faces = Json::array();
  Json of_face = Json::array();
  for (std::size_t f = 0; f < body_.faces.size(); ++f) {
    const auto& face = body_.faces[f];
    faces.push_back({number(face[0]), number(face[1]), number(face[2]), number(face[3])});
    const auto element = static_cast<std::size_t>(body_.face_elements[f]);
    of_face.push_back(std::lower_bound(solids_.begin(), solids_.end(), element) - solids_.begin());
  }
  out["faces"] = std::move(faces);
  out["faceElements"] = std::move(of_face);
  out["solidStress"] = solid_stress(reader);
  return out;
}

Json PageBody::markers() const {
  Json all = Json::array();
  for (const results::GeometryMarker& marker : body_.markers) {
    const Eigen::Quaterniond& q = marker.X_BF.q;
    const bool on_node = marker.node >= 0 && marker.node < body_.nodes.rows();
    all.push_back(
        {{"name", marker.name},
         {"position", json_of(marker.X_BF.p)},
         {"orientation", {q.w(), q.x(), q.y(), q.z()}},
         {"node", on_node ? number_[static_cast<std::size_t>(marker.node)] : marker.node}});
  }
  return all;
}

/// Poses; those of a body that was not recorded stand at the origin.
Json PageBody::pose(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/pose", body_.name);
  if (reader.size_of(path) == kPoseSize) return reader.values(path);
  std::vector<double> poses(reader.num_frames() * kPoseSize, 0.0);
  for (std::size_t i = 3; i < poses.size(); i += kPoseSize) poses[i] = 1.0;
  return base64_float32(poses);
}

/// Nodal displacements, null if not recorded.
Json PageBody::displacement(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/displacement", body_.name);
  const auto size = static_cast<std::size_t>(body_.nodes.rows()) * kNodeSize;
  if (size == 0 || reader.size_of(path) != size) return nullptr;
  if (!is_solid()) return reader.values(path);
  std::vector<std::size_t> places;
  for (const std::size_t n : nodes_) {
    for (std::size_t k = 0; k < values_per_node(); ++k) places.push_back(kNodeSize * n + k);
  }
  return reader.values_at(path, places);
}

/// Motion of the body's frame in a vibration, null in runs.
Json PageBody::motion(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/motion", body_.name);
  if (reader.size_of(path) != kNodeSize) return nullptr;
  return reader.values(path);
}

/// Largest magnitude of the stresses of each line element, null if not recorded.
Json PageBody::stress(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/stress", body_.name);
  const std::size_t elements = body_.elements.size();
  const std::size_t size = reader.size_of(path);
  if (size == 0 || elements == 0 || size % elements != 0) return nullptr;
  const std::size_t per_element = size / elements;
  const std::vector<double> all = reader.numbers(path);
  std::vector<double> largest(reader.num_frames() * elements, 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    double& value = largest[i / per_element];
    value = std::max(value, std::abs(all[i]));
  }
  return base64_float32(largest);
}

/// Von Mises stresses of the solid elements below the surface, null if not recorded.
Json PageBody::solid_stress(const FrameReader& reader) const {
  const std::string path = fmt::format("bodies/{}/solid_stress", body_.name);
  if (solids_.empty() || reader.size_of(path) <= solids_.back()) return nullptr;
  return reader.values_at(path, solids_);
}

}  // namespace buckens::io

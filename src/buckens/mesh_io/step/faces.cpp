// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/faces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/mesh_io/step/text.h"

namespace buckens::mesh_io {

namespace {

using Numbers = std::vector<int>;

template <class Set>
const Set* find_set(const std::vector<Set>& sets, const std::string& name) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const Set& set) { return set.name == name; });
  return found == sets.end() ? nullptr : &*found;
}

/// Finds the sets `face_<number>`, thousands of them.
template <class Set>
class SetsOfFaces {
 public:
  explicit SetsOfFaces(const std::vector<Set>& sets) : sets_(sets) {
    const std::string_view prefix = kFaceName;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      if (!sets[k].name.starts_with(prefix)) continue;
      places_.emplace(std::atoi(sets[k].name.c_str() + prefix.size()), k);
    }
  }

  /// nullptr: there is none.
  const Set* of(int number) const {
    const auto found = places_.find(number);
    return found == places_.end() ? nullptr : &sets_[found->second];
  }

 private:
  const std::vector<Set>& sets_;
  std::unordered_map<int, std::size_t> places_;
};

struct MeshFaces {
  explicit MeshFaces(const fem::ImportedMesh& mesh)
      : faces(mesh.face_sets), nodes(mesh.node_sets) {}

  SetsOfFaces<fem::ImportedFaceSet> faces;
  SetsOfFaces<fem::ImportedNodeSet> nodes;
};

void add_sets(fem::ImportedMesh& mesh, const MeshFaces& own, const std::string& name,
              const Numbers& numbers) {
  fem::ImportedFaceSet faces{name, {}};
  std::set<int> nodes;
  for (const int number : numbers) {
    if (const auto* set = own.faces.of(number)) {
      faces.faces.insert(faces.faces.end(), set->faces.begin(), set->faces.end());
    }
    if (const auto* set = own.nodes.of(number)) {
      nodes.insert(set->nodes.begin(), set->nodes.end());
    }
  }
  std::sort(faces.faces.begin(), faces.faces.end(), [](const auto& a, const auto& b) {
    return std::tie(a.element, a.corners) < std::tie(b.element, b.corners);
  });
  if (find_set(mesh.face_sets, name) == nullptr) mesh.face_sets.push_back(std::move(faces));
  if (find_set(mesh.node_sets, name) == nullptr) {
    mesh.node_sets.push_back({name, {nodes.begin(), nodes.end()}});
  }
}

std::string color_name(const std::array<int, 3>& linear) {
  return fmt::format("color_{}_{}_{}", shown_color(linear[0]), shown_color(linear[1]),
                     shown_color(linear[2]));
}

/// Finds the faces that an entry means.
class FaceSelection {
 public:
  FaceSelection(const fem::ImportedMesh& mesh, const std::vector<StepFace>& faces)
      : mesh_(mesh), faces_(faces) {}

  Numbers operator()(const fem::FaceNumbersSpec& spec) const {
    for (const int number : spec.numbers) {
      const bool known = std::any_of(faces_.begin(), faces_.end(),
                                     [&](const StepFace& face) { return face.number == number; });
      if (known) continue;
      throw InputError(spec.where, fmt::format("the part has no face {}; it has faces 1 to {}",
                                               number, faces_.empty() ? 0 : faces_.back().number));
    }
    return spec.numbers;
  }

  Numbers operator()(const fem::FaceLabelSpec& spec) const {
    Numbers out;
    std::vector<std::string> labels;
    for (const StepFace& face : faces_) {
      const bool fits =
          std::find(face.labels.begin(), face.labels.end(), spec.label) != face.labels.end();
      if (fits) out.push_back(face.number);
      labels.insert(labels.end(), face.labels.begin(), face.labels.end());
    }
    if (!out.empty()) return out;
    throw InputError(
        spec.where,
        labels.empty()
            ? "the STEP file does not name its faces; choose them by color, numbers or place"
            : fmt::format("no face of the part has the name \"{}\".{}", spec.label,
                          base::suggestion(spec.label, labels)));
  }

  /// Shades are told apart as finely as the file is read: one of 256 steps of the linear scale.
  Numbers operator()(const fem::FaceColorSpec& spec) const {
    Numbers out;
    std::set<std::string> colors;
    for (const StepFace& face : faces_) {
      bool any_fits = false;
      for (const std::array<int, 3>& color : face.colors) {
        bool fits = true;
        for (std::size_t k = 0; k < 3; ++k) {
          fits = fits && std::abs(linear_color(spec.rgb[k]) - color[k]) <= 1.5;
        }
        any_fits = any_fits || fits;
        colors.insert(fmt::format("[{}, {}, {}]", shown_color(color[0]), shown_color(color[1]),
                                  shown_color(color[2])));
      }
      if (any_fits) out.push_back(face.number);
    }
    if (!out.empty()) return out;
    throw InputError(
        spec.where,
        colors.empty()
            ? "no face of the part has a colour; choose faces by numbers or place"
            : fmt::format("no face of the part has the colour [{}, {}, {}]; there are {}",
                          spec.rgb[0], spec.rgb[1], spec.rgb[2], fmt::join(colors, ", ")));
  }

  template <class Place>
  Numbers operator()(const Place& place) const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : mesh_.positions) box.extend(position);
    const double tolerance = place.tolerance.value_or(1e-6 * box.diagonal().norm());
    Numbers out;
    double nearest = std::numeric_limits<double>::infinity();
    int nearest_face = 0;
    const SetsOfFaces<fem::ImportedNodeSet> own(mesh_.node_sets);
    for (const StepFace& face : faces_) {
      double farthest = 0;
      const auto* nodes = own.of(face.number);
      if (nodes == nullptr) continue;
      for (const int node : nodes->nodes) {
        farthest = std::max(farthest,
                            fem::distance(place, mesh_.positions[static_cast<std::size_t>(node)]));
      }
      if (farthest <= tolerance) out.push_back(face.number);
      if (farthest >= nearest) continue;
      nearest = farthest;
      nearest_face = face.number;
    }
    if (!out.empty()) return out;
    throw InputError(place.where,
                     fmt::format("no face of the part lies wholly here; the nearest, face {}, "
                                 "reaches {:.3g} m beyond",
                                 nearest_face, nearest));
  }

 private:
  const fem::ImportedMesh& mesh_;
  const std::vector<StepFace>& faces_;
};

}  // namespace

void add_face_names(fem::ImportedMesh& mesh, const std::vector<StepFace>& faces) {
  std::map<std::string, Numbers> named;
  for (const StepFace& face : faces) {
    for (const auto& color : face.colors) named[color_name(color)].push_back(face.number);
    for (const std::string& label : face.labels) named[label].push_back(face.number);
  }
  const MeshFaces own(mesh);
  for (const auto& [name, numbers] : named) add_sets(mesh, own, name, numbers);
}

void name_faces(fem::ImportedMesh& mesh, const std::vector<StepFace>& faces,
                const fem::GeometryFaceSpec& spec) {
  const Numbers numbers = std::visit(FaceSelection(mesh, faces), spec.selection);
  if (find_set(mesh.face_sets, spec.name) != nullptr) {
    throw InputError(spec.where,
                     fmt::format("the part has faces of the name \"{}\" already; choose "
                                 "another",
                                 spec.name));
  }
  add_sets(mesh, MeshFaces(mesh), spec.name, numbers);
}

}  // namespace buckens::mesh_io

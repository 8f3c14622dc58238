// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/mesh_refinement.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <variant>

namespace buckens::analysis {

namespace {

// A round solid has this many elements around, or multiples.
constexpr int kAround = 4;

/// Changes the divisions of one body.
class Divisions {
 public:
  explicit Divisions(MeshChange change) : change_(change) {}

  bool is_possible() const { return is_possible_; }
  double growth() const { return growth_; }

  /// Nodal variables grow with the product of what is divided.
  template <std::size_t n>
  void change(std::array<int, n>& divisions, int multiple_of = 1) {
    double growth = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const double before = divisions[k];
      change(divisions[k], k == 1 ? multiple_of : 1);
      growth *= divisions[k] / before;
    }
    growth_ = std::max(growth_, growth);
  }

  void change(int& count, int multiple_of = 1) {
    if (change_ == MeshChange::finer) {
      count *= 2;
    } else if (count % (2 * multiple_of) == 0) {
      count /= 2;
    } else {
      is_possible_ = false;
    }
    growth_ = std::max(growth_, change_ == MeshChange::finer ? 2.0 : 0.5);
  }

 private:
  MeshChange change_;
  bool is_possible_ = true;
  double growth_ = 0.5;
};

/// @return whether anything could be changed
bool change_divisions(body::BodySpec& spec, Divisions& divisions) {
  if (auto* beam = std::get_if<fem::BeamSpec>(&spec.kind)) {
    divisions.change(beam->elements);
    return true;
  }
  if (auto* structure = std::get_if<fem::StructureSpec>(&spec.kind)) {
    for (fem::BeamMemberSpec& beam : structure->beams) divisions.change(beam.elements);
    return !structure->beams.empty() && structure->solids.empty() && structure->shells.empty();
  }
  auto* mesh = std::get_if<fem::MeshSpec>(&spec.kind);
  if (mesh == nullptr || mesh->is_file()) return false;
  std::visit(
      [&](auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (requires { shape.divisions; }) {
          divisions.change(shape.divisions,
                           std::is_base_of_v<fem::RoundMeshSpec, Shape> ? kAround : 1);
        }
      },
      mesh->shape);
  return true;
}

/// Elements of the lines of a body in the order in which sensors number them, empty: no lines.
std::vector<int> line_elements(const body::BodySpec& spec) {
  if (const auto* beam = std::get_if<fem::BeamSpec>(&spec.kind)) return {beam->elements};
  std::vector<int> out;
  if (const auto* structure = std::get_if<fem::StructureSpec>(&spec.kind)) {
    for (const fem::BeamMemberSpec& beam : structure->beams) out.push_back(beam.elements);
    for (const fem::BarMemberSpec& bar : structure->bars) out.push_back(bar.elements);
  }
  return out;
}

/// Number of the element whose first end is where that of an element of another division is.
int moved_element(int element, const std::vector<int>& before, const std::vector<int>& after) {
  int first = 0, new_first = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (element <= first + before[k]) {
      return new_first + (element - 1 - first) * after[k] / before[k] + 1;
    }
    first += before[k];
    new_first += after[k];
  }
  return element;
}

void move_sensors(model::ModelDescription& description, const std::string& body,
                  const std::vector<int>& before, const std::vector<int>& after) {
  for (model::SensorSpec& sensor : description.output.sensors) {
    std::visit(
        [&](auto& kind) {
          if constexpr (requires { kind.element; }) {
            if (kind.of.body == body && kind.element) {
              kind.element = moved_element(*kind.element, before, after);
            }
          }
        },
        sensor.kind);
  }
}

int num_beam_elements(const body::BodySpec& spec) {
  if (const auto* beam = std::get_if<fem::BeamSpec>(&spec.kind)) return beam->elements;
  int out = 0;
  if (const auto* structure = std::get_if<fem::StructureSpec>(&spec.kind)) {
    for (const fem::BeamMemberSpec& beam : structure->beams) out += beam.elements;
  }
  return out;
}

}  // namespace

MeshRefinement refine_meshes(model::ModelDescription& description, MeshChange change) {
  MeshRefinement out;
  for (body::BodySpec& spec : description.bodies) {
    if (spec.is_rigid()) continue;
    if (const auto* part = std::get_if<fem::GeometrySpec>(&spec.kind)) {
      if (part->size) out.geometries.emplace_back(spec.name, *part->size);
      continue;
    }
    const std::vector<int> before = line_elements(spec);
    Divisions divisions(change);
    if (!change_divisions(spec, divisions)) {
      out.unchanged.push_back(spec.name);
      continue;
    }
    out.changed.push_back(spec.name);
    out.is_possible = out.is_possible && divisions.is_possible();
    out.growth = std::max(out.growth, divisions.growth());
    if (!before.empty()) move_sensors(description, spec.name, before, line_elements(spec));
  }
  return out;
}

std::vector<std::string> refine_frames(model::ModelDescription& description) {
  std::vector<std::string> out;
  for (body::BodySpec& spec : description.bodies) {
    const bool is_full = spec.reduction.is_none() && spec.flexibility == body::Flexibility::elastic;
    if (!is_full || spec.frames.per_element || num_beam_elements(spec) < 2 * spec.frames.count) {
      continue;
    }
    spec.frames.count *= 2;
    out.push_back(spec.name);
  }
  return out;
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "buckens/fem/mesh/cell_measure.h"
#include "buckens/fem/mesh/connection.h"
#include "buckens/fem/mesh/units.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

void get_places(const ImportedMesh& mesh, const ImportedBlock& block, int element,
                std::vector<Vector3d>& out) {
  const auto count = static_cast<std::size_t>(num_nodes(block.kind));
  out.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const int node = block.nodes[static_cast<std::size_t>(element) * count + k];
    out.push_back(mesh.positions[static_cast<std::size_t>(node)]);
  }
}

const MaterialSpec* find_material(const ImportedMesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.materials.begin(), mesh.materials.end(),
                                  [&](const MaterialSpec& m) { return m.name == name; });
  return found == mesh.materials.end() ? nullptr : &*found;
}

double density(const ImportedMesh& mesh, const std::string& material) {
  const MaterialSpec* found = find_material(mesh, material);
  return found == nullptr ? 0.0 : found->rho;
}

struct AreaOf {
  double operator()(const CircleSpec& s) const {
    return 0.25 * std::numbers::pi * s.diameter * s.diameter;
  }
  double operator()(const TubeSpec& s) const {
    return 0.25 * std::numbers::pi * (s.outer_diameter * s.outer_diameter - s.inner() * s.inner());
  }
  double operator()(const RectangleSpec& s) const { return s.width * s.height; }
  double operator()(const BoxSpec& s) const {
    return s.width * s.height - (s.width - 2.0 * s.thickness) * (s.height - 2.0 * s.thickness);
  }
  double operator()(const GeneralSectionSpec& s) const { return s.A; }
};

/// Mass per volume of a solid, per area of a shell, per length of a line.
double specific_mass(const ImportedMesh& mesh, const ImportedBlock& block) {
  if (block.property < 0) return 0.0;
  const auto& property = mesh.properties[static_cast<std::size_t>(block.property)];
  if (dimension_of(block.kind) == 3) return density(mesh, property.material);
  if (dimension_of(block.kind) == 1) {
    const double area = property.section ? std::visit(AreaOf{}, property.section->shape) : 0.0;
    return density(mesh, property.material) * area;
  }
  if (dimension_of(block.kind) != 2) return 0.0;
  double out = density(mesh, property.material) * property.thickness.value_or(0.0);
  for (const ImportedLayer& layer : property.layers) {
    const std::string& own = layer.material.empty() ? property.material : layer.material;
    out += density(mesh, own) * layer.thickness;
  }
  return out;
}

class Reporter {
 public:
  explicit Reporter(const ImportedMesh& mesh) : mesh_(mesh) {}

  MeshReport made(bool units_given) {
    out_.nodes = mesh_.num_nodes();
    out_.elements = mesh_.num_elements();
    for (const Vector3d& position : mesh_.positions) out_.box.extend(position);
    for (const ImportedBlock& block : mesh_.blocks) add_block(block);
    for (const auto& [number, property] : properties_) add_property(property);
    add_masses();
    finish_mass();
    add_sets();
    const MeshConnection connection = connect(mesh_);
    out_.pieces = connection.pieces;
    out_.variables = connection.variables;
    for (const int node : connection.free_nodes) out_.free_nodes.push_back(id(node));
    for (const auto& [a, b] : coincident_nodes(mesh_)) {
      out_.duplicate_nodes.emplace_back(id(a), id(b));
    }
    out_.warnings = unit_warnings(mesh_, out_.box, units_given);
    return std::move(out_);
  }

 private:
  std::int64_t id(int node) const { return mesh_.node_ids[static_cast<std::size_t>(node)]; }

  void add_block(const ImportedBlock& block) {
    const auto known = std::find_if(out_.kinds.begin(), out_.kinds.end(), [&](const auto& kind) {
      return kind.kind == block.kind && kind.source == block.source;
    });
    if (known == out_.kinds.end()) {
      out_.kinds.push_back({block.kind, block.source, block.num_elements()});
    } else {
      known->count += block.num_elements();
    }
    const auto property_of = [&]() -> const ImportedProperty* {
      if (block.property < 0) return nullptr;
      return &mesh_.properties[static_cast<std::size_t>(block.property)];
    };
    MeshReport::Property& property = properties_[block.property];
    if (const ImportedProperty* own = property_of()) {
      property.name = own->name;
      property.material = own->material;
    }
    const double specific = specific_mass(mesh_, block);
    std::vector<Vector3d> x;
    for (int e = 0; e < block.num_elements(); ++e) {
      get_places(mesh_, block, e, x);
      const CellMeasure measure = cell_measure(block.kind, x);
      property.elements += 1;
      property.size += measure.size;
      property.mass += specific * measure.size;
      if (dimension_of(block.kind) == 3) volume_.add(measure);
      mass_.add(measure, specific);
      if (specific == 0.0) ++out_.without_density;
      judge(block, e, x);
    }
  }

  /// Shells of one property that differ in thickness or direction stand in one line.
  void add_property(const MeshReport::Property& property) {
    const auto [known, is_new] =
        lines_.try_emplace({property.name, property.material}, out_.properties.size());
    if (is_new) {
      out_.properties.push_back(property);
      return;
    }
    MeshReport::Property& all = out_.properties[known->second];
    all.elements += property.elements;
    all.size += property.size;
    all.mass += property.mass;
  }

  void judge(const ImportedBlock& block, int element, const std::vector<Vector3d>& x) {
    const std::int64_t number = block.ids[static_cast<std::size_t>(element)];
    const double aspect = aspect_ratio(block.kind, x);
    if (!(aspect <= out_.worst_aspect)) {
      out_.worst_aspect = aspect;
      out_.worst_element = number;
      out_.worst_centre = Vector3d::Zero();
      for (const Vector3d& node : x) out_.worst_centre += node / static_cast<double>(x.size());
    }
    if (is_inverted(block.kind, x)) {
      out_.inverted.push_back(number);
    } else if (is_inverted_at_node(block.kind, x)) {
      out_.inverted_at_nodes.push_back(number);
    }
  }

  void add_masses() {
    for (const ImportedMass& point : mesh_.masses) {
      const Vector3d at = mesh_.positions[static_cast<std::size_t>(point.node)] + point.offset;
      // ∫x xᵀ dm of a body with inertia J about its centre: ½ tr(J) 1 − J.
      const Eigen::Matrix3d own =
          0.5 * point.inertia.trace() * Eigen::Matrix3d::Identity() - point.inertia;
      mass_.add({point.mass, point.mass * at, point.mass * at * at.transpose() + own});
    }
  }

  void finish_mass() {
    out_.volume = volume_.size;
    if (volume_.size > 0) out_.volume_centre = volume_.first / volume_.size;
    out_.mass = mass_.size;
    if (!(mass_.size > 0)) return;
    out_.mass_centre = mass_.first / mass_.size;
    const Eigen::Matrix3d second =
        mass_.second - mass_.size * out_.mass_centre * out_.mass_centre.transpose();
    out_.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  }

  void add_sets() {
    for (const auto& set : mesh_.node_sets) {
      out_.node_sets.push_back({set.name, static_cast<int>(set.nodes.size())});
    }
    for (const auto& set : mesh_.element_sets) {
      out_.element_sets.push_back({set.name, static_cast<int>(set.elements.size())});
    }
    for (const auto& set : mesh_.face_sets) {
      CellMeasure sum;
      for (const ImportedFace& face : set.faces) {
        std::vector<Vector3d> x;
        for (const int node : face.corners) {
          x.push_back(mesh_.positions[static_cast<std::size_t>(node)]);
        }
        if (x.size() < 3) continue;
        sum.add(cell_measure(x.size() == 3 ? CellKind::tri3 : CellKind::quad4, x));
      }
      const Vector3d centre = sum.size > 0 ? Vector3d(sum.first / sum.size) : Vector3d::Zero();
      out_.face_sets.push_back({set.name, static_cast<int>(set.faces.size()), sum.size, centre});
    }
  }

  const ImportedMesh& mesh_;
  MeshReport out_;
  std::map<int, MeshReport::Property> properties_;                    // by number; −1: none
  std::map<std::pair<std::string, std::string>, std::size_t> lines_;  // by name and material
  CellMeasure volume_, mass_;
};

}  // namespace

MeshReport report_mesh(const ImportedMesh& mesh, bool units_given) {
  return Reporter(mesh).made(units_given);
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/model_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/constraint/coupled_nodes.h"
#include "buckens/fem/solid/block.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/model/elastic_gear.h"
#include "buckens/model/gear_flank.h"
#include "buckens/model/spec/model_description.h"
#include "buckens/results/contact_geometry.h"
#include "buckens/results/divided_body.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

// Of lines that stand for elements, as a share of the size of the body.
constexpr double kLineRadius = 0.002;

/// Node of the whole mesh that a marker of a part sits on, or is nearest to.
int whole_node(const model::WholeBody& whole, int body, const body::Marker& marker,
               const Vector3d& position) {
  int nearest = 0;
  double least = HUGE_VAL;
  for (std::size_t n = 0; n < whole.nodes.size(); ++n) {
    const model::MeshCopy& copy = whole.nodes[n];
    if (copy.body == body && copy.index == marker.node) return static_cast<int>(n);
    const double distance = (whole.mesh->nodes[n].position - whole.com - position).norm();
    if (distance < least) nearest = static_cast<int>(n);
    least = std::min(least, distance);
  }
  return nearest;
}

/// Markers of all parts, in the frame of the whole.
std::vector<GeometryMarker> markers_of(const model::Model& model, const model::WholeBody& whole) {
  std::vector<GeometryMarker> out;
  for (int b = whole.first; b < whole.first + whole.count; ++b) {
    const body::Body& body = model.bodies[static_cast<std::size_t>(b)];
    for (const body::Marker& marker : body.markers) {
      out.push_back({marker.name, marker.node, marker.X_BF});
      if (!whole.is_divided()) continue;
      out.back().X_BF.p += body.com - whole.com;
      out.back().node = whole_node(whole, b, marker, out.back().X_BF.p);
    }
  }
  return out;
}

/// Lines in place of the elements that a body given by matrices does not have.
void add_lines(const fem::FeModel& mesh, GeometryBody& shape) {
  Eigen::AlignedBox3d box;
  for (const fem::Node& node : mesh.nodes) box.extend(node.position);
  for (const auto& pair : fem::coupled_nodes(mesh)) {
    shape.elements.push_back(pair);
    const double radius = kLineRadius * box.diagonal().norm();
    shape.radius.push_back({radius, radius});
  }
}

/// Numbers outlines of cross-sections, each once.
class SectionNumbers {
 public:
  explicit SectionNumbers(GeometryBody& shape) : shape_(shape) {}

  int of(const fem::Section& section) {
    // The sections of a taper on both sides of a node differ by rounding.
    const double grain = std::ldexp(1e-9, std::ilogb(section.outer_radius));
    std::vector<double> key = {grain};
    for (const fem::SectionLoop& loop : section.outline) {
      key.push_back(static_cast<double>(loop.size()));
      for (const Eigen::Vector2d& p : loop) {
        key.insert(key.end(), {std::round(p.x() / grain), std::round(p.y() / grain)});
      }
    }
    const auto [at, is_new] = known_.emplace(key, static_cast<int>(shape_.sections.size()));
    if (is_new) shape_.sections.push_back(section.outline);
    return at->second;
  }

 private:
  GeometryBody& shape_;
  std::map<std::vector<double>, int> known_;
};

void add_beams_and_bars(const fem::FeModel& mesh, GeometryBody& shape) {
  SectionNumbers numbers(shape);
  for (const fem::LineElement& line : fem::line_elements(mesh)) {
    const auto& [first, last] = line.sections;
    shape.elements.push_back({line.a, line.b});
    shape.radius.push_back({first->outer_radius, last->outer_radius});
    shape.element_sections.push_back({numbers.of(*first), numbers.of(*last)});
    shape.element_y.push_back(line.axes.col(1));
  }
}

/// The kind of mesh cell with the same name.
fem::CellKind cell_kind(fem::SolidKind kind) {
  const std::string name = choice_names(kind)[static_cast<std::size_t>(kind)];
  const auto names = choice_names(fem::CellKind{});
  const auto* at = std::find(names.begin(), names.end(), name);
  return static_cast<fem::CellKind>(at - names.begin());
}

fem::CellKind shell_cell_kind(std::size_t num_nodes) {
  switch (num_nodes) {
    case 3:
      return fem::CellKind::tri3;
    case 6:
      return fem::CellKind::tri6;
    case 8:
      return fem::CellKind::quad8;
    default:
      return fem::CellKind::quad4;
  }
}

void add_cells(const fem::FeModel& mesh, GeometryBody& shape) {
  for (const auto& block : mesh.blocks) {
    const auto* solids = dynamic_cast<const fem::SolidBlock*>(block.get());
    for (int e = 0; solids != nullptr && e < solids->num_elements(); ++e) {
      const auto nodes = solids->nodes(e);
      shape.cell_kinds.push_back(cell_kind(solids->form(e).kind));
      shape.cell_nodes.insert(shape.cell_nodes.end(), nodes.begin(), nodes.end());
    }
  }
  for (const auto& block : mesh.blocks) {
    for (int e = 0; block->is_shell() && e < block->num_elements(); ++e) {
      const auto nodes = block->nodes(e);
      shape.cell_kinds.push_back(shell_cell_kind(nodes.size()));
      shape.cell_nodes.insert(shape.cell_nodes.end(), nodes.begin(), nodes.end());
    }
  }
}

void add_mesh(const fem::FeModel& mesh, const Vector3d& com, GeometryBody& shape) {
  shape.kind = fem::num_solids(mesh) > 0 ? BodyKind::solid : BodyKind::beam;
  shape.nodes.resize(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    shape.nodes.row(static_cast<Eigen::Index>(k)) = (mesh.nodes[k].position - com).transpose();
  }
  if (mesh.blocks.empty()) return add_lines(mesh, shape);
  add_beams_and_bars(mesh, shape);
  for (const fem::SurfaceFace& face : fem::surface_faces(mesh)) {
    shape.faces.push_back(face.nodes);
    shape.face_elements.push_back(face.element);
  }
  add_cells(mesh, shape);
}

// Arrows that are drawn of one load on one body.
constexpr std::size_t kMostFeet = 40;

/// Feet of a distributed load, thinned out evenly.
void add_feet(const model::WholeBody& whole, const model::Load& load, GeometryLoad& to) {
  const auto& feet = load.region->feet;
  const std::size_t stride = feet.size() / kMostFeet + 1;
  for (std::size_t k = stride / 2; k < feet.size(); k += stride) {
    to.positions.push_back(feet[k].place - whole.com);
    to.nodes.push_back(feet[k].node);
    if (load.element->num_values() == 1) to.directions.push_back(feet[k].normal);
  }
}

void add_foot(const model::Model& model, const model::WholeBody& whole, const model::Load& load,
              GeometryLoad& to) {
  const auto b = static_cast<std::size_t>(load.first.body);
  const body::Marker& marker = model.bodies[b].markers[static_cast<std::size_t>(load.first.marker)];
  to.positions.push_back(DividedBody(model, whole).place(load.first));
  to.nodes.push_back(whole.is_divided()
                         ? whole_node(whole, load.first.body, marker, to.positions.back())
                         : marker.node);
}

void add_loads(const model::Model& model, Geometry& out) {
  for (const model::Load& load : model.loads) {
    if (load.element->num_values() == 0 || load.first.body == model::kGround) continue;
    auto known = std::find_if(out.loads.begin(), out.loads.end(),
                              [&](const GeometryLoad& l) { return l.name == load.name; });
    const int body = model.whole_of(load.first.body);
    if (known == out.loads.end()) {
      known = out.loads.insert(
          known, {load.name, load.kind, body, load.element->follows(), load.unit, {}, {}, {}});
    }
    if (known->body != body) {
      known->body = kGroundBody;  // on all bodies: gravity-like, without a foot
      known->positions.clear();
      known->nodes.clear();
      continue;
    }
    const model::WholeBody& whole = model.wholes[static_cast<std::size_t>(body)];
    if (load.region && !load.region->feet.empty()) {
      add_feet(whole, load, *known);
    } else {
      add_foot(model, whole, load, *known);
    }
  }
}

}  // namespace

const fem::FeModel* mesh_of(const model::Model& model, const model::WholeBody& whole) {
  if (whole.is_divided()) return whole.mesh.get();
  const body::Body& body = model.bodies[static_cast<std::size_t>(whole.first)];
  return body.is_flexible() ? &body.flexible->mesh() : nullptr;
}

namespace {

/// Both flanks of teeth with play are one joint. @return whether the load is one of them
bool add_flank(const model::Model& model, const model::Load& load, Geometry& out) {
  const auto* flank = dynamic_cast<const model::GearFlank*>(load.element.get());
  if (flank == nullptr) return false;
  if (flank->data().side < 0.0) return true;
  out.joints.push_back({load.name,
                        load.kind,
                        {side_of(model, load.first), side_of(model, load.second)},
                        to_body(model, load.first, flank->data().axis_F)});
  return true;
}

}  // namespace

Geometry model_geometry(const model::Model& model) {
  Geometry out;
  out.gravity = model.gravity;
  if (model.planar)
    out.planar = choice_names(*model.planar)[static_cast<std::size_t>(*model.planar)];
  for (const model::WholeBody& whole : model.wholes) {
    GeometryBody shape;
    shape.name = whole.name;
    shape.markers = markers_of(model, whole);
    if (const fem::FeModel* mesh = mesh_of(model, whole)) add_mesh(*mesh, whole.com, shape);
    out.bodies.push_back(std::move(shape));
  }
  for (const model::Joint& joint : model.joints) {
    if (joint.is_tie) continue;
    // Sliders and wheels are drawn where they are, with an axis of their own.
    const bool moves_on = joint.track || joint.type == joints::JointType::rolling;
    const model::MarkerId& drawn_at = moves_on ? joint.second : joint.first;
    out.joints.push_back({joint.name,
                          joints::to_string(joint.type),
                          {side_of(model, drawn_at), side_of(model, joint.second)},
                          to_body(model, drawn_at, joint.axis_F)});
  }
  for (const model::Load& load : model.loads) {
    // What acts on a joint's coordinate is where the joint is drawn.
    const bool is_rope = load.kind == loads::RopeSpec::kKey;
    // Drawn as what they are.
    const bool is_drawn = load.kind == loads::ContactSpec::kKey ||
                          load.kind == loads::CableSpec::kKey ||
                          load.kind == loads::ElasticBeltSpec::kKey;
    // What rubs in a joint is where the joint is drawn, too.
    const bool is_cam = load.kind == loads::CamSpec::kKey;
    if (add_flank(model, load, out)) continue;
    const bool is_in_joint = (load.coordinate >= 0 && !is_rope && !is_cam) || load.joint >= 0;
    if (load.element->num_soft_rows() == 0 || is_drawn || is_in_joint) continue;
    if (const auto* teeth = dynamic_cast<const model::ElasticGear*>(load.element.get())) {
      out.joints.push_back({load.name,
                            joints::to_string(joints::JointType::gear),
                            {side_of(model, load.first), side_of(model, load.second)},
                            to_body(model, load.first, teeth->axis())});
      continue;
    }
    out.joints.push_back({load.name,
                          load.is_among_joints ? load.kind
                          : is_rope            ? joints::to_string(joints::JointType::distance)
                          : is_cam             ? joints::to_string(joints::JointType::slot)
                                               : "spring-damper",
                          {side_of(model, load.first), side_of(model, load.second)},
                          Vector3d::UnitZ()});
  }
  add_loads(model, out);
  add_contact_shapes(model, out);
  add_wheels(model, out);
  add_curves(model, out);
  add_cables(model, out);
  return out;
}

}  // namespace buckens::results

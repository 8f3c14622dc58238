// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/contact_geometry.h"

#include "buckens/joints/curve_gap.h"
#include "buckens/joints/path_row.h"
#include "buckens/joints/rolling_row.h"
#include "buckens/loads/cable.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/elastic_belt.h"
#include "buckens/model/contact_group.h"
#include "buckens/results/divided_body.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

// Larger meshes are drawn as the box around them: pages hold every triangle.
constexpr std::size_t kMostDrawnTriangles = 100'000;

// Of lines and arcs, too: a circle of them has corners of less than two degrees.
constexpr int kCurvePoints = 200;

/// Number of markers on the parts of a divided body before the one with this index.
int markers_before(const model::Model& model, const model::WholeBody& whole, int body) {
  int count = 0;
  for (int b = whole.first; b < body; ++b) {
    count += static_cast<int>(model.bodies[static_cast<std::size_t>(b)].markers.size());
  }
  return count;
}

void add_mesh_of(const loads::ContactMesh& mesh, GeometryShape& out) {
  if (mesh.num_facets() > kMostDrawnTriangles) {
    out.kind = "box";
    out.size = mesh.box().sizes();
    return;
  }
  for (std::size_t k = 0; k < mesh.num_facets(); ++k) {
    const int first = static_cast<int>(out.points.size());
    const auto& corners = mesh.corners(k);
    out.points.insert(out.points.end(), corners.begin(), corners.end());
    out.triangles.push_back({first, first + 1, first + 2});
  }
}

Eigen::Quaterniond turn_of(const model::Model& model, const model::MarkerId& id) {
  if (id.body == model::kGround) return id.X_WF.q;
  const body::Body& body = model.bodies[static_cast<std::size_t>(id.body)];
  return body.markers[static_cast<std::size_t>(id.marker)].X_BF.q;
}

/// @param normal across a plane curve, in axes of the marker; zero in space
GeometryShape curve_shape(const model::Model& model, const std::string& name,
                          const model::MarkerId& id, const joints::SpaceCurve& curve,
                          const Vector3d& normal) {
  GeometryShape drawn;
  drawn.name = name;
  drawn.kind = "curve";
  drawn.on = side_of(model, id);
  drawn.q = turn_of(model, id);
  drawn.axis = normal;
  for (int k = 0; k <= kCurvePoints; ++k) {
    drawn.points.push_back(curve.at(curve.length() * k / kCurvePoints).p);
    drawn.size = drawn.size.cwiseMax(2.0 * drawn.points.back().cwiseAbs());
  }
  return drawn;
}

void add_shape(const model::Model& model, const std::string& name, const model::MarkerId& id,
               const loads::ContactShape& shape, Geometry& out) {
  GeometryShape drawn;
  drawn.name = name;
  drawn.kind = loads::to_string(shape.kind);
  drawn.on = side_of(model, id);
  drawn.axis = shape.axis;
  drawn.radius = shape.radius;
  drawn.length = 2.0 * shape.half_length;
  drawn.size = 2.0 * shape.half;
  drawn.q = turn_of(model, id);
  const bool is_drawn_already = shape.mesh && id.body != model::kGround &&
                                model.bodies[static_cast<std::size_t>(id.body)].is_flexible();
  if (is_drawn_already) return;
  if (shape.mesh) add_mesh_of(*shape.mesh, drawn);
  out.shapes.push_back(std::move(drawn));
}

}  // namespace

GeometrySide side_of(const model::Model& model, const model::MarkerId& id) {
  GeometrySide side;
  if (id.body == model::kGround) {
    side.body = kGroundBody;
    side.position = model.origin + id.X_WF.p;
    return side;
  }
  side.body = model.whole_of(id.body);
  const model::WholeBody& whole = model.wholes[static_cast<std::size_t>(side.body)];
  side.marker = markers_before(model, whole, id.body) + id.marker;
  side.position = DividedBody(model, whole).place(id);
  return side;
}

Vector3d to_body(const model::Model& model, const model::MarkerId& id, const Vector3d& axis) {
  return turn_of(model, id) * axis;
}

void add_contact_shapes(const model::Model& model, Geometry& out) {
  for (const model::Load& load : model.loads) {
    if (!load.shapes) continue;
    add_shape(model, load.name, load.first, (*load.shapes)[0], out);
    add_shape(model, load.name, load.second, (*load.shapes)[1], out);
  }
  for (const auto& group : model.contact_groups) {
    for (const model::ContactMember& member : group->members) {
      add_shape(model, model.loads[group->load].name, member.marker, member.shape, out);
    }
  }
}

void add_wheels(const model::Model& model, Geometry& out) {
  for (const model::Joint& joint : model.joints) {
    if (joint.type != joints::JointType::rolling) continue;
    const auto& row = dynamic_cast<const joints::RollingRow&>(*joint.rows.front().law());
    GeometryShape drawn;
    drawn.name = joint.name;
    drawn.kind = "wheel";
    drawn.on = side_of(model, joint.second);
    drawn.axis = to_body(model, joint.second, row.data().axis_M);
    drawn.radius = row.data().radius;
    drawn.length = 2.0 * row.data().edge;
    out.shapes.push_back(std::move(drawn));
  }
}

void add_curves(const model::Model& model, Geometry& out) {
  for (const model::Joint& joint : model.joints) {
    if (joint.type != joints::JointType::slot) continue;
    const auto& row = dynamic_cast<const joints::PathRow&>(*joint.rows.front().law());
    out.shapes.push_back(curve_shape(model, joint.name, joint.first, row.curve(), row.across()));
  }
  for (const model::Load& load : model.loads) {
    if (load.coordinate < 0) continue;
    const auto* gap = dynamic_cast<const joints::CurveGap*>(
        model.coordinates[static_cast<std::size_t>(load.coordinate)].law.gap_law());
    if (gap == nullptr) continue;
    GeometryShape cam = curve_shape(model, load.name, load.first, gap->curve(), gap->across());
    if (gap->is_rim()) cam.kind = "cam";
    out.shapes.push_back(std::move(cam));
    if (gap->radius() == 0.0) continue;
    GeometryShape roller;
    roller.name = load.name;
    // In space nothing tells how the axle of the roller stands in its body.
    roller.kind = model.planar ? "wheel" : "sphere";
    roller.on = side_of(model, load.second);
    roller.q = turn_of(model, load.second);
    roller.axis = to_body(model, load.first, gap->across());
    roller.radius = gap->radius();
    out.shapes.push_back(std::move(roller));
  }
}

void add_cables(const model::Model& model, Geometry& out) {
  for (const model::Joint& joint : model.joints) {
    if (joint.pulleys[0] == 0.0) continue;
    GeometryCable drawn;
    drawn.name = joint.name;
    drawn.kind = joints::to_string(joint.type);
    drawn.is_closed = true;
    drawn.axis = to_body(model, joint.first, joint.axis_F);
    drawn.sides = {side_of(model, joint.first), side_of(model, joint.second)};
    drawn.radii = {joint.pulleys[0], joint.pulleys[1]};
    out.cables.push_back(std::move(drawn));
  }
  for (const model::Load& load : model.loads) {
    GeometryCable drawn;
    drawn.name = load.name;
    drawn.kind = load.kind;
    if (const auto* cable = dynamic_cast<const loads::Cable*>(load.element.get())) {
      drawn.is_closed = cable->data().is_closed;
      drawn.first_pulley = static_cast<int>(cable->data().first_pulley);
      std::vector<model::MarkerId> markers = {load.first, load.second};
      markers.insert(markers.end(), load.others.begin(), load.others.end());
      drawn.axis = to_body(model, markers[cable->data().first_pulley], cable->data().axis);
      for (std::size_t k = 0; k < markers.size(); ++k) {
        drawn.sides.push_back(side_of(model, markers[k]));
        drawn.radii.push_back(cable->data().nodes[k].radius);
      }
    } else if (const auto* belt = dynamic_cast<const loads::ElasticBelt*>(load.element.get())) {
      drawn.is_closed = true;
      drawn.axis = to_body(model, load.first, belt->axis());
      drawn.sides = {side_of(model, load.first), side_of(model, load.second)};
      drawn.radii = {belt->radii()[0], belt->radii()[1]};
    } else {
      continue;
    }
    out.cables.push_back(std::move(drawn));
  }
}

}  // namespace buckens::results

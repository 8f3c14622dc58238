// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/contact_shapes.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/loads/contact_mesh.h"

namespace buckens::model {

using Eigen::Vector3d;
using loads::ContactShape;

namespace {

// Sine of the angle by which a direction may leave the plane of a planar model, as of loads.
constexpr double kOutOfShapePlane = 1e-6;
// Of a surface of triangles: some 70 MB of them.
constexpr double kMostSprings = 1e6;

class ShapeBuilder {
 public:
  ShapeBuilder(MarkerFinder& find, const MarkerId& marker, const std::string& what,
               const SourceLocation& where)
      : find_(find), marker_(marker), what_(what), where_(where) {
    if (!find.model().planar) return;
    is_planar_ = true;
    normal_ = find.placed(marker).R().transpose() * spatial::normal(*find.model().planar);
  }

  ContactShape operator()(const loads::PlaneShape& spec) const {
    ContactShape out;
    out.kind = ContactShape::Kind::plane;
    out.axis = in_plane(spec.normal, "normal", "plane");
    return out;
  }
  ContactShape operator()(const loads::SphereShape& spec) const {
    return round(ContactShape::Kind::sphere, spec.radius);
  }
  ContactShape operator()(const loads::SocketShape& spec) const {
    return round(ContactShape::Kind::socket, spec.radius);
  }
  ContactShape operator()(const loads::BoreShape& spec) const {
    ContactShape out = round(ContactShape::Kind::bore, spec.radius);
    out.axis = spec.axis.value_or(is_planar_ ? normal_ : Vector3d(Vector3d::UnitZ())).normalized();
    if (is_planar_ && out.axis.cross(normal_).norm() > kOutOfShapePlane) {
      refuse("the axis of a bore must be normal to the plane; remove `axis`");
    }
    return out;
  }
  ContactShape operator()(const loads::CapsuleShape& spec) const {
    ContactShape out = round(ContactShape::Kind::capsule, spec.radius);
    out.half_length = 0.5 * spec.length;
    out.axis = in_plane(spec.axis, "axis", "capsule");
    return out;
  }
  ContactShape operator()(const loads::CylinderShape& spec) const {
    if (is_planar_) {
      refuse("a cylinder is not supported; use a `sphere`, which is a circle there, or a `box`");
    }
    ContactShape out = round(ContactShape::Kind::cylinder, spec.radius);
    out.half_length = 0.5 * spec.length;
    out.axis = spec.axis.value_or(Vector3d::UnitZ()).normalized();
    return out;
  }
  ContactShape operator()(const loads::BoxShape& spec) const {
    ContactShape out;
    out.kind = ContactShape::Kind::box;
    out.half = 0.5 * spec.size;
    if (!is_planar_) return out;
    const double along = normal_.cwiseAbs().maxCoeff(&out.flat);
    if (along < 1.0 - kOutOfShapePlane) {
      refuse("one of the axes of a box must be normal to the plane; rotate its marker");
    }
    return out;
  }
  ContactShape operator()(const loads::StlShape& spec) const {
    if (!spec.triangles) {
      throw InputError(where_, fmt::format("{}: \"{}\" has not been read; set `triangles`, or read "
                                           "the model from a file",
                                           what_, spec.file));
    }
    return mesh(*spec.triangles, spec, fmt::format("\"{}\"", spec.file));
  }
  ContactShape operator()(const loads::SurfaceShape& spec) const {
    return mesh(own_surface(), spec, "its surface");
  }

 private:
  /// @param spec with `smooth` and `spacing`
  template <class Spec>
  ContactShape mesh(const spatial::TriangleList& triangles, const Spec& spec,
                    const std::string& of) const {
    if (is_planar_) refuse("meshes are not supported; use a `sphere`, a `capsule` or a `box`");
    ContactShape out;
    out.kind = ContactShape::Kind::mesh;
    try {
      out.mesh = std::make_shared<const loads::ContactMesh>(triangles, spec.smooth,
                                                            spec.spacing.value_or(0.0));
    } catch (const InputError& error) {
      throw InputError(where_, fmt::format("{}: {}: {}", what_, of, error.text()));
    }
    if (spec.spacing && out.mesh->area() > kMostSprings * *spec.spacing * *spec.spacing) {
      throw InputError(where_,
                       fmt::format("{}: {}: a `spacing` of {:g} m over {:.4g} m² would need more "
                                   "than {:g} springs; give a larger spacing",
                                   what_, of, *spec.spacing, out.mesh->area(), kMostSprings));
    }
    out.half = out.mesh->box().min().cwiseAbs().cwiseMax(out.mesh->box().max().cwiseAbs());
    return out;
  }

  /// The faces of the marker's body, in axes of the marker.
  spatial::TriangleList own_surface() const {
    const Model& model = find_.model();
    const auto fail = [&](const char* text) {
      throw InputError(where_, fmt::format("{}: {}", what_, text));
    };
    if (marker_.body == kGround) fail("the ground has no mesh; use an `stl`");
    const body::Body& body = model.bodies[static_cast<std::size_t>(marker_.body)];
    const WholeBody& whole = model.wholes[static_cast<std::size_t>(model.whole_of(marker_.body))];
    if (whole.is_divided()) {
      fail(
          "the surface of a body with several frames belongs to several of them; use an `stl`, or "
          "one frame");
    }
    if (!body.is_flexible()) fail("its body is rigid and has no mesh; use an `stl`");
    const fem::FeModel& fe = body.flexible->mesh();
    const spatial::Pose& X = body.markers[static_cast<std::size_t>(marker_.marker)].X_BF;
    spatial::TriangleList out;
    for (const fem::Node& node : fe.nodes) {
      out.points.push_back(X.R().transpose() * (node.position - body.com - X.p));
    }
    for (const fem::SurfaceFace& face : fem::surface_faces(fe)) {
      out.triangles.push_back({face.nodes[0], face.nodes[1], face.nodes[2]});
      if (face.nodes[3] < 0) continue;
      out.triangles.push_back({face.nodes[0], face.nodes[2], face.nodes[3]});
    }
    if (out.triangles.empty()) {
      fail(
          "the mesh of its body has neither solids nor shells, so no surface; use a `capsule` or "
          "an `stl`");
    }
    return out;
  }

  [[noreturn]] void refuse(const std::string& text) const {
    throw InputError(where_, fmt::format("{}: in a planar model {}", what_, text));
  }

  static ContactShape round(ContactShape::Kind kind, double radius) {
    ContactShape out;
    out.kind = kind;
    out.radius = radius;
    return out;
  }

  Vector3d in_plane(const std::optional<Vector3d>& given, const char* key,
                    const char* shape) const {
    Vector3d out = given.value_or(Vector3d::UnitZ()).normalized();
    if (!is_planar_ || std::abs(out.dot(normal_)) <= kOutOfShapePlane) return out;
    refuse(fmt::format("the {0} of a {1} lies in the plane; {2} `{0}`", key, shape,
                       given ? "turn the" : "give the"));
  }

  MarkerFinder& find_;
  const MarkerId& marker_;
  const std::string& what_;
  const SourceLocation& where_;
  bool is_planar_ = false;
  Vector3d normal_ = Vector3d::UnitZ();  // of the plane, in axes of the marker
};

}  // namespace

ContactShape contact_shape(const loads::ShapeSpec& spec, MarkerFinder& find, const MarkerId& marker,
                           const std::string& what, const SourceLocation& where) {
  return std::visit(ShapeBuilder(find, marker, what, where), spec.kind);
}

}  // namespace buckens::model

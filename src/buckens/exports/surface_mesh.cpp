// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/surface_mesh.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace buckens::exports {

using Eigen::Vector3d;

namespace {

constexpr int kSides = 8;  // of a tube

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const results::GeometryBody& body) : body_(body) {}

  SurfaceMesh run() {
    if (body_.nodes.rows() == 0) {
      add_markers();
    } else {
      add_faces();
      for (std::size_t e = 0; e < body_.elements.size(); ++e) add_tube(e);
    }
    out_.positions.resize(3, static_cast<Eigen::Index>(places_.size()));
    for (std::size_t v = 0; v < places_.size(); ++v) {
      out_.positions.col(static_cast<Eigen::Index>(v)) = places_[v].cast<float>();
    }
    return std::move(out_);
  }

 private:
  std::uint32_t add_vertex(const Vector3d& place, int node) {
    places_.push_back(place);
    out_.nodes.push_back(node);
    return static_cast<std::uint32_t>(places_.size()) - 1;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_.triangles.insert(out_.triangles.end(), {a, b, c});
  }

  void add_markers() {
    if (body_.markers.empty()) return;
    const std::uint32_t origin = add_vertex(Vector3d::Zero(), -1);
    for (const results::GeometryMarker& marker : body_.markers) {
      if (marker.X_BF.p.norm() == 0.0) continue;
      out_.lines.insert(out_.lines.end(), {origin, add_vertex(marker.X_BF.p, -1)});
    }
  }

  void add_faces() {
    std::vector<int> vertex(static_cast<std::size_t>(body_.nodes.rows()), -1);
    const auto at = [&](int node) {
      int& known = vertex[static_cast<std::size_t>(node)];
      if (known < 0) known = static_cast<int>(add_vertex(body_.nodes.row(node), node));
      return static_cast<std::uint32_t>(known);
    };
    for (const auto& face : body_.faces) {
      add_triangle(at(face[0]), at(face[1]), at(face[2]));
      if (face[3] >= 0) add_triangle(at(face[0]), at(face[2]), at(face[3]));
    }
  }

  void add_tube(std::size_t e) {
    const auto [a, b] = body_.elements[e];
    const Vector3d from = body_.nodes.row(a), to = body_.nodes.row(b);
    const Vector3d along = (to - from).normalized();
    const Vector3d y = along.unitOrthogonal();
    const Vector3d z = along.cross(y);
    std::array<std::uint32_t, kSides> near{}, far{};
    for (std::size_t k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kSides;
      const Vector3d out = std::cos(angle) * y + std::sin(angle) * z;
      near[k] = add_vertex(from + body_.radius[e][0] * out, a);
      far[k] = add_vertex(to + body_.radius[e][1] * out, b);
    }
    for (std::size_t k = 0; k < kSides; ++k) {
      const std::size_t next = (k + 1) % kSides;
      add_triangle(near[k], near[next], far[next]);
      add_triangle(near[k], far[next], far[k]);
    }
  }

  const results::GeometryBody& body_;
  SurfaceMesh out_;
  std::vector<Vector3d> places_;
};

}  // namespace

SurfaceMesh surface_mesh(const results::GeometryBody& body) { return SurfaceBuilder(body).run(); }

}  // namespace buckens::exports

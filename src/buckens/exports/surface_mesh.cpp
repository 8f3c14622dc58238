// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace buckens::exports {

using Eigen::Vector3d;

namespace {

constexpr int kSides = 8;  // of a round tube

/// Corners (y, z) of what is drawn at an end of a line: its section, else a circle [m].
fem::SectionLoop rim_of(const results::GeometryBody& body, std::size_t e, std::size_t end) {
  if (!body.element_sections.empty()) {
    const auto& loops = body.sections[static_cast<std::size_t>(body.element_sections[e][end])];
    if (!loops.empty() && loops.front().size() >= 3) return loops.front();
  }
  fem::SectionLoop rim;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSides;
    rim.emplace_back(body.radius[e][end] * std::cos(angle), body.radius[e][end] * std::sin(angle));
  }
  return rim;
}

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
    const Vector3d y = body_.element_y.empty() ? along.unitOrthogonal() : body_.element_y[e];
    const Vector3d z = along.cross(y);
    const fem::SectionLoop first = rim_of(body_, e, 0), last = rim_of(body_, e, 1);
    const std::size_t count = std::min(first.size(), last.size());
    std::vector<std::uint32_t> near, far;
    for (std::size_t k = 0; k < count; ++k) {
      near.push_back(add_vertex(from + first[k].x() * y + first[k].y() * z, a));
      far.push_back(add_vertex(to + last[k].x() * y + last[k].y() * z, b));
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t next = (k + 1) % count;
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

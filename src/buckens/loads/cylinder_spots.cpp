// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cylinder_spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "buckens/loads/cylinder_in_box.h"
#include "buckens/loads/cylinder_in_cylinder.h"
#include "buckens/loads/symmetric_root.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;

namespace {

using CylinderSpots = std::span<ContactSpot, kCylinderSpots>;

// Springs that stand on a face.
constexpr double kSpringsOfFace = 4.0;
// Sine below which a direction counts as along, or across, the axis: support points are middles.
constexpr double kAlongAxis = 1e-9;

/// Furthest point of a solid about the origin along a direction; middles of lines and faces.
Vector3d support(const ContactShape& solid, const Vector3d& axis, const Vector3d& direction) {
  const auto sign = [](double x) { return std::abs(x) < kAlongAxis ? 0.0 : std::copysign(1.0, x); };
  if (solid.kind == ShapeKind::box) return solid.half.cwiseProduct(direction.unaryExpr(sign));
  const double along = axis.dot(direction);
  const Vector3d across = direction - along * axis;
  const double size = across.norm();
  Vector3d out = sign(along) * solid.half_length * axis;
  if (size > kAlongAxis) out += solid.radius / size * across;
  return out;
}

/// A direction in which two solids are apart; the distance is at least that.
struct Apart {
  const ContactShape& first;
  const ContactShape& second;
  Vector3d first_axis, second_axis, r;
  double gap = -HUGE_VAL;
  Vector3d normal = Vector3d::UnitZ();

  double reach(const ContactShape& solid, const Vector3d& axis, const Vector3d& u) const {
    if (solid.kind == ShapeKind::box) return solid.half.dot(u.cwiseAbs());
    const double along = axis.dot(u);
    return solid.half_length * std::abs(along) +
           solid.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
  }
  void look_along(const Vector3d& direction) {
    const double size = direction.norm();
    if (!(size > kAlongAxis * r.norm())) return;
    Vector3d u = direction / size;
    if (u.dot(r) < 0.0) u = -u;
    const double own = u.dot(r) - reach(first, first_axis, u) - reach(second, second_axis, u);
    if (own <= gap) return;
    gap = own;
    normal = u;
  }
  ContactSpot spot() const {
    ContactSpot out;
    out.gap = std::max(0.0, gap);
    out.normal = normal;
    out.share = 0.0;
    out.place = r + support(second, second_axis, -normal) - 0.5 * gap * normal;
    return out;
  }
};

Apart apart_of(const ContactShape& first, const ContactShape& cylinder, const Vector3d& r,
               const Vector3d& axis) {
  Apart out{first, cylinder, first.axis, axis, r};
  out.look_along(axis);
  out.look_along(r - axis * axis.dot(r));
  if (first.kind == ShapeKind::cylinder) {
    out.look_along(first.axis);
    out.look_along(r - first.axis * first.axis.dot(r));
    out.look_along(first.axis.cross(axis));
    return out;
  }
  for (int k = 0; k < 3; ++k) {
    out.look_along(Vector3d::Unit(k));
    out.look_along(axis.cross(Vector3d::Unit(k)));
  }
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d at = first.half;
    for (int k = 0; k < 3; ++k) {
      if ((corner & (1 << k)) != 0) at[k] = -at[k];
    }
    const Vector3d beside = r - at;
    out.look_along(beside - axis * axis.dot(beside));
  }
  return out;
}

/// Four spots around the middle of a cell, or all of it in the first one.
void set_face(const OverlapCell& cell, const Vector3d& normal, double face, bool is_spread,
              std::span<ContactSpot> spots) {
  const Vector3d centre = cell.first / cell.volume;
  const double overlap = 2.0 * cell.depth / cell.volume;
  const double springs = is_spread ? 4.0 : 1.0;
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  const Matrix3d spread = cell.second / cell.volume - centre * centre.transpose();
  const Eigen::Matrix2d root = symmetric_root(axes.transpose() * spread * axes);
  static constexpr double kX[] = {1, -1, -1, 1}, kY[] = {1, 1, -1, -1};
  for (std::size_t k = 0; k < (is_spread ? 4U : 1U); ++k) {
    ContactSpot& spot = spots[k];
    spot.normal = normal;
    spot.gap = -overlap;
    spot.held = 0.0;
    spot.share = kSpringsOfFace * cell.volume / (face * springs * overlap);
    spot.place = centre;
    if (is_spread) spot.place += axes * (root * Eigen::Vector2d(kX[k], kY[k]));
  }
}

/// Two spots beside the middle of what is nearest to the curved side.
void set_side(const SideCell& cell, const Vector3d& axis, double radius, double face,
              std::span<ContactSpot, 2> spots) {
  const double overlap = 2.0 * cell.depth / cell.volume;
  const double centre = cell.first / cell.volume;
  const double spread = std::sqrt(std::max(0.0, cell.square / cell.volume - centre * centre));
  double held = kSpringsOfFace / face * cell.depth;
  for (std::size_t k = 0; k < 2; ++k) {
    const double side = k == 0 ? -1.0 : 1.0;
    // Forces at centre ± spread with the sum and the moment of all.
    Vector3d push = 0.5 * cell.push;
    if (spread > 0.0) push += side * (cell.moment - centre * cell.push) / (2.0 * spread);
    const double size = push.norm();
    ContactSpot& spot = spots[k];
    if (size > 0.0) spot.normal = push / size;
    spot.gap = -overlap;
    spot.share = kSpringsOfFace * size / (face * overlap);
    spot.place = (centre + side * spread) * axis + (radius - 0.5 * overlap) * spot.normal;
    held -= 0.5 * spot.share * overlap * overlap;
  }
  spots[1].held = held;
}

double face_area_of(const ContactShape& solid) {
  if (solid.kind == ShapeKind::cylinder) return std::numbers::pi * solid.radius * solid.radius;
  const Vector3d& h = solid.half;
  return 4.0 / 3.0 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
}

void set_on_box(const ContactShape& box, const PlacedCylinder& placed, double face,
                CylinderSpots spots) {
  BoxCells cells;
  if (!find_cylinder_in_box(box.half, placed, cells)) return;
  const auto main = std::max_element(
      cells.begin(), cells.end(),
      [](const OverlapCell& a, const OverlapCell& b) { return a.volume < b.volume; });
  std::size_t next = 4;
  for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
    if (!(cell->volume > 0.0) || !(cell->depth > 0.0)) continue;
    const auto number = static_cast<int>(cell - cells.begin());
    const Vector3d normal = (number % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(number / 2);
    const bool is_main = cell == main;
    if (!is_main && next == kCylinderSpots) continue;
    const std::size_t at = is_main ? 0 : next++;
    set_face(*cell, normal, face, is_main, spots.subspan(at));
  }
}

void set_on_cylinder(const ContactShape& first, const PlacedCylinder& placed, double face,
                     CylinderSpots spots) {
  CylinderCells cells;
  const PlacedCylinder own{Vector3d::Zero(), first.axis, first.radius, first.half_length};
  if (!find_cylinder_in_cylinder(own, placed, cells)) return;
  const std::size_t main = cells.ends[1].volume > cells.ends[0].volume ? 1 : 0;
  for (std::size_t end = 0; end < 2; ++end) {
    const OverlapCell& cell = cells.ends[end];
    if (!(cell.volume > 0.0) || !(cell.depth > 0.0)) continue;
    set_face(cell, (end == 0 ? 1.0 : -1.0) * first.axis, face, end == main,
             spots.subspan(end == main ? 0 : 6));
  }
  if (cells.side.volume > 0.0 && cells.side.depth > 0.0) {
    set_side(cells.side, first.axis, first.radius, face, spots.subspan<4, 2>());
  }
}

}  // namespace

void find_cylinder_spots(const ContactShape& first, const ContactShape& cylinder, const Vector3d& r,
                         const Matrix3d& R, CylinderSpots spots) {
  const PlacedCylinder placed{r, R * cylinder.axis, cylinder.radius, cylinder.half_length};
  const double face = std::min(face_area_of(first), face_area_of(cylinder));
  const Apart apart = apart_of(first, cylinder, r, placed.axis);
  std::fill(spots.begin(), spots.end(), apart.spot());
  if (apart.gap > 0.0) return;
  const bool is_box = first.kind == ShapeKind::box;
  if (is_box) {
    set_on_box(first, placed, face, spots);
  } else {
    set_on_cylinder(first, placed, face, spots);
  }
}

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/joints/found_row.h"
#include "buckens/joints/held_row.h"
#include "buckens/joints/path_row.h"
#include "buckens/joints/placed_mesh.h"
#include "buckens/joints/rolling_row.h"
#include "buckens/spatial/rotation.h"

namespace buckens::joints {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Below this sine an axis counts as lying in (or normal to) the plane: about 0.01 degrees.
constexpr double kAlignment = 2e-4;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Triad {
  Vector3d x, y, z;  // in F; z along the joint axis
};

Triad triad_about(const Vector3d& z, const Placement& placement) {
  // In a planar model x is chosen normal to the plane or in it, never across.
  Vector3d hint = Vector3d::UnitX();
  if (placement.planar) {
    hint = placement.R_WF.transpose() * spatial::normal(*placement.planar);
  }
  if (hint.cross(z).norm() < 0.5) {
    Eigen::Index smallest = 0;
    z.cwiseAbs().minCoeff(&smallest);
    hint = Vector3d::Unit(smallest);
  }
  const Vector3d y = z.cross(hint).normalized();
  return {y.cross(z), y, z};
}

// Largest cosine between the arms of a cross that counts as a right angle, and the cosine of the
// largest bend of a constant-velocity joint as placed.
constexpr double kRightAngle = 1e-4;
constexpr double kLargestBend = 0.08715574274765817;  // of 85 degrees
constexpr double kFlatWheel = 1e-3;                   // sine of the angle between wheel and plane

class RowCollector {
 public:
  explicit RowCollector(const Placement& placement) : placement_(placement) {
    if (placement.planar) normal_W_ = spatial::normal(*placement.planar);
  }

  void points_in_world() {
    for (int axis = 0; axis < 3; ++axis) {
      if (in_plane(Vector3d::Unit(axis))) {
        rows_.push_back(ConstraintRow::point_world(Vector3d::Unit(axis)));
      }
    }
  }

  void point_along(const Vector3d& e_F) {
    if (in_plane(placement_.R_WF * e_F)) {
      rows_.push_back(ConstraintRow::point_along(e_F));
    }
  }

  /// R_F b ⊥ R_M c, with c given by its image in F as placed.
  void perpendicular(const Vector3d& b_F, const Vector3d& c_in_F) {
    if (in_plane(placement_.R_WF * b_F) && in_plane(placement_.R_WF * c_in_F)) {
      rows_.push_back(ConstraintRow::direction(b_F, to_M(c_in_F)));
    }
  }

  /// A row that events can attach wherever its markers have come to.
  void found(ConstraintRow row, double period = 0.0) {
    rows_.push_back(ConstraintRow::by_law(std::make_shared<FoundRow>(std::move(row), period)));
  }

  /// A weld that events can attach anywhere.
  void hold(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
    for (const Vector3d& e : {x, y, z}) {
      if (!in_plane(placement_.R_WF * e)) continue;
      rows_.push_back(
          ConstraintRow::by_law(std::make_shared<HeldRow>(HeldRow::place(e, placement_.r_F))));
    }
    const Eigen::Matrix3d R_FM = placement_.R_WF.transpose() * placement_.R_WM;
    for (const auto& [b, c] : {std::pair{x, y}, std::pair{y, z}, std::pair{z, x}}) {
      if (!in_plane(placement_.R_WF * b) || !in_plane(placement_.R_WF * c)) continue;
      rows_.push_back(ConstraintRow::by_law(std::make_shared<HeldRow>(HeldRow::turn(b, c, R_FM))));
    }
  }

  Vector3d to_M(const Vector3d& in_F) const {
    return placement_.R_WM.transpose() * (placement_.R_WF * in_F);
  }

  std::vector<ConstraintRow> take() { return std::move(rows_); }
  void push(ConstraintRow row) { rows_.push_back(std::move(row)); }

 private:
  bool in_plane(const Vector3d& direction_W) const {
    return !normal_W_ || std::abs(direction_W.dot(*normal_W_)) < 0.5;
  }

  const Placement& placement_;
  std::optional<Vector3d> normal_W_;
  std::vector<ConstraintRow> rows_;
};

/// Why a joint is not possible in a planar model; empty if it is.
std::string refusal_in_plane(JointType type) {
  switch (type) {
    case JointType::cylindrical:
    case JointType::screw:
      return "use a `prismatic` or a `revolute` joint";
    case JointType::planar:
    case JointType::parallel:
      return "all that it holds is held by the plane already; remove it";
    case JointType::universal:
    case JointType::constant_velocity:
      return "use a `revolute` joint";
    default:
      return {};
  }
}

void check_axis(JointType type, const Placement& placement, const Vector3d& axis) {
  if (!placement.planar) return;
  const std::string instead = refusal_in_plane(type);
  if (!instead.empty()) {
    throw ModelError("a " + to_string(type) + " joint has no place in a planar model; " + instead +
                     ", or leave `planar` out");
  }
  if (type == JointType::spherical || type == JointType::fixed || type == JointType::orientation ||
      type == JointType::distance || type == JointType::slot) {
    return;
  }
  const double along_normal =
      std::abs((placement.R_WF * axis).dot(spatial::normal(*placement.planar)));
  const bool turns = type == JointType::revolute || type == JointType::prescribed_rotation ||
                     type == JointType::gear || type == JointType::rack || type == JointType::belt;
  if (turns && along_normal < std::sqrt(1.0 - kAlignment * kAlignment)) {
    throw ModelError("the axis of a " + to_string(type) +
                     " joint of a planar model must be normal to the plane; "
                     "leave `axis` out or turn it");
  }
  if (!turns && along_normal > kAlignment) {
    const bool rolls = type == JointType::rolling;
    throw ModelError(std::string(rolls ? "the normal" : "the axis") + " of a " + to_string(type) +
                     " joint of a planar model must lie in the plane; turn `" +
                     (rolls ? "normal" : "axis") + "` into it");
  }
}

/// The second axis of a joint, normalised.
Vector3d unit_second_axis(const Placement& placement, const Vector3d& otherwise) {
  const Vector3d axis = placement.second_axis_F.value_or(otherwise);
  if (!(axis.norm() > 0.0) || !axis.allFinite()) {
    throw ModelError("`second-axis` has no direction; give three numbers, not all zero");
  }
  return axis.normalized();
}

void add_universal(const Triad& f, const Placement& placement, RowCollector& rows) {
  const Vector3d arm = unit_second_axis(placement, f.x);
  if (std::abs(arm.dot(f.z)) > kRightAngle) {
    throw ModelError(fmt::format(
        "the arms of a universal joint are perpendicular; `axis` and `second-axis` meet at {:.4g} "
        "degrees; turn one of them",
        std::acos(std::clamp(arm.dot(f.z), -1.0, 1.0)) * kDegrees));
  }
  rows.points_in_world();
  rows.push(ConstraintRow::direction(f.z, rows.to_M(arm)));
}

void add_constant_velocity(const Triad& f, const Placement& placement, RowCollector& rows) {
  const Vector3d shaft = unit_second_axis(placement, f.z);
  if (shaft.dot(f.z) < kLargestBend) {
    throw ModelError(
        fmt::format("the shafts of a constant-velocity joint may bend by less than 85 degrees as "
                    "placed, not by "
                    "{:.4g}; `second-axis` is the direction in which the second shaft goes on",
                    std::acos(std::clamp(shaft.dot(f.z), -1.0, 1.0)) * kDegrees));
  }
  // Directions across the second shaft are those across the first, bent with it.
  const Eigen::Matrix3d bend = spatial::rotation_between(f.z, shaft).toRotationMatrix();
  rows.points_in_world();
  rows.push(ConstraintRow::homokinetic(f.x, f.y, rows.to_M(bend * f.x), rows.to_M(bend * f.y)));
}

void add_distance(const Placement& placement, RowCollector& rows) {
  const double length = placement.length.value_or(placement.r_F.norm());
  if (!(length > 0.0)) {
    throw ModelError(
        "a distance joint has no direction where its markers coincide; place them apart, or use a "
        "`spherical` joint");
  }
  rows.push(ConstraintRow::distance(length));
}

/// A normal, the plane's where none is given.
void add_slot(const Placement& placement, RowCollector& rows) {
  std::optional<Vector3d> normal = placement.path_normal_F;
  if (placement.planar) normal = placement.R_WF.transpose() * spatial::normal(*placement.planar);
  const auto curve =
      placement.path_steps.empty()
          ? std::make_shared<SpaceCurve>(placement.path, placement.is_closed)
          : std::make_shared<SpaceCurve>(CurvePieces(placement.path_start, placement.path_steps),
                                         placement.is_closed);
  for (auto& law : make_path_rows(curve, normal)) rows.push(ConstraintRow::by_law(std::move(law)));
}

/// In a planar model nothing moves aside, and the axis is the plane's normal.
void add_rolling(const Vector3d& normal, const Placement& placement, RowCollector& rows) {
  RollingRow::Data data;
  data.normal_F = normal;
  data.radius = placement.sizes[0];
  data.edge = placement.edge;
  if (placement.planar) {
    data.axis_M = placement.R_WM.transpose() * spatial::normal(*placement.planar);
  } else {
    const Vector3d axis = placement.second_axis_F.value_or(Vector3d::Zero());
    if (!(axis.norm() > 0.0)) {
      throw ModelError("`axle` has no direction; give three numbers, not all zero");
    }
    data.axis_M = placement.R_WM.transpose() * (placement.R_WF * axis.normalized());
  }
  const double lean = (placement.R_WM * data.axis_M).cross(placement.R_WF * normal).norm();
  if (lean < kFlatWheel) {
    throw ModelError(
        "the wheel lies flat on its plane as placed; turn the body, `axle` or `normal` so that it "
        "stands on its edge");
  }
  using Direction = RollingRow::Direction;
  for (const Direction d : {Direction::normal, Direction::ahead, Direction::aside}) {
    if (placement.planar && d == Direction::aside) continue;
    rows.push(ConstraintRow::by_law(std::make_shared<RollingRow>(data, d)));
  }
}

void add_guide_or_coupling(JointType type, const Triad& f, const Placement& placement,
                           RowCollector& rows) {
  const auto parallel = [&] {
    rows.perpendicular(f.x, f.z);
    rows.perpendicular(f.y, f.z);
  };
  switch (type) {
    case JointType::cylindrical:
    case JointType::screw:
      rows.point_along(f.x);
      rows.point_along(f.y);
      parallel();
      if (type == JointType::screw) {
        rows.found(
            ConstraintRow::screw(f.z, f.x, rows.to_M(f.x), f.z.dot(placement.r_F), placement.pitch),
            std::abs(placement.pitch));
      }
      break;
    case JointType::planar:
      rows.point_along(f.z);
      parallel();
      break;
    case JointType::universal:
      return add_universal(f, placement, rows);
    case JointType::constant_velocity:
      return add_constant_velocity(f, placement, rows);
    case JointType::point_on_line:
      rows.point_along(f.x);
      rows.point_along(f.y);
      break;
    case JointType::point_in_plane:
      rows.point_along(f.z);
      break;
    case JointType::parallel:
      return parallel();
    case JointType::orientation:
      rows.perpendicular(f.x, f.y);
      rows.perpendicular(f.y, f.z);
      rows.perpendicular(f.z, f.x);
      break;
    case JointType::distance:
      return add_distance(placement, rows);
    case JointType::gear:
    case JointType::belt:
      return rows.found(ConstraintRow::by_law(placed_gear(type, f.z, placement)));
    case JointType::slot:
      return add_slot(placement, rows);
    case JointType::rack:
      return rows.found(ConstraintRow::by_law(placed_rack(f.z, placement)));
    case JointType::rolling:
      return add_rolling(f.z, placement, rows);
    default:
      break;
  }
}

}  // namespace

std::string to_string(JointType type) {
  static const std::array<const char*, 24> names = {"revolute",
                                                    "spherical",
                                                    "prismatic",
                                                    "fixed",
                                                    "prescribed-rotation",
                                                    "prescribed-translation",
                                                    "cylindrical",
                                                    "planar",
                                                    "universal",
                                                    "constant-velocity",
                                                    "point-on-line",
                                                    "point-in-plane",
                                                    "parallel",
                                                    "orientation",
                                                    "distance",
                                                    "screw",
                                                    "gear",
                                                    "rack",
                                                    "belt",
                                                    "slot",
                                                    "coupler",
                                                    "slider-on-beam",
                                                    "rolling",
                                                    "prescribed-coordinate"};
  return names[static_cast<std::size_t>(type)];
}

Vector3d unit_axis(const Placement& placement) {
  const double length = placement.axis_F.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw ModelError("the joint's axis has no direction; give three numbers, not all zero");
  }
  return placement.axis_F / length;
}

std::vector<ConstraintRow> make_straight_rows(const Placement& placement) {
  const Triad f = triad_about(unit_axis(placement), placement);
  RowCollector rows(placement);
  rows.points_in_world();
  rows.perpendicular(f.x, f.z);
  rows.perpendicular(f.y, f.z);
  return rows.take();
}

std::vector<ConstraintRow> make_rows(JointType type, const Placement& placement) {
  const Vector3d axis = unit_axis(placement);
  check_axis(type, placement, axis);
  // A weld has no axis of its own. In the plane its one rotation is about the normal, wherever the
  // axes of its markers point.
  const bool is_planar_weld =
      (type == JointType::fixed || type == JointType::orientation) && placement.planar;
  const Triad f = triad_about(
      is_planar_weld ? Vector3d(placement.R_WF.transpose() * spatial::normal(*placement.planar))
                     : axis,
      placement);
  RowCollector rows(placement);
  switch (type) {
    case JointType::spherical:
      rows.points_in_world();
      break;
    case JointType::revolute:
      rows.points_in_world();
      rows.perpendicular(f.x, f.z);
      rows.perpendicular(f.y, f.z);
      break;
    case JointType::prismatic:
      rows.point_along(f.x);
      rows.point_along(f.y);
      rows.perpendicular(f.x, f.y);
      rows.perpendicular(f.y, f.z);
      rows.perpendicular(f.z, f.x);
      break;
    case JointType::fixed:
      if (placement.as_found) {
        rows.hold(f.x, f.y, f.z);
        break;
      }
      rows.points_in_world();
      rows.perpendicular(f.x, f.y);
      rows.perpendicular(f.y, f.z);
      rows.perpendicular(f.z, f.x);
      break;
    case JointType::prescribed_rotation:
      rows.push(ConstraintRow::turning(f.z, placement.mark_F.value_or(f.x),
                                       rows.to_M(placement.mark_F.value_or(f.x)),
                                       placement.law.value()));
      break;
    case JointType::prescribed_translation:
      rows.push(ConstraintRow::point_along(f.z, f.z.dot(placement.r_F), placement.law.value()));
      break;
    default:
      add_guide_or_coupling(type, f, placement, rows);
  }
  return rows.take();
}

}  // namespace buckens::joints

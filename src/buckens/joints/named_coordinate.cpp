// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/named_coordinate.h"

#include <cmath>
#include <memory>

#include "buckens/base/errors.h"
#include "buckens/joints/path_coordinate.h"
#include "buckens/joints/path_row.h"
#include "buckens/joints/rolled_way.h"
#include "buckens/joints/swing_twist.h"

namespace buckens::joints {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Cosine between the normal of a plane and the x axis of its marker from which the y axis is taken:
// of 30 degrees. Sine below which a direction in a plane is none.
constexpr double kNearNormal = 0.8660254037844386;
constexpr double kOutOfPlane = 1e-4;

/// Makes the coordinates of one joint.
class CoordinateMaker {
 public:
  CoordinateMaker(JointType type, const Placement& placement,
                  const std::vector<ConstraintRow>& rows)
      : type_(type),
        placement_(placement),
        rows_(rows),
        axis_(unit_axis(placement)),
        R_FM_(placement.R_WF.transpose() * placement.R_WM) {}

  /// Whether the plane of a planar model leaves it free.
  bool is_free(base::CoordinateChoice which) const {
    if (!placement_.planar) return true;
    if (which == base::CoordinateChoice::swing || which == base::CoordinateChoice::twist)
      return false;
    if (which != base::CoordinateChoice::x && which != base::CoordinateChoice::y &&
        which != base::CoordinateChoice::z) {
      return true;
    }
    const Vector3d e_W = placement_.R_WF * direction(which);
    return std::abs(e_W.dot(spatial::normal(*placement_.planar))) < 0.5;
  }

  JointCoordinate make(base::CoordinateChoice which) const {
    if (type_ == JointType::rolling) return rolled(which);
    switch (which) {
      case base::CoordinateChoice::angle:
        return type_ == JointType::universal
                   ? JointCoordinate::first_angle(axis_, second_axis(), R_FM_)
                   : JointCoordinate::angle(axis_, R_FM_);
      case base::CoordinateChoice::second_angle:
        return JointCoordinate::second_angle(axis_, second_axis(), R_FM_);
      case base::CoordinateChoice::displacement:
        return type_ == JointType::slot ? way()
                                        : JointCoordinate::displacement(axis_, placement_.r_F);
      case base::CoordinateChoice::swing:
        return JointCoordinate::measured(
            std::make_shared<Swing>(axis_, R_FM_.transpose() * second_axis()));
      case base::CoordinateChoice::twist:
        return JointCoordinate::measured(std::make_shared<Twist>(axis_, second_axis(), R_FM_));
      default:
        return JointCoordinate::displacement(direction(which), placement_.r_F);
    }
  }

 private:
  Vector3d second_axis() const {
    const Vector3d axis = placement_.second_axis_F.value_or(axis_);
    if (!(axis.norm() > 0.0)) {
      throw ModelError("`second-axis` has no direction; give three numbers, not all zero");
    }
    return axis.normalized();
  }

  JointCoordinate way() const {
    const auto& row = static_cast<const PathRow&>(*rows_.front().law());
    return JointCoordinate::measured(
        std::make_shared<PathCoordinate>(row.shared_curve(), row.across(), placement_.r_F));
  }

  JointCoordinate rolled(base::CoordinateChoice which) const {
    const auto& row = static_cast<const RollingRow&>(*rows_.front().law());
    return JointCoordinate::measured(
        std::make_shared<RolledWay>(row.data(), R_FM_, which == base::CoordinateChoice::angle));
  }

  /// Of x, y or z.
  Vector3d direction(base::CoordinateChoice which) const {
    if (type_ == JointType::orientation) {
      return Vector3d::Unit(static_cast<int>(which) - static_cast<int>(base::CoordinateChoice::x));
    }
    const Vector3d x = x_in_plane();
    return which == base::CoordinateChoice::x ? x : Vector3d(axis_.cross(x));
  }

  Vector3d x_in_plane() const {
    if (!placement_.x_F && placement_.planar) {
      return axis_.cross(placement_.R_WF.transpose() * spatial::normal(*placement_.planar))
          .normalized();
    }
    const Vector3d standard =
        std::abs(axis_.x()) > kNearNormal ? Vector3d::UnitY() : Vector3d::UnitX();
    const Vector3d along = placement_.x_F.value_or(standard);
    const Vector3d x = along - axis_.dot(along) * axis_;
    if (!(x.norm() > kOutOfPlane * along.norm())) {
      throw ModelError("`along` is normal to the plane; give a direction in it");
    }
    return x.normalized();
  }

  JointType type_;
  const Placement& placement_;
  const std::vector<ConstraintRow>& rows_;
  Vector3d axis_;
  Matrix3d R_FM_;
};

}  // namespace

std::vector<NamedCoordinate> make_coordinates(JointType type,
                                              std::span<const base::CoordinateChoice> names,
                                              const Placement& placement,
                                              const std::vector<ConstraintRow>& rows) {
  std::vector<NamedCoordinate> out;
  if (names.empty()) return out;
  const CoordinateMaker maker(type, placement, rows);
  for (const base::CoordinateChoice which : names) {
    if (maker.is_free(which)) out.push_back({which, maker.make(which)});
  }
  return out;
}

}  // namespace buckens::joints

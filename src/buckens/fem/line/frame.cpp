// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/frame.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

// Sine of the angle below which a direction counts as parallel to the element.
constexpr double kParallel = 1e-6;

Vector3d choose_up(const Vector3d& x, const std::optional<Vector3d>& up) {
  if (up) {
    const double size = up->norm();
    if (size == 0.0 || x.cross(*up).norm() <= kParallel * size) {
      throw ModelError(
          fmt::format("up: ({:g}, {:g}, {:g}) is parallel to the element; give any direction "
                      "across it",
                      up->x(), up->y(), up->z()));
    }
    return *up;
  }
  return x.cross(Vector3d::UnitZ()).norm() > kParallel ? Vector3d::UnitZ() : Vector3d::UnitY();
}

}  // namespace

LineFrame line_frame(const Vector3d& from, const Vector3d& to, const std::optional<Vector3d>& up) {
  LineFrame frame;
  const Vector3d along = to - from;
  frame.length = along.norm();
  // Below this the length is rounding of the coordinates.
  if (frame.length <= 1e-12 * (from.norm() + to.norm())) {
    throw ModelError(
        fmt::format("both ends lie at ({:g}, {:g}, {:g}) m; move one of them or remove the element",
                    from.x(), from.y(), from.z()));
  }
  const Vector3d x = along / frame.length;
  const Vector3d y = choose_up(x, up).cross(x).normalized();
  frame.axes << x, y, x.cross(y);
  return frame;
}

}  // namespace buckens::fem

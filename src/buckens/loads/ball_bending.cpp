// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/ball_bending.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/bristle_bending.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// z after a way on which nothing slips: both rotations one after the other.
Vector3d turned_on(const BallBending::Way& way) {
  return spatial::log_rotation(spatial::exp_rotation(way.turned) * spatial::exp_rotation(way.z));
}

bool surely_slides(const BallBending::Way& way) {
  return way.turned.norm() > kSurelySliding * std::max(way.sliding[0], way.sliding[1]);
}

/// By the method of Runge and Kutta over the way, which counts as one.
/// @param bent before, its first column z, @param rate of (bent, z_s)
template <class Bent, class Rate>
Bent over_way(const BallBending::Way& way, Bent bent, const Rate& rate) {
  const double from = way.sliding[0], to = way.sliding[1];
  const double mean = 0.5 * (from + to);
  const int count =
      std::max(1, static_cast<int>(std::ceil(way.turned.norm() / (kPartOfBend * mean))));
  const double step = 1.0 / count;
  const auto at = [&](double part, const Bent& now) -> Bent {
    return rate(now, std::max(from + (to - from) * part * step, kLeastBound * mean));
  };
  for (int k = 0; k < count; ++k) {
    const Bent a = at(k, bent);
    const Bent b = at(k + 0.5, bent + 0.5 * step * a);
    const Bent c = at(k + 0.5, bent + 0.5 * step * b);
    const Bent d = at(k + 1, bent + step * c);
    bent += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return bent;
}

}  // namespace

Vector3d BallBending::rate(const Vector3d& z, const Vector3d& w, double sliding) const {
  // J_l⁻¹ but for terms of the fourth order in z.
  const Vector3d across = z.cross(w);
  const Vector3d elastic = w - 0.5 * across + z.cross(across) / 12.0;
  if (share_ == 0.0) return elastic - (w.norm() / sliding) * z;
  const double along = w.dot(z);
  if (!(along > 0.0)) return elastic;
  const double filled = z.norm() / sliding;
  return elastic - (sliding_share(filled, share_) * filled * along / z.squaredNorm()) * z;
}

BallBending::Slopes BallBending::slopes(const Vector3d& z, const Vector3d& w,
                                        double sliding) const {
  const Matrix3d I = Matrix3d::Identity();
  Slopes out{I - 0.5 * spatial::skew(z), 0.5 * spatial::skew(w)};
  if (share_ == 0.0) {
    out.by_rate -= z * (w.normalized() / sliding).transpose();
    out.by_z -= (w.norm() / sliding) * I;
    return out;
  }
  const double size = z.norm();
  const double along = size > 0.0 ? w.dot(z) / size : 0.0;
  const double filled = size / sliding;
  if (!(along > 0.0) || filled <= share_) return out;
  const Vector3d n = z / size;
  const double slip = sliding_share(filled, share_) * filled;
  const double growth =
      sliding_share(filled, share_) + sliding_share_slope(filled, share_) * filled;
  const Matrix3d across = I - n * n.transpose();
  out.by_rate -= slip * n * n.transpose();
  out.by_z -= (growth / sliding) * along * n * n.transpose() +
              (slip / size) * (n * w.transpose() * across + along * across);
  return out;
}

bool BallBending::is_elastic(const Way& way, const Vector3d& z) const {
  return way.z.norm() <= share_ * way.sliding[0] && z.norm() <= share_ * way.sliding[1];
}

Vector3d BallBending::after(const Way& way) const {
  const double length = way.turned.norm();
  if (surely_slides(way)) return (way.sliding[1] / length) * way.turned;
  const Vector3d elastic = turned_on(way);
  if (is_elastic(way, elastic)) return elastic;
  const Vector3d out = over_way<Vector3d>(
      way, way.z, [&](const Vector3d& z, double sliding) { return rate(z, way.turned, sliding); });
  const double size = out.norm();
  const bool is_too_far = length > kSurelySliding * way.sliding[1] && size > way.sliding[1];
  return is_too_far ? Vector3d(out * (way.sliding[1] / size)) : out;
}

Matrix3d BallBending::by_turn(const Way& way) const {
  using Bent = Eigen::Matrix<double, 3, 4>;  // z and its derivatives by ψ
  const Vector3d elastic = turned_on(way);
  if (!surely_slides(way) && is_elastic(way, elastic)) {
    return spatial::left_jacobian(elastic).inverse();
  }
  const Matrix3d by_end = spatial::left_jacobian(way.turned).inverse();
  if (surely_slides(way)) {
    const double length = way.turned.norm();
    const Vector3d e = way.turned / length;
    return (way.sliding[1] / length) * (Matrix3d::Identity() - e * e.transpose()) * by_end;
  }
  Bent bent = Bent::Zero();
  bent.col(0) = way.z;
  bent = over_way<Bent>(way, bent, [&](const Bent& now, double sliding) {
    const Slopes slope = slopes(now.col(0), way.turned, sliding);
    Bent out;
    out.col(0) = rate(now.col(0), way.turned, sliding);
    out.rightCols<3>() = slope.by_z * now.rightCols<3>() + slope.by_rate;
    return out;
  });
  return bent.rightCols<3>() * by_end;
}

}  // namespace buckens::loads

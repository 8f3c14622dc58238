// SPDX-License-Identifier: Apache-2.0
// How elastic contacts start from statics, where friction has held them in position.
#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "buckens/loads/contact.h"

namespace buckens::loads {

using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {

// Motions that friction resists by less than this share of the most do not count: turning about a
// single point, and about axes in the surface, to which its points are nearly level.
constexpr double kUnheld = 1e-8;

/// A point that presses, and forces along its surface by the motion that they resist.
struct Share {
  double load = 0;                                                      // across the surface [N]
  Eigen::Matrix<double, 6, 2> J = Eigen::Matrix<double, 6, 2>::Zero();  // turn × reach, then shift
};

/// J of a lever from the middle of all points.
Eigen::Matrix<double, 6, 2> directions(const Vector3d& lever, const Vector3d& normal,
                                       double reach) {
  const Vector3d first = normal.unitOrthogonal();
  const Vector3d second = normal.cross(first);
  Eigen::Matrix<double, 6, 2> out;
  out.col(0) << lever.cross(first) / reach, first;
  out.col(1) << lever.cross(second) / reach, second;
  return out;
}

/// The motion that all points resist together in proportion to their loads, for a given wrench.
Vector6 resisted_motion(const std::vector<Share>& shares, const Vector6& wrench) {
  Matrix6 resistance = Matrix6::Zero();
  for (const Share& share : shares) resistance += share.load * share.J * share.J.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6> own(resistance);
  const double least = kUnheld * own.eigenvalues().maxCoeff();
  Vector6 out = Vector6::Zero();
  for (int k = 0; k < 6; ++k) {
    if (!(own.eigenvalues()[k] > least)) continue;
    const Vector6 v = own.eigenvectors().col(k);
    out += v * (v.dot(wrench) / own.eigenvalues()[k]);
  }
  return out;
}

}  // namespace

void Contact::hold(const Sight& sight, const spatial::Wrench& along, double* states) const {
  std::vector<ContactSpot> spots(ContactPair::kMostSpots);
  std::vector<Point> memory(ContactPair::kMostSpots);
  Sight fresh = sight;
  fresh.states = nullptr;
  const std::span<Point> points(memory.data(), look(fresh, spots, memory).size());
  // About the middle, turns and shifts are resisted apart: the sum of all forces is exact.
  double load = 0.0;
  Vector3d middle = Vector3d::Zero();
  for (const Point& point : points) {
    load += point.across.force;
    middle += point.across.force * point.place;
  }
  if (!(load > 0.0)) return;
  middle /= load;
  double reach = 0.0;
  for (const Point& point : points) {
    if (point.across.force > 0.0) reach = std::max(reach, (point.place - middle).norm());
  }
  if (!(reach > 0.0)) reach = 1.0;
  std::vector<Share> shares;
  for (const Point& point : points) {
    shares.push_back({point.across.force, directions(point.place - middle, point.normal, reach)});
  }
  Vector6 wrench;
  wrench << (along.torque - (middle - sight.second.p).cross(along.force)) / reach, along.force;
  const Vector6 motion = resisted_motion(shares, wrench);
  ContactData data = data_;
  if (settings_.any()) settings_.put(sight.signals, data);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto& J = shares[k].J;
    Vector3d force = shares[k].load * (J.bottomRows<3>() * (J.transpose() * motion));
    const double most = data.static_coefficient * shares[k].load;
    if (force.norm() > most) force *= most / force.norm();
    points[k].along.strain = -force / data_.tangential_stiffness;
    Eigen::Map<Vector3d>(states + first_state(k) + kStrain) =
        sight.first.R.transpose() * points[k].along.strain;
  }
  set_common_states(fresh, points, states);
}

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/marker_finder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model/build/interface_regions.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

MarkerId MarkerFinder::marker(const base::MarkerRef& ref, bool needs_mesh) {
  MarkerId id;
  id.text = ref.text;
  if (ref.is_ground()) {
    id.X_WF.p = ref.point.value_or(Vector3d::Zero());
    return id;
  }
  const WholeBody* whole = wholes_.find(model_.wholes, ref.body);
  if (whole == nullptr) {
    std::vector<std::string> names = {"ground"};
    for (const WholeBody& known : model_.wholes) names.push_back(known.name);
    throw InputError(ref.where, fmt::format("there is no body \"{}\".{}", ref.body,
                                            base::suggestion(ref.body, names)));
  }
  id.body = body_of(*whole, ref.marker);
  id.marker = tables_[static_cast<std::size_t>(id.body)]->find(ref, needs_mesh);
  return id;
}

int MarkerFinder::body_of(const WholeBody& whole, const std::string& marker) const {
  if (!whole.is_divided()) return whole.first;
  int nearest = whole.first;
  double least = HUGE_VAL;
  for (int b = whole.first; b < whole.first + whole.count; ++b) {
    const MarkerTable& table = *tables_[static_cast<std::size_t>(b)];
    if (table.holds(marker)) return b;
    const double distance = table.distance(marker);
    if (distance < least) nearest = b;
    least = std::min(least, distance);
  }
  return nearest;
}

const body::Marker* MarkerFinder::on_body(const MarkerId& id) const {
  if (id.body == kGround) return nullptr;
  return &model_.bodies[static_cast<std::size_t>(id.body)]
              .markers[static_cast<std::size_t>(id.marker)];
}

spatial::Pose MarkerFinder::placed(const MarkerId& id) const {
  const body::Marker* marker = on_body(id);
  return marker == nullptr ? id.X_WF
                           : model_.placed[static_cast<std::size_t>(id.body)] * marker->X_BF;
}

void MarkerFinder::require_moment(const MarkerId& id, const std::string& what,
                                  const SourceLocation& where) const {
  const body::Marker* marker = on_body(id);
  if (marker == nullptr || marker->carries_moment()) return;
  const MarkerTable& table = *tables_[static_cast<std::size_t>(id.body)];
  const InterfaceRegion* interface = table.interface(marker->name);
  throw ModelError(
      where, fmt::format("{}: \"{}\" cannot carry a moment, {}", what, id.text,
                         interface != nullptr
                             ? why_no_moment(*interface)
                             : "bars and solids have no rotations there; use an interface that "
                               "spans a surface, spherical joints at several nodes or forces, or "
                               "join a beam to the node"));
}

void MarkerFinder::require_two_bodies(const MarkerId& first, const MarkerId& second,
                                      const std::string& what, const SourceLocation& where) const {
  const bool is_one = first.body == kGround || second.body == kGround
                          ? first.body == second.body
                          : model_.whole_of(first.body) == model_.whole_of(second.body);
  if (!is_one) return;
  throw ModelError(
      where,
      fmt::format(
          "{} connects {} with itself; it needs two different bodies, or a "
          "body and the ground",
          what,
          first.body == kGround
              ? "the ground"
              : "body \"" +
                    model_.wholes[static_cast<std::size_t>(model_.whole_of(first.body))].name +
                    "\""));
}

joints::Placement MarkerFinder::placement(const MarkerId& first, const MarkerId& second) const {
  const spatial::Pose X_WF = placed(first);
  const spatial::Pose X_WM = placed(second);
  joints::Placement out;
  out.R_WF = X_WF.R();
  out.R_WM = X_WM.R();
  out.r_F = out.R_WF.transpose() * (X_WM.p - X_WF.p);
  out.planar = model_.planar;
  return out;
}

Vector3d MarkerFinder::axis_or_normal(const std::optional<Vector3d>& axis, const Matrix3d& R_WF,
                                      const std::string& what, const SourceLocation& where) const {
  if (axis) return *axis;
  if (model_.planar) return R_WF.transpose() * spatial::normal(*model_.planar);
  throw InputError(where, what + " needs an `axis` in a model in space, for example [0, 0, 1]");
}

void MarkerFinder::require_across_plane(const Vector3d& axis_W, const char* of,
                                        const std::string& what,
                                        const SourceLocation& where) const {
  // sin of the angle between axis and normal that counts as none.
  constexpr double kTurned = 2e-4;
  if (!model_.planar || axis_W.cross(spatial::normal(*model_.planar)).norm() <= kTurned) return;
  throw InputError(where, fmt::format("{}: the axis of {} of a planar model must be normal to the "
                                      "plane; leave `axis` out or turn it",
                                      what, of));
}

}  // namespace buckens::model

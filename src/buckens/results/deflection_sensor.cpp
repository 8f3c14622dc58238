// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/deflection_sensor.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/results/divided_body.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {

using Eigen::Vector3d;
using model::MarkerId;

namespace {

/// Elastic displacement: in body axes from the frame or from the chord between two markers, in its
/// own axes from another marker.
class DeflectionSensor final : public Sensor {
 public:
  DeflectionSensor(Channel channel, std::vector<MarkerId> markers)
      : channel_(std::move(channel)), markers_(std::move(markers)) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const Vector3d v = markers_.size() == 3   ? from_chord(now)
                       : markers_.size() == 2 ? from_marker(now)
                                              : displacement(now, markers_[0]);
    values.insert(values.end(), {v.x(), v.y(), v.z()});
  }

 private:
  static DividedBody whole(const Observation& now, const MarkerId& id) {
    const auto w = static_cast<std::size_t>(now.model.whole_of(id.body));
    return DividedBody(now.model, now.model.wholes[w]);
  }
  static Vector3d displacement(const Observation& now, const MarkerId& id) {
    const auto b = static_cast<std::size_t>(id.body);
    if (now.model.wholes[static_cast<std::size_t>(now.model.whole_of(id.body))].is_divided()) {
      return whole(now, id).displacement(now, id);
    }
    const body::Marker& m = now.model.bodies[b].markers[static_cast<std::size_t>(id.marker)];
    if (!m.follows_mesh()) return Vector3d::Zero();
    return now.motions[b].y.segment<3>(m.translation_row);
  }
  Vector3d from_chord(const Observation& now) const {
    const DividedBody body = whole(now, markers_[0]);
    const Vector3d p0 = body.place(markers_[0]);
    const Vector3d a0 = body.place(markers_[1]);
    const Vector3d b0 = body.place(markers_[2]);
    const Vector3d a = a0 + displacement(now, markers_[1]);
    const Vector3d b = b0 + displacement(now, markers_[2]);
    const double share = (p0 - a0).dot(b0 - a0) / (b0 - a0).squaredNorm();
    const Vector3d off = p0 + displacement(now, markers_[0]) - (a + share * (b - a));
    const Vector3d off0 = p0 - (a0 + share * (b0 - a0));
    // Seen in axes that turn with the chord.
    return spatial::rotation_between(b - a, b0 - a0) * off - off0;
  }

  /// As the second marker sees it, that moves and turns with the mesh.
  Vector3d from_marker(const Observation& now) const {
    const DividedBody body = whole(now, markers_[0]);
    const model::MarkerId& base = markers_[1];
    const Eigen::Quaterniond& q0 = now.model.bodies[static_cast<std::size_t>(base.body)]
                                       .markers[static_cast<std::size_t>(base.marker)]
                                       .X_BF.q;
    const auto of = dynamics::evaluate_marker(now.model, markers_[0], now.motions).motion;
    const auto from = dynamics::evaluate_marker(now.model, base, now.motions).motion;
    return from.R.transpose() * (of.p - from.p) -
           q0.conjugate() * (body.place(markers_[0]) - body.place(base));
  }

  Channel channel_;
  std::vector<MarkerId> markers_;  // observed; then the ends of the chord, or the marker that sees
};

}  // namespace

std::unique_ptr<Sensor> make_deflection_sensor(const model::BuiltModel& built,
                                               const model::SensorSpec& spec,
                                               const std::vector<MarkerId>& markers) {
  const char* axes = "body axes";
  if (markers.size() == 2) {
    const MarkerId& base = markers[1];
    const body::Marker& marker = built.model.bodies.at(static_cast<std::size_t>(base.body))
                                     .markers.at(static_cast<std::size_t>(base.marker));
    if (!marker.carries_moment()) {
      throw ModelError(spec.where,
                       fmt::format("sensor \"{}\": \"{}\" has no rotation from which a deflection "
                                   "could be seen; use an interface that spans a surface, or a "
                                   "`chord`",
                                   spec.name, base.text));
    }
    axes = "the axes of the marker from which it is seen";
  }
  return std::make_unique<DeflectionSensor>(Channel{"sensors/" + spec.name,
                                                    "m",
                                                    {3},
                                                    fmt::format("elastic displacement in {}", axes),
                                                    {"x", "y", "z"}},
                                            markers);
}

}  // namespace buckens::results

// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/dynamics/forces.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/results/action_of_whole.h"
#include "buckens/results/belt_sensor.h"
#include "buckens/results/cable_sensor.h"
#include "buckens/results/contact_sensor.h"
#include "buckens/results/coordinate_sensor.h"
#include "buckens/results/deflection_sensor.h"
#include "buckens/results/divided_body.h"
#include "buckens/results/energy_sensor.h"
#include "buckens/results/gear_sensor.h"
#include "buckens/results/load_sensor.h"
#include "buckens/results/model_geometry.h"
#include "buckens/results/signal_sensor.h"
#include "buckens/results/spring_sensor.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using model::MarkerId;

namespace {

Channel vector_channel(const std::string& name, const std::string& unit,
                       const std::string& description) {
  return {"sensors/" + name, unit, {3}, description, {"x", "y", "z"}};
}

void push(const Vector3d& v, std::vector<double>& values) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

/// Components in the axes of a marker, or of the world.
class Axes {
 public:
  explicit Axes(std::optional<MarkerId> marker) : marker_(std::move(marker)) {}
  Vector3d components(const Observation& now, const Vector3d& v) const {
    if (!marker_) return v;
    return dynamics::evaluate_marker(now.model, *marker_, now.motions).motion.R.transpose() * v;
  }

 private:
  std::optional<MarkerId> marker_;
};

enum class MarkerQuantity { position, displacement, velocity, acceleration, rotation, spin };

class MarkerSensor final : public Sensor {
 public:
  /// @param along unit vector of the one component that is recorded, if any
  MarkerSensor(Channel channel, MarkerQuantity quantity, MarkerId of, Axes axes,
               std::optional<Vector3d> along)
      : channel_(std::move(channel)),
        quantity_(quantity),
        of_(std::move(of)),
        axes_(std::move(axes)),
        along_(std::move(along)) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void start(const Observation& now) override { start_ = motion(now); }
  void append(const Observation& now, std::vector<double>& values) override {
    const Vector3d components = axes_.components(now, value(now));
    if (along_) return values.push_back(along_->dot(components));
    push(components, values);
  }
  void visit_saved(const base::SaveVisit& visit) override {
    visit.fixed("p", start_.p);
    visit.fixed("R", start_.R);
    visit.fixed("v", start_.v);
    visit.fixed("w", start_.w);
  }

 private:
  spatial::MarkerMotion motion(const Observation& now) const {
    return dynamics::evaluate_marker(now.model, of_, now.motions).motion;
  }
  Vector3d value(const Observation& now) const {
    switch (quantity_) {
      case MarkerQuantity::position:
        return now.model.origin + motion(now).p;
      case MarkerQuantity::displacement:
        return motion(now).p - start_.p;
      case MarkerQuantity::velocity:
        return motion(now).v;
      case MarkerQuantity::acceleration:
        return marker_acceleration(now, of_);
      case MarkerQuantity::rotation:
        return spatial::log_rotation(
            Eigen::Quaterniond(Matrix3d(motion(now).R * start_.R.transpose())));
      default:
        return motion(now).w;
    }
  }

  Channel channel_;
  MarkerQuantity quantity_;
  MarkerId of_;
  Axes axes_;
  std::optional<Vector3d> along_;
  spatial::MarkerMotion start_;
};

class RelativeSensor final : public Sensor {
 public:
  RelativeSensor(Channel channel, model::RelativeQuantity quantity, MarkerId first, MarkerId second,
                 const Vector3d& axis)
      : channel_(std::move(channel)),
        quantity_(quantity),
        first_(std::move(first)),
        second_(std::move(second)),
        axis_(axis.normalized()) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const auto F = dynamics::evaluate_marker(now.model, first_, now.motions).motion;
    const auto M = dynamics::evaluate_marker(now.model, second_, now.motions).motion;
    const Vector3d r = M.p - F.p;
    using Q = model::RelativeQuantity;
    switch (quantity_) {
      case Q::position:
        return push(F.R.transpose() * r, values);
      case Q::distance:
        return values.push_back(r.norm());
      case Q::velocity:
        return push(F.R.transpose() * (M.v - F.v - F.w.cross(r)), values);
      case Q::rotation:
        return push(spatial::log_rotation(Eigen::Quaterniond(Matrix3d(F.R.transpose() * M.R))),
                    values);
      case Q::angle:
        return values.push_back(counted_angle(now.state.t, F, M));
      case Q::angular_velocity:
        return push(F.R.transpose() * (M.w - F.w), values);
    }
  }
  void visit_saved(const base::SaveVisit& visit) override {
    bool has_reference = reference_.has_value();
    visit.flag("has_reference", has_reference);
    if (!has_reference) return reference_.reset();
    if (!reference_) reference_.emplace();
    visit.fixed("reference", *reference_);
    visit.number("angle", angle_);
    visit.number("rate", rate_);
    visit.number("t", t_);
  }

 private:
  /// Angle of M about the axis of F; full turns are counted with the help of the rate.
  double counted_angle(double t, const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) {
    const Vector3d x = axis_.unitOrthogonal();
    const Matrix3d R_FM = F.R.transpose() * M.R;
    if (!reference_) reference_ = R_FM.transpose() * x;
    const Vector3d moved = R_FM * *reference_;
    double angle = std::atan2(axis_.cross(x).dot(moved), x.dot(moved));
    const double rate = (F.R * axis_).dot(M.w - F.w);
    const double expected = angle_ + 0.5 * (rate + rate_) * (t - t_);
    const double turn = 2.0 * std::numbers::pi;
    angle += turn * std::round((expected - angle) / turn);
    angle_ = angle;
    rate_ = rate;
    t_ = t;
    return angle;
  }

  Channel channel_;
  model::RelativeQuantity quantity_;
  MarkerId first_, second_;
  Vector3d axis_;
  std::optional<Vector3d> reference_;
  double angle_ = 0, rate_ = 0, t_ = 0;
};

class JointSensor final : public Sensor {
 public:
  JointSensor(Channel channel, int joint, int load, bool torque, Axes axes)
      : channel_(std::move(channel)),
        joint_(joint),
        load_(load),
        torque_(torque),
        axes_(std::move(axes)) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const spatial::Wrench wrench =
        joint_ >= 0 ? now.joint_wrenches[static_cast<std::size_t>(joint_)] : force_element(now);
    push(axes_.components(now, torque_ ? wrench.torque : wrench.force), values);
  }

 private:
  spatial::Wrench force_element(const Observation& now) const {
    const model::Load& load = now.model.loads[static_cast<std::size_t>(load_)];
    const dynamics::LoadEnds ends =
        dynamics::ends_of(now.model, load, now.motions, circumstances_of(now).memory);
    spatial::Wrench out = action_of_whole(now, static_cast<std::size_t>(load_), ends).on_second;
    if (load.element->is_applied()) {
      out.force *= now.load_factor;
      out.torque *= now.load_factor;
    }
    return out;
  }

  Channel channel_;
  int joint_, load_;
  bool torque_;
  Axes axes_;
};

class SectionForceSensor final : public Sensor {
 public:
  SectionForceSensor(std::string name, const model::SensorPlace& place)
      : name_(std::move(name)), place_(place) {}

  std::vector<Channel> channels() const override {
    return {{"sensors/" + name_ + ".force",
             "N",
             {3},
             "section forces in element axes",
             {"N", "Qy", "Qz"}},
            {"sensors/" + name_ + ".moment",
             "N m",
             {3},
             "section moments in element axes",
             {"Mt", "My", "Mz"}}};
  }
  ObservedParts reads() const override {
    return {false, {{place_.body, {false, {place_.element}, {}}}}};
  }
  void append(const Observation& now, std::vector<double>& values) override {
    const auto& forces = now.section_forces[static_cast<std::size_t>(place_.body)];
    const Eigen::Index column = now.column_of_line(place_.body, place_.element);
    for (int k = 0; k < 6; ++k) values.push_back(forces(6 * place_.end + k, column));
  }

 private:
  std::string name_;
  model::SensorPlace place_;
};

class StressSensor final : public Sensor {
 public:
  /// @param has_lines whether there are beams or bars, which alone have an axial stress
  StressSensor(std::string name, const model::SensorPlace& place, const model::WholeBody& whole,
               bool has_lines)
      : name_(std::move(name)), place_(place), whole_(whole), has_lines_(has_lines) {}

  std::vector<Channel> channels() const override {
    const std::string path = "sensors/" + name_;
    if (!has_lines_) return {{path, "Pa", {1}, "von Mises stress of solids", {"mises"}}};
    return {{path, "Pa", {2}, "largest axial and von Mises stress", {"axial", "mises"}}};
  }
  ObservedParts reads() const override {
    if (place_.element >= 0) return {false, {{place_.body, {false, {place_.element}, {}}}}};
    if (!place_.solids.empty()) return {false, {{place_.body, {false, {}, place_.solids}}}};
    ObservedParts out;
    for (int k = 0; k < whole_.count; ++k) out.bodies[whole_.first + k].largest = true;
    return out;
  }
  void append(const Observation& now, std::vector<double>& values) override {
    if (place_.element >= 0) {
      const auto& stresses = now.stresses[static_cast<std::size_t>(place_.body)];
      const Eigen::Index column = now.column_of_line(place_.body, place_.element);
      for (int k = 0; k < 2; ++k) values.push_back(stresses(k, column));
    } else if (!place_.solids.empty()) {
      values.push_back(mean_of_solids(now));
    } else {
      append_largest(now, values);
    }
  }

 private:
  /// Von Mises stress of the mean of the elements around a node.
  double mean_of_solids(const Observation& now) const {
    const auto& stresses = now.solid_stresses[static_cast<std::size_t>(place_.body)];
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (const int e : place_.solids) {
      sum += stresses.col(now.column_of_solid(place_.body, e)).head<6>();
    }
    return fem::mises_stress(sum / static_cast<double>(place_.solids.size()));
  }
  void append_largest(const Observation& now, std::vector<double>& values) const {
    Eigen::Vector2d largest = Eigen::Vector2d::Zero();
    for (int b = whole_.first; b < whole_.first + whole_.count; ++b) {
      const auto known = now.largest.find(b);
      if (known != now.largest.end()) {
        largest = largest.cwiseMax(known->second);
        continue;
      }
      const auto& lines = now.stresses[static_cast<std::size_t>(b)];
      const auto& solids = now.solid_stresses[static_cast<std::size_t>(b)];
      if (lines.cols() > 0) largest = largest.cwiseMax(lines.rowwise().maxCoeff());
      if (solids.cols() > 0) largest[1] = std::max(largest[1], solids.row(fem::kMises).maxCoeff());
    }
    if (has_lines_) values.push_back(largest[0]);
    values.push_back(largest[1]);
  }

  std::string name_;
  model::SensorPlace place_;
  const model::WholeBody& whole_;
  bool has_lines_;
};

class Maker {
 public:
  Maker(const model::BuiltModel& built, std::size_t index)
      : built_(built),
        spec_(built.description.output.sensors[index]),
        place_(built.sensors[index]) {}

  std::unique_ptr<Sensor> operator()(const model::PositionSensor& s) const {
    return marker(s, MarkerQuantity::position, "m", "position");
  }
  std::unique_ptr<Sensor> operator()(const model::DisplacementSensor& s) const {
    return marker(s, MarkerQuantity::displacement, "m", "displacement since t = 0");
  }
  std::unique_ptr<Sensor> operator()(const model::VelocitySensor& s) const {
    return marker(s, MarkerQuantity::velocity, "m/s", "velocity");
  }
  std::unique_ptr<Sensor> operator()(const model::AccelerationSensor& s) const {
    return marker(s, MarkerQuantity::acceleration, "m/s^2", "acceleration");
  }
  std::unique_ptr<Sensor> operator()(const model::RotationSensor& s) const {
    return marker(s, MarkerQuantity::rotation, "rad", "rotation vector since t = 0");
  }
  std::unique_ptr<Sensor> operator()(const model::AngularVelocitySensor& s) const {
    return marker(s, MarkerQuantity::spin, "rad/s", "angular velocity");
  }
  std::unique_ptr<Sensor> operator()(const model::DeflectionSensor&) const {
    return make_deflection_sensor(built_, spec_, place_.markers);
  }
  std::unique_ptr<Sensor> operator()(const model::RelativeSensor& s) const {
    static const char* const units[] = {"m", "m", "m/s", "rad", "rad", "rad/s"};
    Channel channel = vector_channel(spec_.name, units[static_cast<int>(s.quantity)],
                                     "motion of the second marker relative to the first");
    using Q = model::RelativeQuantity;
    if (s.quantity == Q::distance || s.quantity == Q::angle) {
      channel.shape.clear();
      channel.components.clear();
    }
    Vector3d axis = s.axis.value_or(Vector3d::UnitZ());
    if (!s.axis && built_.model.planar) axis = spatial::normal(*built_.model.planar);
    if (s.quantity == Q::angle && !s.axis && !built_.model.planar) {
      throw InputError(spec_.where,
                       fmt::format("sensor \"{}\": the angle needs an `axis` in a model "
                                   "in space, for example [0, 0, 1]",
                                   spec_.name));
    }
    return std::make_unique<RelativeSensor>(channel, s.quantity, place_.markers[0],
                                            place_.markers[1], axis);
  }
  std::unique_ptr<Sensor> operator()(const model::JointForceSensor& s) const {
    return joint(s, false);
  }
  std::unique_ptr<Sensor> operator()(const model::JointTorqueSensor& s) const {
    return joint(s, true);
  }
  std::unique_ptr<Sensor> operator()(const model::JointCoordinateSensor& s) const {
    if (place_.coordinate < 0) {
      throw InputError(spec_.where, fmt::format("sensor \"{}\": joint \"{}\" has no coordinate",
                                                spec_.name, s.joint));
    }
    return make_coordinate_sensor(built_, spec_, static_cast<std::size_t>(place_.coordinate));
  }
  std::unique_ptr<Sensor> operator()(const model::SignalSensor& s) const {
    return make_signal_sensor(built_, spec_, s.signal);
  }
  std::unique_ptr<Sensor> operator()(const model::ContactSensor& s) const {
    return make_contact_sensor(built_, spec_, s.contact);
  }
  std::unique_ptr<Sensor> operator()(const model::CableSensor& s) const {
    return make_cable_sensor(built_, spec_, s.cable);
  }
  std::unique_ptr<Sensor> operator()(const model::GearSensor& s) const {
    return make_gear_sensor(built_, spec_, s.gear);
  }
  std::unique_ptr<Sensor> operator()(const model::BeltSensor& s) const {
    return make_belt_sensor(built_, spec_, s.belt);
  }
  std::unique_ptr<Sensor> operator()(const model::SectionForceSensor&) const {
    if (place_.element < 0) {
      throw InputError(spec_.where, fmt::format("sensor \"{}\": name a section, for example "
                                                "rod/mid, or an `element`",
                                                spec_.name));
    }
    return std::make_unique<SectionForceSensor>(spec_.name, place_);
  }
  std::unique_ptr<Sensor> operator()(const model::StressSensor&) const {
    const auto w = static_cast<std::size_t>(built_.model.whole_of(place_.body));
    const model::WholeBody& whole = built_.model.wholes[w];
    const fem::FeModel* mesh = mesh_of(built_.model, whole);
    const bool has_lines = place_.solids.empty() && !fem::line_elements(*mesh).empty();
    return std::make_unique<StressSensor>(spec_.name, place_, whole, has_lines);
  }
  std::unique_ptr<Sensor> operator()(const model::LoadForceSensor& s) const {
    return make_load_sensor(built_, spec_, s.load, false, place_.markers);
  }
  std::unique_ptr<Sensor> operator()(const model::LoadTorqueSensor& s) const {
    return make_load_sensor(built_, spec_, s.load, true, place_.markers);
  }
  std::unique_ptr<Sensor> operator()(const model::SpringForceSensor& s) const {
    return make_spring_sensor(built_, spec_, s.spring, false);
  }
  std::unique_ptr<Sensor> operator()(const model::SpringTorqueSensor& s) const {
    return make_spring_sensor(built_, spec_, s.spring, true);
  }
  std::unique_ptr<Sensor> operator()(const model::EnergySensor& s) const {
    return make_energy_sensor(built_, spec_, s);
  }

 private:
  Axes axes(std::size_t after) const {
    return Axes(place_.markers.size() > after ? std::optional(place_.markers[after])
                                              : std::nullopt);
  }
  std::unique_ptr<Sensor> marker(const model::MarkerSensor& s, MarkerQuantity quantity,
                                 const char* unit, const char* what) const {
    Channel channel = vector_channel(spec_.name, unit, fmt::format("{} of {}", what, s.of.text));
    std::optional<Vector3d> along;
    if (s.along) {
      along = s.along->normalized();
      channel.shape.clear();
      channel.components.clear();
    }
    return std::make_unique<MarkerSensor>(channel, quantity, place_.markers[0], axes(1), along);
  }
  std::unique_ptr<Sensor> joint(const model::JointForceSensor& s, bool torque) const {
    const auto& joints = built_.model.joints;
    const auto& loads = built_.model.loads;
    const Channel channel = vector_channel(
        spec_.name, torque ? "N m" : "N",
        fmt::format("{} of joint {} on its second marker", torque ? "torque" : "force", s.joint));
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (joints[k].name == s.joint) {
        return std::make_unique<JointSensor>(channel, static_cast<int>(k), -1, torque, axes(0));
      }
    }
    for (std::size_t k = 0; k < loads.size(); ++k) {
      if (loads[k].name == s.joint) {
        return std::make_unique<JointSensor>(channel, -1, static_cast<int>(k), torque, axes(0));
      }
    }
    std::vector<std::string> names;
    for (const auto& j : joints) names.push_back(j.name);
    for (const auto& l : loads) names.push_back(l.name);
    throw InputError(spec_.where,
                     fmt::format("sensor \"{}\": there is no joint \"{}\".{}", spec_.name, s.joint,
                                 base::suggestion(s.joint, names)));
  }

  const model::BuiltModel& built_;
  const model::SensorSpec& spec_;
  const model::SensorPlace& place_;
};

}  // namespace

std::unique_ptr<Sensor> make_sensor(const model::BuiltModel& built, std::size_t index) {
  return std::visit(Maker(built, index), built.description.output.sensors[index].kind);
}

}  // namespace buckens::results

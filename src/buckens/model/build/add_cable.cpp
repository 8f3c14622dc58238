// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_cable.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/cable.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

// Share of m r² below which a body has no rotary inertia.
constexpr double kNoPulleyInertia = 1e-12;

class CableBuilder {
 public:
  CableBuilder(const loads::CableSpec& spec, MarkerFinder& find, Load& load,
               const SourceLocation& where)
      : spec_(spec),
        find_(find),
        load_(load),
        where_(where),
        what_(fmt::format("load \"{}\"", load.name)) {}

  void build() {
    find_markers();
    set_axis();
    for (std::size_t k = 0; k < markers_.size(); ++k) {
      const spatial::Pose X = find_.placed(markers_[k]);
      motions_.push_back({X.p, X.R(), Vector3d::Zero(), Vector3d::Zero()});
      data_.nodes[k].mark = X.R().transpose() * axis_W_.unitOrthogonal();
      if (find_.model().planar) require_one_plane(k);
      require_inertia(k);
    }
    data_.stiffness = spec_.stiffness;
    data_.damping_time = spec_.damping_time;
    try {
      data_.placed = loads::Cable::placed_states(data_, motions_, spec_.pretension, turns_);
    } catch (const InputError& error) {
      throw InputError(where_, fmt::format("{}: {}", what_, error.text()));
    }
    load_.element = std::make_shared<loads::Cable>(data_);
    load_.first = markers_[0];
    load_.second = markers_[1];
    load_.others.assign(markers_.begin() + 2, markers_.end());
  }

 private:
  void add(const base::MarkerRef& ref, double radius, const std::optional<double>& coefficient) {
    markers_.push_back(find_.marker(ref, true));
    data_.nodes.push_back({radius, Vector3d::UnitX(), coefficient});
    if (radius != 0.0) find_.require_moment(markers_.back(), what_, where_);
  }

  void find_markers() {
    data_.is_closed = !spec_.ends;
    const bool on_first = is_drum(0, spec_.pulleys.front());
    const bool on_last = is_drum(1, spec_.pulleys.back());
    if (spec_.ends && !on_first) add((*spec_.ends)[0], 0.0, {});
    data_.first_pulley = markers_.size();
    for (const loads::CablePulleySpec& pulley : spec_.pulleys) {
      const bool is_end = (on_first && &pulley == &spec_.pulleys.front()) ||
                          (on_last && &pulley == &spec_.pulleys.back());
      if (!is_end) turns_.push_back(pulley.turns);
      add(pulley.on, pulley.side == loads::PulleySide::left ? pulley.radius : -pulley.radius,
          pulley.coefficient ? pulley.coefficient : spec_.coefficient);
    }
    if (spec_.ends && !on_last) add((*spec_.ends)[1], 0.0, {});
    if (markers_.size() > 1) return;
    throw InputError(where_, fmt::format("{}: both its ends are on the same drum; give it another "
                                         "end",
                                         what_));
  }

  /// Whether an end is fixed to the rim of the pulley beside it.
  bool is_drum(std::size_t end, const loads::CablePulleySpec& pulley) const {
    return spec_.ends && (*spec_.ends)[end].text == pulley.on.text;
  }

  void set_axis() {
    const MarkerId& first = markers_[data_.first_pulley];
    const Eigen::Matrix3d R = find_.placed(first).R();
    data_.axis = find_.axis_or_normal(spec_.axis, R, what_, where_).normalized();
    axis_W_ = R * data_.axis;
    find_.require_across_plane(axis_W_, "the pulleys", what_, where_);
  }

  void require_one_plane(std::size_t k) const {
    const double apart = std::abs(axis_W_.dot(motions_[k].p - motions_[0].p));
    if (apart <= 1e-9 * find_.model().length) return;
    throw InputError(where_, fmt::format("{}: {} and {} are {:.4g} m apart in the direction normal "
                                         "to the plane of the model; place them in one plane",
                                         what_, markers_[0].text, markers_[k].text, apart));
  }

  /// What it pulls beside the mass centre, or drives by its rim, it turns.
  void require_inertia(std::size_t k) const {
    const MarkerId& id = markers_[k];
    if (id.body == kGround) return;
    const auto b = static_cast<std::size_t>(id.body);
    const body::Body& body = find_.model().bodies[b];
    if (body.is_flexible()) return;
    const double arm = std::max(std::abs(data_.nodes[k].radius) *
                                    (data_.nodes[k].coefficient.value_or(1.0) > 0.0 ? 1.0 : 0.0),
                                body.markers[static_cast<std::size_t>(id.marker)].X_BF.p.norm());
    if (arm == 0.0) return;
    const Vector3d axis = find_.model().placed[b].R().transpose() * axis_W_;
    if (axis.dot(body.J0 * axis) > kNoPulleyInertia * body.mass * arm * arm) return;
    throw ModelError(where_, fmt::format("{}: it turns body \"{}\", which has no rotary inertia; "
                                         "give it an `inertia`",
                                         what_, body.name));
  }

  const loads::CableSpec& spec_;
  MarkerFinder& find_;
  Load& load_;
  const SourceLocation& where_;
  std::string what_;
  std::vector<MarkerId> markers_;
  std::vector<int> turns_;  // around the pulleys between the ends
  std::vector<spatial::MarkerMotion> motions_;
  Vector3d axis_W_ = Vector3d::UnitZ();
  loads::CableData data_;
};

}  // namespace

void set_cable(const loads::CableSpec& spec, MarkerFinder& find, Load& load,
               const SourceLocation& where) {
  CableBuilder(spec, find, load, where).build();
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/cable_span.h"
#include "buckens/loads/capstan_slip.h"
#include "buckens/spatial/counted_value.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

// A wrap below this is that of a cable that just touches its pulley [rad].
constexpr double kTouchingWrap = 1e-6;
// Of each pulley: angle from the arriving and the leaving span, wrap, slip and its rate, and the
// rates of both angles; then ℓ of each span, the instant, and of open cables the angles of both
// ends and their rates, 0 without a drum.
constexpr std::size_t kArriving = 0, kLeaving = 1, kWrap = 2, kSlip = 3, kSlipRate = 4,
                      kArrivingRate = 5, kLeavingRate = 6, kOfPulley = 7;
constexpr int kOfEnds = 4;
// Instants closer than this share of the time are one, computed in two ways.
constexpr double kOneInstant = 1e-13;

double turned_about(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

}  // namespace

/// Geometry and forces at one instant.
struct Cable::Stand {
  Vector3d axis;
  std::array<CableSpan, kMostNodes> spans;
  std::array<double, kMostNodes> arriving{}, leaving{}, wrap{};  // of pulleys [rad]
  std::array<double, kMostNodes> arriving_rate{}, leaving_rate{};
  double h = 0;                                // of the step so far [s]
  CapstanSlip::Values slip_rate{};             // over pulleys [m/s]
  double first_angle = 0, last_angle = 0;      // of drums [rad]
  double first_rate = 0, last_rate = 0;        // of them
  std::array<double, kMostNodes> rate{};       // of the elongation while nothing slips [m/s]
  std::array<double, kMostNodes> turns{};      // of the span about the axis [rad/s]
  std::array<double, kMostNodes> free{};       // ℓ, after slip [m]
  std::array<double, kMostNodes> free_rate{};  // of ℓ while nothing slips [m/s]
  CapstanSlip slip;
};

Cable::Cable(CableData data) : data_(std::move(data)) {}

bool Cable::may_slip() const {
  return std::any_of(data_.nodes.begin(), data_.nodes.end(),
                     [](const CableNode& node) { return node.coefficient.has_value(); });
}

int Cable::num_states() const {
  return static_cast<int>(kOfPulley * num_pulleys() + num_spans()) +
         (data_.is_closed ? 1 : 1 + kOfEnds);
}

namespace {

const spatial::MarkerMotion& motion_of(const Sight& sight, std::size_t node) {
  return node == 0 ? sight.first : node == 1 ? sight.second : sight.others[node - 2];
}

/// Twist of a marker, as rows are multiplied with.
double rate_by(const TwistRow& row, const spatial::MarkerMotion& motion) {
  return row.head<3>().dot(motion.w) + row.tail<3>().dot(motion.v);
}

/// How fast a pulley turns against a span.
double turning_of(const spatial::MarkerMotion& pulley, const Vector3d& axis, double span_turns) {
  return axis.dot(pulley.w) - span_turns;
}

/// Angle of a pulley's mark from where a span touches it.
double mark_angle(const CableNode& node, const spatial::MarkerMotion& motion, const CableSpan& span,
                  const Vector3d& axis) {
  const Vector3d touched = node.radius > 0.0 ? Vector3d(-span.left) : span.left;
  return turned_about(axis, touched, motion.R * node.mark);
}

}  // namespace

void Cable::wind_ends(const Sight& sight, const double* states, Stand& s) const {
  if (data_.is_closed) return;
  const std::size_t last = last_node();
  const double* const angles = states + kOfPulley * num_pulleys() + num_spans() + 1;
  const CableNode &first_drum = data_.nodes[0], &last_drum = data_.nodes[last];
  if (first_drum.radius != 0.0) {
    s.first_angle = mark_angle(first_drum, motion_of(sight, 0), s.spans[0], s.axis);
    s.first_rate = turning_of(motion_of(sight, 0), s.axis, s.turns[0]);
    s.free[0] += first_drum.radius * spatial::way_turned(angles[0], s.first_angle, s.h * angles[2]);
  }
  if (last_drum.radius != 0.0) {
    s.last_angle = mark_angle(last_drum, motion_of(sight, last), s.spans[last - 1], s.axis);
    s.last_rate = turning_of(motion_of(sight, last), s.axis, s.turns[last - 1]);
    s.free[last - 1] -=
        last_drum.radius * spatial::way_turned(angles[1], s.last_angle, s.h * angles[3]);
  }
}

void Cable::find_spans(const Sight& sight, const double* states, Stand& s) const {
  const std::size_t nodes = data_.nodes.size();
  s.axis = motion_of(sight, data_.first_pulley).R * data_.axis;
  for (std::size_t j = 0; j < num_spans(); ++j) {
    const std::size_t next = (j + 1) % nodes;
    const auto& from = motion_of(sight, j);
    const auto& to = motion_of(sight, next);
    s.spans[j] =
        CableSpan::between(from, data_.nodes[j].radius, to, data_.nodes[next].radius, s.axis);
    if (!s.spans[j].exists()) {
      throw NumericalError(
          fmt::format("its span {} cannot be formed: the pulleys or ends on both sides of it have "
                      "come within {:.6g} m of each other; look at what holds them",
                      j + 1, s.spans[j].centres));
    }
    s.rate[j] = rate_by(s.spans[j].on_from, from) + rate_by(s.spans[j].on_to, to);
    s.free[j] = states[kOfPulley * num_pulleys() + j];
    s.turns[j] = s.spans[j].turn_rate(from, to);
    s.free_rate[j] = s.spans[j].length_rate(from, to) - s.rate[j];
  }
}

void Cable::wind_pulleys(const Sight& sight, const double* states, Stand& s) const {
  const std::size_t nodes = data_.nodes.size();
  for (std::size_t i = 0; i < num_pulleys(); ++i) {
    const std::size_t k = node_of(i), before = (k + nodes - 1) % nodes;
    const double* own = states + kOfPulley * i;
    const CableNode& node = data_.nodes[k];
    const auto& motion = motion_of(sight, k);
    s.arriving[i] = mark_angle(node, motion, s.spans[before], s.axis);
    s.leaving[i] = mark_angle(node, motion, s.spans[k], s.axis);
    s.arriving_rate[i] = turning_of(motion, s.axis, s.turns[before]);
    s.leaving_rate[i] = turning_of(motion, s.axis, s.turns[k]);
    s.free[before] -=
        node.radius * spatial::way_turned(own[kArriving], s.arriving[i], s.h * own[kArrivingRate]);
    s.free[k] +=
        node.radius * spatial::way_turned(own[kLeaving], s.leaving[i], s.h * own[kLeavingRate]);
    const double sense = node.radius > 0.0 ? 1.0 : -1.0;
    const double seen = sense * turned_about(s.axis, s.spans[before].along, s.spans[k].along);
    s.wrap[i] = own[kWrap] + spatial::way_turned(own[kWrap], seen, 0.0);
    if (s.wrap[i] < -kTouchingWrap) {
      throw NumericalError(fmt::format(
          "it has left its pulley {}, around which it would run the other way; look at the "
          "motion, or leave the pulley out",
          i + 1));
    }
  }
}

void Cable::set_tensions(const double* states, Stand& s) const {
  s.slip.reset(num_spans(), num_pulleys(), data_.is_closed);
  // Before anything can slip, what slips goes on as it did.
  for (std::size_t i = 0; i < num_pulleys() && s.h == 0.0; ++i) {
    s.slip_rate[i] = states[kOfPulley * i + kSlipRate];
  }
  for (std::size_t j = 0; j < num_spans(); ++j) {
    if (!(s.free[j] > 0.0)) {
      throw NumericalError(fmt::format(
          "its span {} has been wound up whole; look at what turns its pulleys", j + 1));
    }
    const double k = data_.stiffness / s.free[j], c = data_.damping_time * k;
    s.slip.set_span(j, k, s.h > 0.0 ? c / s.h : 0.0, k * (s.spans[j].length - s.free[j]),
                    c * (s.rate[j] + s.slip.of_spans(s.slip_rate, j)));
  }
}

Cable::Stand Cable::look(const Sight& sight) const {
  if (sight.others.size() + 2 != data_.nodes.size()) {
    throw NumericalError("a cable was asked for without its markers");
  }
  Stand s;
  const double* states = sight.states != nullptr ? sight.states : data_.placed.data();
  const double started = states[kOfPulley * num_pulleys() + num_spans()];
  const bool has_begun = sight.states != nullptr && sight.t - started > kOneInstant * sight.t;
  s.h = has_begun ? sight.t - started : 0.0;
  find_spans(sight, states, s);
  wind_pulleys(sight, states, s);
  wind_ends(sight, states, s);
  set_tensions(states, s);
  if (!may_slip()) return s;
  for (std::size_t i = 0; i < num_pulleys(); ++i) {
    const std::optional<double>& coefficient = data_.nodes[node_of(i)].coefficient;
    if (coefficient) s.slip.set_pulley(i, std::exp(*coefficient * std::max(0.0, s.wrap[i])));
  }
  if (!s.slip.solve()) {
    throw NumericalError(
        "its tensions found no balance by slipping over the pulleys; make spans less different in "
        "length, or give some pulleys no `friction`");
  }
  for (std::size_t j = 0; j < num_spans(); ++j) s.free[j] -= s.slip.lengthened(j);
  for (std::size_t i = 0; i < num_pulleys() && s.h > 0.0; ++i) {
    s.slip_rate[i] = s.slip.slipped(i) / s.h;
  }
  return s;
}

Action Cable::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                       const spatial::MarkerMotion& /*second*/) const {
  return {};
}

namespace {

/// Adds what a span does to its two markers.
template <class Add>
void add_pull(const CableSpan& span, double tension, std::size_t from, std::size_t to, Add&& add) {
  const auto wrench = [&](const TwistRow& row) {
    return spatial::Wrench{-tension * row.head<3>().transpose(),
                           -tension * row.tail<3>().transpose()};
  };
  add(from, wrench(span.on_from));
  add(to, wrench(span.on_to));
}

}  // namespace

Action Cable::respond(const Sight& sight) const {
  const Stand s = look(sight);
  const std::size_t nodes = data_.nodes.size();
  Action out;
  for (std::size_t j = 0; j < num_spans(); ++j) {
    const double tension = s.slip.tension(j);
    add_pull(s.spans[j], tension, j, (j + 1) % nodes,
             [&](std::size_t node, const spatial::Wrench& wrench) {
               if (node == 0) out.on_first += wrench;
               if (node == 1) out.on_second += wrench;
             });
    const double elastic = std::max(0.0, s.slip.elastic(j));
    const double k = data_.stiffness / s.free[j];
    out.stored_energy += 0.5 * elastic * elastic / k;
    // What is taken in or given out carries its strain along.
    const double carried = 0.5 * elastic * elastic / data_.stiffness;
    const double slip_rate = s.slip.of_spans(s.slip_rate, j);
    out.active_power += elastic * (s.rate[j] + slip_rate) - tension * s.rate[j] -
                        carried * (s.free_rate[j] - slip_rate);
  }
  out.dissipation = -out.active_power;
  out.regime = s.slip.regime();
  return out;
}

void Cable::add_to_others(const Sight& sight, std::span<spatial::Wrench> wrenches) const {
  const Stand s = look(sight);
  for (std::size_t j = 0; j < num_spans(); ++j) {
    add_pull(s.spans[j], s.slip.tension(j), j, (j + 1) % data_.nodes.size(),
             [&](std::size_t node, const spatial::Wrench& wrench) {
               if (node >= 2) wrenches[node - 2] += wrench;
             });
  }
}

void Cable::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const Stand s = look(sight);
  const std::size_t nodes = data_.nodes.size();
  for (std::size_t j = 0; j < num_spans(); ++j) {
    SoftRow row;
    const std::size_t next = (j + 1) % nodes;
    if (j == 0) row.J.segment<6>(0) += s.spans[j].on_from;
    if (j == 1) row.J.segment<6>(6) += s.spans[j].on_from;
    if (next == 0) row.J.segment<6>(0) += s.spans[j].on_to;
    if (next == 1) row.J.segment<6>(6) += s.spans[j].on_to;
    row.stiffness = s.slip.taut_stiffness(j);
    row.damping = data_.damping_time * row.stiffness;
    rows.push_back(row);
  }
}

bool Cable::mix_rows(const Sight& sight, RowMix& mix) const {
  if (!may_slip()) return false;
  const Stand s = look(sight);
  if (!s.slip.has_slipped()) return false;
  mix = s.slip.mix();
  return true;
}

void Cable::append_others_of_rows(const Sight& sight, std::vector<TwistRow>& rows) const {
  const Stand s = look(sight);
  const std::size_t nodes = data_.nodes.size();
  for (std::size_t j = 0; j < num_spans(); ++j) {
    const std::size_t first = rows.size(), next = (j + 1) % nodes;
    rows.resize(first + nodes - 2, TwistRow::Zero());
    if (j >= 2) rows[first + j - 2] += s.spans[j].on_from;
    if (next >= 2) rows[first + next - 2] += s.spans[j].on_to;
  }
}

void Cable::start_states(const Sight& sight, double* states) const {
  Sight placed = sight;
  placed.states = data_.placed.data();
  find_states(placed, states);
}

void Cable::require_followed(std::size_t pulley, const double* before, const Stand& s) {
  for (const auto& [old, now] : {std::pair(before[kArrivingRate], s.arriving_rate[pulley]),
                                 std::pair(before[kLeavingRate], s.leaving_rate[pulley])}) {
    const spatial::CountedValue then{0, 0, old, 0}, at_end{0, 0, now, s.h};
    if (spatial::is_countable(then, at_end, spatial::kTurn)) continue;
    spatial::require_countable(then, at_end, spatial::kTurn,
                               fmt::format("the speed of its pulley {}", pulley + 1));
  }
}

void Cable::find_states(const Sight& sight, double* states) const {
  const Stand s = look(sight);
  const double* before = sight.states != nullptr ? sight.states : data_.placed.data();
  const bool is_step = before != data_.placed.data() && s.h > 0.0;
  for (std::size_t i = 0; i < num_pulleys(); ++i) {
    const double slip = before[kOfPulley * i + kSlip] + s.slip.slipped(i);
    double* own = states + kOfPulley * i;
    if (is_step) require_followed(i, before + kOfPulley * i, s);
    own[kArrivingRate] = s.arriving_rate[i];
    own[kLeavingRate] = s.leaving_rate[i];
    own[kArriving] = s.arriving[i];
    own[kLeaving] = s.leaving[i];
    own[kWrap] = s.wrap[i];
    own[kSlip] = slip;
    own[kSlipRate] = s.slip_rate[i];
  }
  for (std::size_t j = 0; j < num_spans(); ++j) {
    states[kOfPulley * num_pulleys() + j] = s.free[j];
  }
  states[kOfPulley * num_pulleys() + num_spans()] = sight.t;
  if (data_.is_closed) return;
  double* const angles = states + kOfPulley * num_pulleys() + num_spans() + 1;
  if (is_step) {
    const double* const old = before + kOfPulley * num_pulleys() + num_spans() + 1;
    spatial::require_countable({0, 0, old[2], 0}, {0, 0, s.first_rate, s.h}, spatial::kTurn,
                               "the speed of its first drum");
    spatial::require_countable({0, 0, old[3], 0}, {0, 0, s.last_rate, s.h}, spatial::kTurn,
                               "the speed of its last drum");
  }
  angles[0] = s.first_angle;
  angles[1] = s.last_angle;
  angles[2] = s.first_rate;
  angles[3] = s.last_rate;
}

CableReading Cable::read(const Sight& sight) const {
  const Stand s = look(sight);
  const double* before = sight.states != nullptr ? sight.states : data_.placed.data();
  CableReading out;
  for (std::size_t j = 0; j < num_spans(); ++j) out.tensions.push_back(s.slip.tension(j));
  for (std::size_t i = 0; i < num_pulleys(); ++i) {
    out.wraps.push_back(s.wrap[i]);
    out.slips.push_back(before[kOfPulley * i + kSlip] + s.slip.slipped(i));
  }
  return out;
}

std::vector<double> Cable::placed_states(const CableData& data,
                                         std::span<const spatial::MarkerMotion> markers,
                                         double pretension, std::span<const int> turns) {
  const Cable cable(data);
  const std::size_t nodes = data.nodes.size(), pulleys = cable.num_pulleys();
  const Vector3d axis = markers[data.first_pulley].R * data.axis;
  std::vector<double> out(static_cast<std::size_t>(cable.num_states()), 0.0);
  std::vector<CableSpan> spans;
  for (std::size_t j = 0; j < cable.num_spans(); ++j) {
    const std::size_t next = (j + 1) % nodes;
    spans.push_back(CableSpan::between(markers[j], data.nodes[j].radius, markers[next],
                                       data.nodes[next].radius, axis));
    if (!spans[j].exists()) {
      throw InputError(
          {},
          fmt::format("its span {} cannot be formed: the centres on both sides of it are {:.6g} "
                      "m apart across the axis, more than {:.6g} m are needed; place them "
                      "apart, or look at `side` and `radius` of its pulleys",
                      j + 1, spans[j].centres,
                      std::abs(data.nodes[next].radius - data.nodes[j].radius)));
    }
    out[kOfPulley * pulleys + j] = spans[j].length / (1.0 + pretension / data.stiffness);
  }
  for (std::size_t i = 0; i < pulleys; ++i) {
    const std::size_t k = cable.node_of(i), before = (k + nodes - 1) % nodes;
    const CableNode& node = data.nodes[k];
    out[kOfPulley * i + kArriving] = mark_angle(node, markers[k], spans[before], axis);
    out[kOfPulley * i + kLeaving] = mark_angle(node, markers[k], spans[k], axis);
    const double sense = node.radius > 0.0 ? 1.0 : -1.0;
    double wrap = sense * turned_about(axis, spans[before].along, spans[k].along);
    if (wrap < -kTouchingWrap) wrap += spatial::kTurn;
    out[kOfPulley * i + kWrap] = wrap + spatial::kTurn * turns[i];
  }
  if (data.is_closed) return out;
  const std::size_t last = nodes - 1, at = kOfPulley * pulleys + spans.size() + 1;
  if (data.nodes[0].radius != 0.0) {
    out[at] = mark_angle(data.nodes[0], markers[0], spans[0], axis);
  }
  if (data.nodes[last].radius != 0.0) {
    out[at + 1] = mark_angle(data.nodes[last], markers[last], spans[last - 1], axis);
  }
  return out;
}

std::vector<Vector3d> Cable::span_ends(const CableData& data,
                                       std::span<const spatial::MarkerMotion> markers) {
  const std::size_t nodes = data.nodes.size();
  const Vector3d axis = markers[data.first_pulley].R * data.axis;
  std::vector<Vector3d> out;
  for (std::size_t j = 0; j + (data.is_closed ? 0 : 1) < nodes; ++j) {
    const std::size_t next = (j + 1) % nodes;
    const CableSpan span = CableSpan::between(markers[j], data.nodes[j].radius, markers[next],
                                              data.nodes[next].radius, axis);
    out.push_back(markers[j].p - data.nodes[j].radius * span.left);
    out.push_back(markers[next].p - data.nodes[next].radius * span.left);
  }
  return out;
}

}  // namespace buckens::loads

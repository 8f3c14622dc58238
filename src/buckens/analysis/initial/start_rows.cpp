// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/start_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/simulation/turn.h"
#include "buckens/dynamics/travel.h"

namespace buckens::analysis {

namespace {

// Longest way at once: as angle [rad], and as a share of the model's length.
constexpr double kStageAngle = 0.3;
constexpr double kStageShare = 0.05;

}  // namespace

StartRows::StartRows(const model::Model& model, const std::vector<model::StartCoordinate>& starts,
                     Held held, const std::vector<dynamics::BodyMotion>& as_placed)
    : model_(model), held_(held) {
  for (const model::StartCoordinate& start : starts) {
    if (held == Held::values ? !start.value : !start.rate) continue;
    starts_.push_back(start);
    from_.push_back(look(start, as_placed).value);
  }
}

bool StartRows::is_angle(const model::StartCoordinate& start) const {
  const auto index = static_cast<std::size_t>(start.coordinate);
  return model_.coordinates[index].law.is_angle();
}

StartRows::Seen StartRows::look(const model::StartCoordinate& start,
                                const std::vector<dynamics::BodyMotion>& motions,
                                const model::RowMemory* memory) const {
  const model::Coordinate& own = model_.coordinates[static_cast<std::size_t>(start.coordinate)];
  if (const model::Joint* slider = dynamics::slider_of(model_, own)) {
    // At the nearest point changes of s do not change g: its own derivative is the row of a drive
    // along the beam.
    const dynamics::Travel travel(model_, *slider, motions, memory);
    Seen out{travel.displacement(), travel.rate(), {}};
    travel.derive({0.0, 0.0, travel.along()}, slider->first_row, out.row);
    return out;
  }
  const auto first = dynamics::evaluate_marker(model_, own.first, motions);
  const auto second = dynamics::evaluate_marker(model_, own.second, motions);
  const spatial::PairRow J = own.law.derivatives(first.motion, second.motion);
  Eigen::Matrix<double, 12, 1> V;
  V << first.motion.w, first.motion.v, second.motion.w, second.motion.v;
  return {own.law.fraction(first.motion, second.motion), J.dot(V),
          dynamics::system_row(model_, own.first, first, own.second, second, J)};
}

int StartRows::stages() const {
  double most = 1.0;
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const double way = std::abs(*starts_[k].value - from_[k]);
    most = std::max(most, way / (is_angle(starts_[k]) ? kStageAngle : kStageShare * model_.length));
  }
  return static_cast<int>(std::ceil(std::min(most, 1e6)));
}

void StartRows::append(const std::vector<dynamics::BodyMotion>& motions, double share,
                       const model::RowMemory& memory, dynamics::Constraints& out) const {
  const Eigen::Index before = out.g.size();
  const auto count = static_cast<Eigen::Index>(starts_.size());
  for (linalg::Vector* v : {&out.g, &out.g_dot, &out.g_t}) {
    v->conservativeResize(before + count);
    v->tail(count).setZero();
  }
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const Seen seen = look(starts_[k], motions, &memory);
    const auto row = before + static_cast<Eigen::Index>(k);
    if (held_ == Held::rates) {
      out.g_dot[row] = seen.rate - *starts_[k].rate;
    } else {
      const double open = seen.value - (from_[k] + share * (*starts_[k].value - from_[k]));
      out.g[row] = is_angle(starts_[k]) ? std::remainder(open, kTurn) : open;
    }
    out.rows.push_back(seen.row);
  }
}

void StartRows::append_lengths(linalg::Vector& out) const {
  const Eigen::Index before = out.size();
  out.conservativeResize(before + static_cast<Eigen::Index>(starts_.size()));
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    out[before + static_cast<Eigen::Index>(k)] = is_angle(starts_[k]) ? 1.0 : model_.length;
  }
}

std::string StartRows::describe(const std::vector<dynamics::BodyMotion>& motions) const {
  std::vector<std::string> out;
  for (const model::StartCoordinate& start : starts_) {
    const Seen seen = look(start, motions);
    const auto index = static_cast<std::size_t>(start.coordinate);
    const auto joint = static_cast<std::size_t>(model_.coordinates[index].joint);
    const double wanted = asked(start);
    double found = held_ == Held::values ? seen.value : seen.rate;
    if (held_ == Held::values && is_angle(start)) {
      found = wanted + std::remainder(found - wanted, kTurn);
    }
    out.push_back(fmt::format("\"{}\" at {:.6g} {}{} where {:.6g} was requested",
                              model_.joints[joint].name, found, is_angle(start) ? "rad" : "m",
                              held_ == Held::values ? "" : "/s", wanted));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

void count_start_turns(const std::vector<model::StartCoordinate>& starts, const model::Model& model,
                       model::RowMemory& memory) {
  for (const model::StartCoordinate& start : starts) {
    const auto index = static_cast<std::size_t>(start.coordinate);
    const bool is_angle = model.coordinates[index].law.is_angle();
    if (!is_angle || !start.value) continue;
    joints::CountedValue& counted = memory.coordinates[index];
    counted.turns = static_cast<int>(std::lround((*start.value - counted.fraction) / kTurn));
  }
}

}  // namespace buckens::analysis

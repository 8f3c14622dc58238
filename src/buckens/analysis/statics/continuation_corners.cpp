// SPDX-License-Identifier: Apache-2.0
// How a path goes around a corner: where a one-sided row opens or closes.
#include <algorithm>
#include <cmath>

#include "buckens/analysis/statics/continuation.h"
#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/state.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {

// A row that changes within so many full steps may be what ends them.
constexpr double kNearCorner = 0.1;

}  // namespace

StaticContinuation::Corner StaticContinuation::nearest_corner(const PathPoint& at) {
  system_->linearise(at.point, at.balance);
  Corner out;
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    if (rest_[k].kind != RestRow::Kind::one_sided) continue;
    const CornerValue now = corner_value(k, at.point, at.balance);
    const double rate = now.slope.dot(at.direction);
    const double ahead = rate < 0.0 ? now.value / -rate : HUGE_VAL;
    if (ahead < out.ahead) out = {k, ahead};
  }
  return out;
}

StaticContinuation::CornerValue StaticContinuation::corner_value(
    std::size_t row, const StaticPoint& point, const StaticBalance& balance) const {
  const loads::RowStand& stand = point.rest[row];
  if (stand.regime != 0) {
    const double sign = rest_.push(row, {stand.regime, 1.0});
    return {sign * system_->scaled_force(row, stand.force), sign * system_->force_slope(row)};
  }
  const loads::RigidLaw::Contact& contact = balance.rest.contacts[row];
  return {system_->scaled_gap(row, contact.gap), contact.sign * system_->gap_slope(row)};
}

std::optional<PathPoint> StaticContinuation::around_corner(const PathPoint& found) {
  if (scale_.load_control || found.direction.size() == 0) return std::nullopt;
  const PathPoint at = fitted(found);
  const Corner corner = nearest_corner(at);
  if (corner.ahead > kNearCorner) return std::nullopt;
  const int n = system_->size();
  PathPoint out = at;
  for (int iteration = 0;; ++iteration) {
    out.balance = system_->balance(out.point);
    system_->linearise(out.point, out.balance);
    const Vector residual = system_->residual(out.point, out.balance);
    const CornerValue here = corner_value(corner.row, out.point, out.balance);
    const bool is_there = std::abs(here.value) <= closed_share(model_, out.point);
    if (is_there && is_balanced(out.point, out.balance, residual)) break;
    if (iteration == kMaxIterations ||
        !factorise(out.point, load_derivative(out.point), {here.slope, 0.0}, StaticSystem::kGive)) {
      return std::nullopt;
    }
    Vector step(n + 1);
    step << -residual, -here.value;
    lu_->solve_in_place(step);
    if (!step.allFinite() || motion(step.head(n)) > scale_.motion) return std::nullopt;
    out.point = moved(out.point, step);
  }
  // Beyond, the row does what it did not, and ever more of it.
  loads::RowStand& stand = out.point.rest[corner.row];
  stand = {stand.regime != 0 ? 0 : out.balance.rest.contacts[corner.row].regime, 0.0};
  rest_.follow_contacts(out.balance.rest, out.point.rest);
  out.balance = system_->balance(out.point);
  const CornerValue beyond = corner_value(corner.row, out.point, out.balance);
  if (!factorise(out.point, load_derivative(out.point), {beyond.slope, 0.0}, StaticSystem::kGive) ||
      !lead_on(out)) {
    return std::nullopt;
  }
  out.position = at.position + std::max(corner.ahead, 0.0);
  return out;
}

}  // namespace buckens::analysis

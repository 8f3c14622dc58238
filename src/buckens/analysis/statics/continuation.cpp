// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/continuation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

using linalg::Vector;
using Share = StaticSystem::Share;

StaticContinuation::StaticContinuation(const model::Model& model,
                                       const dynamics::MassMetric& metric, RestRows& rest,
                                       const std::vector<const ElasticCompliance*>& compliance,
                                       double t, const PathScale& scale, double force)
    : model_(model),
      metric_(metric),
      rest_(rest),
      compliance_(compliance),
      t_(t),
      scale_(scale),
      force_(force) {
  force_rounding_ =
      spring_rounding(model_, dynamics::motions_of(model_, model::placed_state(model_)));
}

void StaticContinuation::choose_rows(const StaticPoint& point) {
  StaticSystem all(model_, rest_, compliance_, {}, t_, force_);
  const std::vector<int> rows = metric_.split(all.balance(point).constraints.rows).independent;
  system_.emplace(model_, rest_, compliance_, rows, t_, force_);
  lu_.reset();
}

bool StaticContinuation::follow_pairs(const StaticPoint& from, const StaticPoint& to, bool keeps) {
  if (!rest_.follow_pairs(motions_towards(model_, from, to), keeps)) return false;
  const std::vector<int> rows = system_->rows_in_use();
  system_.emplace(model_, rest_, compliance_, rows, t_, force_);
  lu_.reset();
  return true;
}

void StaticContinuation::fit(StaticPoint& point) const {
  if (point.order == rest_.order()) return;
  point.rest = rest_.carried(point.order, point.rest);
  point.order = rest_.order();
}

void StaticContinuation::fit(PathPoint& at) const {
  if (at.point.order == rest_.order()) return;
  if (at.direction.size() > 0) {  // its rows stand last
    const std::vector<int> places = rest_.places_in(at.point.order);
    const auto others = at.direction.size() - static_cast<Eigen::Index>(at.point.rest.size());
    Vector direction = Vector::Zero(others + static_cast<Eigen::Index>(rest_.size()));
    direction.head(others) = at.direction.head(others);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (places[k] < 0) continue;
      direction[others + static_cast<Eigen::Index>(k)] = at.direction[others + places[k]];
    }
    at.direction = std::move(direction);
  }
  fit(at.point);
  at.balance = system_->balance(at.point);
}

PathPoint StaticContinuation::fitted(const PathPoint& at) const {
  PathPoint out = at;
  fit(out);
  return out;
}

StaticPoint StaticContinuation::predicted(PathPoint& from, double step, bool keeps) {
  fit(from);
  for (;; keeps = true) {
    Vector prediction(system_->size() + 1);
    prediction << step * from.direction, step * from.load_rate / scale_.load_factor;
    StaticPoint out = moved(from.point, prediction);
    if (!follow_pairs(from.point, out, keeps)) return out;
    fit(from);
  }
}

void StaticContinuation::look_around(PathPoint& at) {
  if (at.direction.size() > 0) predicted(at, 1.0, false);
}

double StaticContinuation::motion(const Vector& x) const {
  double size = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const Eigen::Matrix<double, 6, 1> u = system_->frame_step(b, x);
    size = std::max({size, u.head<3>().norm(), u.tail<3>().norm() / model_.length});
  }
  return std::max(size, system_->largest(x, Share::elastic));
}

double StaticContinuation::misfit(const Vector& residual) const {
  return std::max({system_->largest(residual, Share::frame),
                   system_->largest(residual, Share::joint),
                   system_->largest(residual, Share::elastic)});
}

bool StaticContinuation::is_balanced(const StaticPoint& point, const StaticBalance& balance,
                                     const Vector& residual) const {
  const double largest = std::max(force_, strongest_load(model_, rest_, point, t_));
  const double tolerance = kForceTolerance * largest + force_rounding_;
  return force_ * system_->largest(residual, Share::frame) <= tolerance &&
         rest_.deepest(balance.rest, point.rest) <= closed_share(model_, point) &&
         rest_.strongest_pull(point.rest) <= tolerance &&
         system_->largest(residual, Share::joint) <= closed_share(model_, point) &&
         system_->largest(residual, Share::elastic) <=
             kForceTolerance * system_->largest_deformation(point) + 1e-15;
}

StaticContinuation::Plane StaticContinuation::load_plane() const {
  return {Vector::Zero(system_->size()), 1.0 / scale_.load_factor};
}

StaticContinuation::Plane StaticContinuation::plane(const PathPoint& at) const {
  if (scale_.load_control) return load_plane();
  // Multipliers are excluded: their size says nothing about how far a mechanism has moved.
  Plane out{at.direction, at.load_rate / (scale_.load_factor * scale_.load_factor)};
  for (int k = 0; k < system_->size(); ++k) {
    if (system_->share(k) == Share::joint) out.x[k] = 0.0;
  }
  const double square = out.x.squaredNorm();
  const double share = motion(at.direction) / scale_.motion;
  if (square > 0.0) out.x *= share * share / square;
  return out;
}

StaticPoint StaticContinuation::moved(const StaticPoint& point, const Vector& step) const {
  StaticPoint out = system_->moved(point, step.head(system_->size()));
  out.load_factor += scale_.load_factor * step[system_->size()];
  return out;
}

PathPoint StaticContinuation::begin(const StaticPoint& start, double sign) {
  choose_rows(start);
  Plane along = load_plane();
  along.load_factor *= sign;
  std::optional<PathPoint> out = correct(start, along, kFarFromPrediction);
  if (!out || out->direction.size() == 0) {
    throw NumericalError(fmt::format(
        "static path: it cannot be continued from its start at load factor {:.6g} ({}); start at "
        "another load factor",
        start.load_factor, resisting_.empty() ? "a limit point or a mechanism" : resisting_));
  }
  return std::move(*out);
}

std::optional<PathPoint> StaticContinuation::with_new_rows(const PathPoint& found) {
  const PathPoint at = fitted(found);
  choose_rows(at.point);
  PathPoint from = at;
  // Dropped rows exert no force; Newton redistributes theirs.
  for (int k = 0; k < model_.num_constraint_rows(); ++k) {
    const std::vector<int>& rows = system_->rows_in_use();
    if (!std::binary_search(rows.begin(), rows.end(), k)) from.point.lambda[k] = 0.0;
  }
  return at_load_factor(from, at.point.load_factor);
}

std::optional<PathPoint> StaticContinuation::ahead(const PathPoint& found, double step,
                                                   bool may_branch) {
  PathPoint from = found;
  StaticPoint prediction = predicted(from, step, true);
  Plane along = plane(from);
  if (scale_.load_control) along.load_factor *= from.load_rate < 0.0 ? -1.0 : 1.0;
  const double way = step * motion(from.direction);
  const double longest =
      scale_.load_control ? std::max(kFarFromPrediction, way) : std::max(scale_.motion, way);
  try {
    std::optional<PathPoint> out = correct(std::move(prediction), along, longest);
    if (out && position_residual(*out) > kDependentGap * model_.length) {
      resisting_ = "joints that followed from others open";
      return std::nullopt;
    }
    if (out && out->direction.size() == 0) {
      if (!may_branch) return std::nullopt;
      fit(from);
      out->direction = from.direction;
      out->load_rate = from.load_rate;
    }
    if (out) out->position = from.position + step;
    return out;
  } catch (const NumericalError& error) {  // a force law that cannot be evaluated there
    resisting_ = error.what();
    return std::nullopt;
  }
}

std::optional<PathPoint> StaticContinuation::at_load_factor(const PathPoint& near,
                                                            double load_factor) {
  StaticPoint point = near.point;
  fit(point);
  point.load_factor = load_factor;
  const double sign = near.load_rate < 0.0 ? -1.0 : 1.0;
  Plane along = load_plane();
  along.load_factor *= sign;
  std::optional<PathPoint> out = correct(std::move(point), along, kFarFromPrediction);
  if (out && out->direction.size() == 0) return std::nullopt;
  if (out) {
    out->point.load_factor = load_factor;  // to the last digit
    out->position = near.position;
  }
  return out;
}

double StaticContinuation::alignment(const PathPoint& a, const PathPoint& b) const {
  Vector x = fitted(a).direction;
  Vector y = fitted(b).direction;
  if (x.size() != y.size()) return 1.0;  // other joint rows since
  for (int k = 0; k < system_->size(); ++k) {
    if (system_->share(k) == Share::joint) x[k] = y[k] = 0.0;
  }
  const double norms = x.norm() * y.norm();
  const double cosine = norms > 0.0 ? x.dot(y) / norms : 1.0;
  const double motions = motion(x) * motion(y);
  return cosine * motions / (scale_.motion * scale_.motion) +
         a.load_rate * b.load_rate / (scale_.load_factor * scale_.load_factor);
}

std::optional<StaticModes> StaticContinuation::modes(const PathPoint& found, double sigma) {
  const PathPoint at = fitted(found);
  system_->linearise(at.point, at.balance);
  RestStands loaded = at.point.rest;
  rest_.open_unloaded(kForceTolerance * std::max(force_, rest_.strongest(loaded)), loaded);
  return static_modes(*system_, sigma, loaded);
}

double StaticContinuation::force_residual(const PathPoint& found) const {
  const PathPoint at = fitted(found);
  return force_ * system_->largest(system_->residual(at.point, at.balance), Share::frame);
}

double StaticContinuation::position_residual(const PathPoint& at) const {
  const Vector& g = at.balance.constraints.g;
  return g.size() > 0 ? g.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace buckens::analysis

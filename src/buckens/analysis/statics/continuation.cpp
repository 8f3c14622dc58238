// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

using linalg::SparseMatrix;
using linalg::Vector;
using Share = StaticSystem::Share;

namespace {

constexpr int kMaxIterations = 15;
// Farther from the prediction than this [rad, or of the model's length] it is another equilibrium.
constexpr double kFarFromPrediction = 0.5;
// A row that changes within so many full steps may be what ends them.
constexpr double kNearCorner = 0.1;

/// [A b; nᵀ c]
SparseMatrix bordered(const SparseMatrix& A, const Vector& column, const Vector& row,
                      double corner) {
  const Eigen::Index n = A.rows();
  std::vector<linalg::Triplet> entries;
  entries.reserve(static_cast<std::size_t>(A.nonZeros() + 2 * n + 1));
  for (Eigen::Index k = 0; k < A.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      entries.emplace_back(it.row(), it.col(), it.value());
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    entries.emplace_back(k, n, column[k]);
    entries.emplace_back(n, k, row[k]);
  }
  entries.emplace_back(n, n, corner);
  SparseMatrix out(n + 1, n + 1);
  out.setFromTriplets(entries.begin(), entries.end());
  out.makeCompressed();
  return out;
}

}  // namespace

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

Vector StaticContinuation::load_derivative(const StaticPoint& point) const {
  StaticPoint loaded = point;
  loaded.load_factor = 1.0;
  StaticPoint unloaded = point;
  unloaded.load_factor = 0.0;
  // Loads enter linearly: the difference is the derivative.
  return system_->residual(loaded, system_->balance(loaded)) -
         system_->residual(unloaded, system_->balance(unloaded));
}

bool StaticContinuation::factorise(const StaticPoint& point, const Vector& load_derivative,
                                   const Plane& plane, double give) {
  // Rows of μ are scaled so that a full step is one.
  const SparseMatrix tangent =
      bordered(system_->tangent(0.0, point.rest, give), scale_.load_factor * load_derivative,
               plane.x, scale_.load_factor * plane.load_factor);
  const bool is_same_pattern = lu_ && model_.contact_groups.empty();  // see StaticDescent
  if (is_same_pattern && lu_->factorise(tangent)) return true;
  lu_.emplace(tangent);  // again: pivots of another configuration may be bad here
  return lu_->factorise(tangent);
}

bool StaticContinuation::solve_step(StaticPoint& point, const StaticBalance& balance,
                                    const Plane& plane, Vector& step, double give) {
  system_->linearise(point, balance);
  const Vector loaded = load_derivative(point);
  rest_.follow_contacts(balance.rest, point.rest);
  RestPivots pivots(*system_);
  step.resize(system_->size() + 1);
  for (;;) {
    step << -system_->residual(point, balance), 0.0;
    if (!factorise(point, loaded, plane, give)) return false;
    lu_->solve_in_place(step);
    if (!step.allFinite()) return false;
    switch (pivots.revise(balance, step.head(system_->size()), point)) {
      case RestPivots::Outcome::settled:
        return true;
      case RestPivots::Outcome::moved:
        break;
      case RestPivots::Outcome::lost:
        resisting_ = pivots.lost_text();
        return false;
    }
  }
}

StaticPoint StaticContinuation::moved(const StaticPoint& point, const Vector& step) const {
  StaticPoint out = system_->moved(point, step.head(system_->size()));
  out.load_factor += scale_.load_factor * step[system_->size()];
  return out;
}

std::optional<PathPoint> StaticContinuation::correct(StaticPoint point, const Plane& across,
                                                     double longest) {
  Plane plane = across;
  double way = 0.0;
  bool has_shared = rest_.size() < 2;
  for (int iteration = 0;; ++iteration) {
    PathPoint out;
    out.balance = system_->balance(point);
    const Vector residual = system_->residual(point, out.balance);
    if (!residual.allFinite()) return std::nullopt;
    const bool is_end = is_balanced(point, out.balance, residual);
    if (is_end && has_shared) {
      out.point = std::move(point);
      out.iterations = iteration;
      polish_and_lead_on(out, plane);
      return out;
    }
    if (is_end) {  // rows that share a load share it evenly
      has_shared = true;
      rest_.share(out.balance.rest, point.rest);
      out.balance = system_->balance(point);
    }
    remember_resistance(point, residual);
    const int n = system_->size();
    Vector step;
    const double give = is_end ? StaticSystem::kGiveOfSharing : StaticSystem::kGive;
    if (iteration == kMaxIterations || !solve_step(point, out.balance, plane, step, give)) {
      return std::nullopt;
    }
    if (is_end) {  // in place
      point = system_->moved(point, system_->forces_of(step.head(n)));
      --iteration;
      continue;
    }
    if (way + motion(step.head(n)) > longest) return std::nullopt;
    StaticPoint next = moved(point, step);
    if (follow_pairs(point, next, true)) {  // again, with the rows of those that it would meet
      fit(point);
      plane.x.conservativeResizeLike(Vector::Zero(system_->size()));  // no part of multipliers
      continue;
    }
    way += motion(step.head(n));
    point = std::move(next);
  }
}

void StaticContinuation::polish_and_lead_on(PathPoint& at, const Plane& plane) {
  const int n = system_->size();
  const Vector residual = system_->residual(at.point, at.balance);
  StaticPoint better = at.point;
  Vector step;
  if (!solve_step(better, at.balance, plane, step)) return;
  if (motion(step.head(n)) < kFarFromPrediction) {
    // One more Newton step reaches rounding; if already there, it is not taken.
    better = moved(better, step);
    StaticBalance balance = system_->balance(better);
    if (misfit(system_->residual(better, balance)) < misfit(residual)) {
      at.point = better;
      at.balance = std::move(balance);
    }
  }
  lead_on(at);
}

/// Direction of the path by the last factor.
bool StaticContinuation::lead_on(PathPoint& at) {
  const int n = system_->size();
  Vector direction = Vector::Unit(n + 1, n);
  lu_->solve_in_place(direction);
  if (!direction.allFinite()) return false;
  const double turn = scale_.load_control ? 0.0 : motion(direction.head(n)) / scale_.motion;
  const double size = std::hypot(turn, direction[n]);
  if (!(size > 0.0) || !std::isfinite(size)) return false;
  at.direction = direction.head(n) / size;
  at.load_rate = scale_.load_factor * direction[n] / size;
  return true;
}

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

void StaticContinuation::remember_resistance(const StaticPoint& point, const Vector& residual) {
  Eigen::Index worst = 0;
  residual.cwiseAbs().maxCoeff(&worst);
  const int index = static_cast<int>(worst);
  if (system_->share(index) == Share::frame) {
    resisting_ = describe_motion(model_, *system_, point, Vector::Unit(residual.size(), worst));
  } else if (system_->share(index) == Share::joint) {
    resisting_ = fmt::format("{} opens", system_->owner_at(index));
  } else {
    resisting_ = fmt::format("body \"{}\" deforms", model_.bodies[system_->body_at(index)].name);
  }
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

// SPDX-License-Identifier: Apache-2.0
// Newton's method at a point of a path, in the plane across it.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/statics/continuation.h"
#include "buckens/analysis/statics/rest_pivots.h"

namespace buckens::analysis {

using linalg::SparseMatrix;
using linalg::Vector;
using Share = StaticSystem::Share;

namespace {

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

}  // namespace buckens::analysis

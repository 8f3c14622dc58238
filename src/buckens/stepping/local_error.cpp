// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/local_error.h"

#include <algorithm>
#include <cmath>

#include "buckens/body/body_lengths.h"
#include "buckens/linalg/row_program.h"
#include "buckens/spatial/rotation.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Vector;

namespace {

// The first trial, over the longest step, shows roughly how far a body will deform. A tenth of it
// is used, so that a wild guess does not make later steps inaccurate.
constexpr double kTrusted = 0.1;
// Errors of as many radians of a vibration may add up to the tolerance. That is what a vibration
// with a tenth of critical damping remembers.
constexpr double kRadians = 10;
// Rounding of positions makes differences of 4e-16 of them: no step can be asked for less.
constexpr double kDifferenceRounding = 4e-15;

}  // namespace

const char* to_string(ErrorEstimate::Quantity quantity) {
  switch (quantity) {
    case ErrorEstimate::Quantity::rotation:
      return "rotation";
    case ErrorEstimate::Quantity::deformation:
      return "deformation";
    case ErrorEstimate::Quantity::position:
      break;
  }
  return "position";
}

LocalError::LocalError(const model::Model& model, const ErrorTolerance& tolerance)
    : model_(model),
      tolerance_(tolerance),
      scale_(model.bodies.size()),
      scale_there_(model.bodies.size()),
      largest_(model.bodies.size(), 0.0),
      expected_(model.bodies.size(), 0.0) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].is_flexible()) scale_[b] = body::coordinate_lengths(model.bodies[b]);
  }
}

LocalError::Point LocalError::point_of(const model::State& state) const {
  Point out;
  out.t = state.t;
  for (const model::BodyState& s : state.bodies) {
    out.poses.push_back(s.frame.X_WB);
    out.d.push_back(s.d);
  }
  return out;
}

double LocalError::size_of(std::size_t b, const Terms& terms) {
  const auto& [weight, first] = terms.front();
  if (first->size() == 0) return 0.0;
  if (const auto others = first->others()) return size_there(b, terms, others);
  const auto size = [&](const Vector& d) {
    return d.cwiseProduct(scale_[b]).cwiseAbs().maxCoeff();
  };
  if (terms.size() == 1 && weight == 1.0) return size(first->whole());
  Vector sum = weight * first->whole();
  for (std::size_t k = 1; k < terms.size(); ++k) {
    if (terms[k].first != 0.0) sum += terms[k].first * terms[k].second->whole();
  }
  return size(sum);
}

double LocalError::size_there(std::size_t b, const Terms& terms,
                              const std::shared_ptr<linalg::DividedVectors>& of) {
  linalg::RowProgram program(*of);
  ScaleThere& there = scale_there_[b];
  if (there.of != of) there = {of, of->put(scale_[b]), program.combine({})};
  std::vector<linalg::DividedVector> vectors;
  for (const auto& [weight, d] : terms) vectors.push_back(d->divided(of));
  std::vector<std::pair<double, const linalg::DividedVector*>> weighted;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    weighted.emplace_back(terms[k].first, &vectors[k]);
  }
  const linalg::DividedVector sum = program.combine(weighted);
  const auto compared = program.compare(sum, there.zero, there.scale, there.scale);
  program.run();
  return program.most(compared, 2);
}

void LocalError::start(const model::State& state) {
  past_.clear();
  past_.push_front(point_of(state));
  start_ = {};
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    start_.v.push_back(s.frame.v);
    start_.w.push_back(s.frame.w);
    start_.v_dot.push_back(s.v_dot);
    start_.w_dot.push_back(s.w_dot);
    start_.d_dot.push_back(s.d_dot);
    largest_[b] = size_of(b, s.d);
  }
}

LocalError::Difference LocalError::third_difference(double t) const {
  const auto product = [](double a, double b, double c) { return 1.0 / (a * b * c); };
  const double a = past_[0].t;
  const double h = t - a;
  if (past_.size() == 1) {
    // f[a, a, a, t]
    const double cube = product(h, h, h);
    return {{cube, -cube}, -cube * h, -0.5 * cube * h * h};
  }
  const double b = past_[1].t;
  if (past_.size() == 2) {
    // f[b, b, a, t], b where the motion began
    const double to_t = product(t - b, t - b, t - a);
    const double to_a = product(a - b, a - b, a - t);
    return {{to_t, to_a, -to_t - to_a}, 1.0 / ((a - b) * (t - b)), 0.0};
  }
  const double c = past_[2].t;
  return {{product(t - a, t - b, t - c), product(a - t, a - b, a - c), product(b - t, b - a, b - c),
           product(c - t, c - a, c - b)},
          0.0,
          0.0};
}

LocalError::Difference LocalError::second_difference(double t) const {
  const double a = past_[0].t;
  const double h = t - a;
  // f[a, a, t], a where the motion began
  if (past_.size() == 1) return {{1.0 / (h * h), -1.0 / (h * h)}, -1.0 / h, 0.0};
  const double b = past_[1].t;
  return {{1.0 / (h * (t - b)), 1.0 / (-h * (a - b)), 1.0 / ((b - t) * (b - a))}, 0.0, 0.0};
}

double LocalError::difference_of(std::size_t b, const model::BodyState& end, const Difference& f) {
  // The first step leaves out d̈: where a load sets in, that of a stiff vibration says nothing.
  Terms terms = {{f.position[0], &end.d}};
  for (std::size_t k = 0; k + 1 < f.position.size(); ++k) {
    terms.emplace_back(f.position[k + 1], &past_[k].d[b]);
  }
  if (f.rate != 0.0) terms.emplace_back(f.rate, &start_.d_dot[b]);
  return size_of(b, terms);
}

double LocalError::deformation_ratio(std::size_t b, const model::BodyState& end,
                                     const Scheme& scheme, double t, double share) {
  const double h = t - past_[0].t;
  const double seen = std::max({largest_[b], expected_[b], size_of(b, end.d)});
  const double admitted = tolerance_.relative * seen + tolerance_.absolute * model_.length;
  const double rounding =
      kDifferenceRounding * std::max(model_.length, end.frame.X_WB.p.cwiseAbs().maxCoeff());
  const double factor = scheme.error_constant() * h * h;
  const double in_run =
      6.0 * factor * h * difference_of(b, end, third_difference(t)) / (share * admitted + rounding);
  const double in_radians =
      2.0 * factor * difference_of(b, end, second_difference(t)) / (admitted / kRadians + rounding);
  return std::min(in_run, in_radians);
}

ErrorEstimate LocalError::estimate(const model::State& end, const Scheme& scheme, double share) {
  const Difference f = third_difference(end.t);
  const double h = end.t - past_[0].t;
  // x‴ is six times the third divided difference.
  const double factor = 6.0 * scheme.error_constant() * h * h * h;
  ErrorEstimate out;
  const auto count = [&](double error, double admitted, std::size_t b,
                         ErrorEstimate::Quantity quantity) {
    const double ratio = factor * error / admitted;
    if (ratio > out.ratio || std::isnan(ratio)) out = {ratio, b, quantity};
  };
  for (std::size_t b = 0; b < end.bodies.size(); ++b) {
    const model::BodyState& s = end.bodies[b];
    const auto turned = [&](const spatial::Pose& X) {
      return spatial::log_rotation(past_[0].poses[b].q.conjugate() * X.q);
    };
    Vector3d way = f.position[0] * s.frame.X_WB.p;
    Vector3d angle = f.position[0] * turned(s.frame.X_WB);
    for (std::size_t k = 0; k < past_.size(); ++k) {
      way += f.position[k + 1] * past_[k].poses[b].p;
      if (k > 0) angle += f.position[k + 1] * turned(past_[k].poses[b]);
    }
    if (f.rate != 0.0) {
      way += f.rate * start_.v[b] + f.acceleration * start_.v_dot[b];
      angle += f.rate * start_.w[b] + f.acceleration * start_.w_dot[b];
    }
    const double reach = std::max(model_.length, s.frame.X_WB.p.cwiseAbs().maxCoeff());
    count(way.norm(), share * tolerance_.relative * model_.length + kDifferenceRounding * reach, b,
          ErrorEstimate::Quantity::position);
    count(angle.norm(), share * tolerance_.relative + kDifferenceRounding, b,
          ErrorEstimate::Quantity::rotation);
    if (s.d.size() == 0) continue;
    if (is_first_trial_) expected_[b] = kTrusted * size_of(b, s.d);
    const double ratio = deformation_ratio(b, s, scheme, end.t, share);
    if (ratio > out.ratio || std::isnan(ratio)) {
      out = {ratio, b, ErrorEstimate::Quantity::deformation};
    }
  }
  is_first_trial_ = false;
  return out;
}

void LocalError::accept(const model::State& end) {
  if (past_.size() == 3) past_.pop_back();
  past_.push_front(point_of(end));
  for (std::size_t b = 0; b < end.bodies.size(); ++b) {
    largest_[b] = std::max(largest_[b], size_of(b, end.bodies[b].d));
  }
}

}  // namespace buckens::stepping

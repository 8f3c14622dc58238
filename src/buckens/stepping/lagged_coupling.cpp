// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/lagged_coupling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "buckens/body/body_lengths.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/frame_equation.h"

namespace buckens::stepping {

using Eigen::Index;
using Eigen::Vector3d;

namespace {
// Of a body's length: a thousandth of what rounding of its position is.
constexpr double kNoMotion = 1e-19;
// Share of what deformation adds to the inertia about an axis up to which a parabola through past
// coupling loads, followed by two solves, does not make rounding grow: docs/theory/08-coupling.md.
constexpr double kMostDeformed = 0.5;
// With less of the inertia without deformation it is less than kMostDeformed of the whole, too:
// about any axis sqrt(J) >= sqrt(J0) - sqrt(J2), so that J >= 0.81 J0.
constexpr double kHardlyDeformed = 0.01;
}  // namespace

LaggedCoupling::LaggedCoupling(const body::Body& body, const BodyStepOperator& op)
    : body_(&body),
      scheme_(op.scheme()),
      common_(op.nodal() != nullptr ? &op.common() : nullptr),
      rows_(op.num_dofs()),
      inverse_diagonal_(op.K_hat_diagonal().cwiseInverse()),
      divided_(op.divided()) {
  const linalg::Matrix patterns = body.flexible->invariants.centrifugal_patterns();
  const linalg::Vector lengths = body::coordinate_lengths(body);
  if ((lengths.array() != 1.0).any()) {
    linalg::Vector moved = lengths.cwiseProduct(inverse_diagonal_);
    if (divided_ != nullptr) {
      moved_there_ = divided_->vectors().put(moved);
    } else {
      moved_per_load_ = std::move(moved);
    }
  }
  undeformed_ = patterns.transpose() * (inverse_diagonal_.asDiagonal() * patterns);
}

void LaggedCoupling::start(const model::BodyState& s, int history, double t, TaskPool* pool) {
  load_changed_ = true;
  if (!s.terms.are_lagged()) {
    used_ = evaluated_ = {};
  } else if (history == 0) {
    evaluate_coupling(s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w, s.w_dot, false, used_, pool);
  } else if (divided_ != nullptr) {
    extrapolate_divided(s, known_instants(s, history), scheme_.evaluation_time(t));
  } else {
    dynamics::extrapolate(s, known_instants(s, history), scheme_.evaluation_time(t), used_, pool);
  }
}

/// @param compares whether the load is to be compared with the one used
LaggedCoupling::Sizes LaggedCoupling::evaluate_coupling(
    const body::CouplingTerms& terms, const linalg::NodalVector& d, const linalg::NodalVector& rate,
    const linalg::NodalVector& acceleration, const Vector3d& w, const Vector3d& w_dot,
    bool compares, model::Coupling& out, TaskPool* pool) {
  if (divided_ != nullptr) {
    return evaluate_divided(terms, d, rate, acceleration, w, w_dot, compares, out);
  }
  dynamics::evaluate_coupling(*body_, terms, d, rate, acceleration, w, w_dot, out, pool, common_);
  return compares && terms.have_load() ? compare_loads(pool) : Sizes();
}

// How many past instants the coupling may be extrapolated from without making rounding grow.
int LaggedCoupling::known_instants(const model::BodyState& s, int history) const {
  if (!s.terms.eul_fe || !s.terms.quad_ref) return history;
  const Eigen::LLT<Eigen::Matrix3d> undeformed(body_->J0);
  if (undeformed.info() != Eigen::Success) return history;
  if (undeformed.solve(s.coupling.moments.J).trace() < kHardlyDeformed) return history;
  const body::InertiaInvariants& invariants = body_->flexible->invariants;
  const std::array<Vector6, 2> patterns =
      divided_ != nullptr ? divided_->pattern_values(s.d, s.d_dot)
                          : std::array<Vector6, 2>{invariants.pattern_values(s.d.whole()),
                                                   invariants.pattern_values(s.d_dot.whole())};
  const body::DeformedMoments all =
      dynamics::frame_moments(*body_, s.terms, s.coupling.moments, patterns[0], patterns[1]);
  const Eigen::LLT<Eigen::Matrix3d> whole(all.J);
  if (whole.info() != Eigen::Success) return history;
  const double share = whole.solve(s.coupling.moments.J).trace();
  return share > kMostDeformed ? std::min(history, 1) : history;
}

LaggedCoupling::Sizes LaggedCoupling::compare_loads(TaskPool* pool) {
  std::array<Sizes, linalg::RowParts::kMostParts> parts;
  const linalg::Vector& evaluated = evaluated_.load.whole();
  const linalg::Vector& used = used_.load.whole();
  rows_.for_pieces(pool, [&](int part, Index first, Index size) {
    Sizes& sizes = parts[static_cast<std::size_t>(part)];
    const auto weight = inverse_diagonal_.segment(first, size);
    const auto load = evaluated.segment(first, size);
    // Where the cache holds it: few steps need the change itself.
    std::array<double, linalg::RowParts::kPiece> room;
    Eigen::Map<linalg::Vector> change(room.data(), size);
    change = load - used.segment(first, size);
    sizes.change += change.cwiseAbs2().dot(weight);
    sizes.load += load.cwiseAbs2().dot(weight);
    const auto moved = moved_per_load_.size() > 0 ? moved_per_load_.segment(first, size) : weight;
    sizes.moved = std::max(sizes.moved, change.cwiseProduct(moved).cwiseAbs().maxCoeff());
  });
  Sizes out;
  for (int part = 0; part < rows_.count(); ++part) {
    const Sizes& sizes = parts[static_cast<std::size_t>(part)];
    out.change += sizes.change;
    out.load += sizes.load;
    out.moved = std::max(out.moved, sizes.moved);
  }
  return out;
}

LaggedCoupling::Gap LaggedCoupling::judge(const Change& of, const body::Body& body,
                                          const StepSettings& settings, double L) {
  Gap gap;
  gap.motion = std::max(of.moved / L, of.turned);
  const bool moves_nothing = !settings.iterate_coupling &&
                             body.num_dofs() <= SmallBodyAnswers::kMostVariables &&
                             of.moved <= kNoMotion * body.length_scale() && of.turned <= kNoMotion;
  if (moves_nothing) return gap;
  const double load = of.load_size != 0.0 ? of.load / of.load_size : 0.0;
  const double frame = of.frame_size > 0.0 ? of.frame / of.frame_size : 0.0;
  gap.load_changed = load > settings.outer_tolerance;
  gap.frame_changed = frame > settings.outer_tolerance;
  gap.change = std::max(load, frame);
  return gap;
}

LaggedCoupling::Gap LaggedCoupling::evaluate(const BodyStep& step, const LargeStep& large,
                                             const model::BodyState& after, double t,
                                             const StepSettings& settings, double L,
                                             TaskPool* pool) {
  const Vector6 rate = scheme_.mean_rate * step.u + step.frame.mean_velocity;
  const Vector6 acceleration = step.frame_acceleration(scheme_);
  const Vector3d w = rate.head<3>();
  const Vector3d w_dot = acceleration.head<3>();
  const Sizes sizes =
      evaluate_coupling(step.terms, large.d_e(after), large.rate_e(after),
                        large.acceleration_e(after), w, w_dot, true, evaluated_, pool);
  evaluated_.t = scheme_.evaluation_time(t);

  Change change;
  if (step.terms.have_load()) {
    const Vector6 weights = dynamics::centrifugal_weights(step.terms, w);
    load_size_ = std::sqrt(sizes.load + weights.dot(undeformed_ * weights));
    change.load = std::sqrt(sizes.change);
    change.load_size = load_size_;
    change.moved = scheme_.force * sizes.moved;
  }
  const Vector3d frame_change =
      (dynamics::frame_inertia(*body_, evaluated_.moments, w, w_dot, Vector3d::Zero()) -
       dynamics::frame_inertia(*body_, used_.moments, w, w_dot, Vector3d::Zero()))
          .head<3>();
  change.frame = frame_change.norm();
  change.frame_size = body_->J0.norm() * (w_dot.norm() + w.squaredNorm());
  change.turned = scheme_.force * (step.compliance.topLeftCorner<3, 3>() * frame_change).norm();
  const Gap gap = judge(change, *body_, settings, L);
  load_changed_ = gap.load_changed;
  return gap;
}

void LaggedCoupling::take_over() {
  if (load_changed_) {
    std::swap(used_, evaluated_);
  } else {
    used_.moments = evaluated_.moments;
  }
}

}  // namespace buckens::stepping

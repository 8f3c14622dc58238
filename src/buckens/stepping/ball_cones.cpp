// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/ball_cones.h"

#include <algorithm>

#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"
#include "buckens/stepping/cone_impulse.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

constexpr Eigen::Index kAxesOfBall = loads::RigidBallFriction::kRows;
// Angle between torque and slip that may be rounding.
constexpr double kInLine = 1e-7;
// Rates of this fraction of the effect of torques on them are rounding.
constexpr double kStill = 1e-12;
// Response of an axis, as a fraction of the largest, that is none: joints hold it.
constexpr double kHeldAxis = 1e-12;
// Sweeps from ball to ball end when rates change by less than this fraction of the effect of
// torques; each lowers one convex function. What they leave open the next decision begins with.
constexpr double kSweptRates = 1e-14;
constexpr int kMostSweepsOfBalls = 1000;

/// Changes of rates w = D P − b that remain with |P| ≤ most for each ball: the smallest of
/// ½ PᵀDP − bᵀP, ball by ball. @param P start and result
void sweep(const Matrix& D, const Vector& b, const std::vector<double>& most, Vector& P) {
  const double none = kHeldAxis * D.diagonal().maxCoeff();
  const Matrix sizes = D.cwiseAbs();
  for (int round = 0; round < kMostSweepsOfBalls; ++round) {
    const Vector before = P;
    for (std::size_t k = 0; k < most.size(); ++k) {
      const Eigen::Index first = kAxesOfBall * static_cast<Eigen::Index>(k);
      const PlaceMatrix own = D.block(first, first, kAxesOfBall, kAxesOfBall);
      const PlaceVector without = D.middleRows(first, kAxesOfBall) * P -
                                  b.segment(first, kAxesOfBall) -
                                  own * P.segment(first, kAxesOfBall);
      P.segment(first, kAxesOfBall) = rub_impulse(own, without, most[k], none);
    }
    const double change = (D * (P - before)).cwiseAbs().maxCoeff();
    if (most.size() == 1 || change <= kSweptRates * (sizes * P.cwiseAbs()).maxCoeff()) return;
  }
}

}  // namespace

BallCones::BallCones(const model::Model& model) : model_(model), answers_(model) {
  int soft = 0, rigid_rows = 0;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* law = dynamic_cast<const loads::RigidBallFriction*>(load.element.get());
    if (law != nullptr && law->row_of_ball() == 0) {
      balls_.push_back({k, load.rigid_row, soft, law});
    }
    soft += load.element->num_soft_rows();
    if (load.rigid_row >= 0) ++rigid_rows;
  }
  is_own_.assign(static_cast<std::size_t>(rigid_rows), 0);
  for (const Ball& ball : balls_) std::fill_n(is_own_.begin() + ball.rigid, kAxesOfBall, 1);
}

bool BallCones::any_slides(const RigidRows& rigid) const {
  return std::any_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
    return rigid.stands()[static_cast<std::size_t>(ball.rigid)].regime >= 2;
  });
}

bool BallCones::hold(const std::vector<loads::RigidRow>& rows, const RigidRows& rigid) const {
  return std::all_of(balls_.begin(), balls_.end(),
                     [&](const Ball& ball) { return holds(ball, rows, rigid); });
}

bool BallCones::holds(const Ball& ball, const std::vector<loads::RigidRow>& rows,
                      const RigidRows& rigid) {
  Vector3d slip, torque;
  for (int k = 0; k < kAxesOfBall; ++k) {
    const auto row = static_cast<std::size_t>(ball.rigid + k);
    if (rows[row].next.regime != rigid.stands()[row].regime) return false;
    if (rows[row].is_closed) return true;
    slip[k] = rows[row].slip;
    torque[k] = rows[row].given;
  }
  const double speed = slip.norm(), size = torque.norm();
  const double at_rest = loads::RigidBallFriction::kAtRest;
  return !(speed > at_rest) ||
         (torque * speed + slip * size).norm() <= (kInLine * speed + 4.0 * at_rest) * size;
}

BallCones::Balls BallCones::gather(const RigidInstant& now, const Stage& stage,
                                   const RigidRows& rigid) const {
  dynamics::SignalValues signals;
  const dynamics::Circumstances around =
      dynamics::with_signals(model_, now.motions, now.t, now.around, signals);
  Balls out;
  const auto size = kAxesOfBall * std::ssize(balls_);
  out.torque.resize(size);
  out.rate.resize(size);
  out.viscous.resize(size);
  Eigen::Index n = 0;
  for (const Ball& ball : balls_) {
    const loads::RowStand* stands = rigid.stands().data() + ball.rigid;
    // One that is switched off has no stand.
    if (stands->regime == 0) continue;
    const dynamics::LoadEnds ends =
        dynamics::ends_of(model_, model_.loads[ball.load], now.motions, now.around.memory);
    const loads::Sight sight = dynamics::sight_of(model_, ball.load, now.t, around, ends);
    const double speed = loads::RigidBallFriction::rate(sight).norm();
    if (stage.begins && speed > loads::RigidBallFriction::kAtRest) continue;
    const double viscous = ball.law->viscous(sight);
    out.all.push_back(&ball);
    out.most.push_back(ball.law->most(sight, stands->regime == 1 ? 0.0 : speed));
    for (int k = 0; k < kAxesOfBall; ++k, ++n) {
      const loads::RigidRow& row = now.rows[static_cast<std::size_t>(ball.rigid + k)];
      out.viscous[n] = stage.begins ? 0.0 : viscous;
      out.rate[n] = row.slip;
      out.torque[n] = row.is_closed ? stands[k].force : row.given + out.viscous[n] * row.slip;
    }
  }
  for (Vector* values : {&out.torque, &out.rate, &out.viscous}) values->conservativeResize(n);
  return out;
}

bool BallCones::condense(const RigidInstant& now, const Stage& stage) {
  std::vector<dynamics::SystemRow> others;
  std::vector<double> give;
  bool have_springs = false;
  for (std::size_t k = 0; k < now.soft.rows.size(); ++k) {
    const int row = now.soft.rigid[k];
    const dynamics::SystemRow& own = now.soft.rows[k];
    if (row < 0) {
      const bool is_spring = now.soft.stiffness[k] > 0.0 || now.soft.damping[k] > 0.0;
      if (stage.soft_compliance == nullptr || !is_spring) continue;
      have_springs = true;
      give.push_back((*stage.soft_compliance)[k]);
    } else {
      // Other rigid rows keep their stands.
      if (!now.soft.is_closed[k] || is_own_[static_cast<std::size_t>(row)] != 0) continue;
      give.push_back(kRigidGive * own_compliance(own, now.compliance));
    }
    others.push_back(own);
  }
  if (!have_springs) give.clear();
  return answers_.condense(now.compliance, now.motions, now.rows_in_use, now.around.memory, now.t,
                           others, give);
}

Matrix BallCones::answers(const RigidInstant& now, const Balls& balls) const {
  std::vector<Push> pushes;
  for (const Ball* ball : balls.all) {
    for (int k = 0; k < kAxesOfBall; ++k) {
      pushes.emplace_back().row = now.soft.rows[static_cast<std::size_t>(ball->soft + k)];
    }
  }
  std::vector<const Push*> all;
  for (Push& push : pushes) {
    answers_.answer(push);
    all.push_back(&push);
  }
  const Matrix D(PushAnswers::along_all(all));
  // Gyroscopic terms make it slightly unsymmetric.
  return 0.5 * (D + D.transpose());
}

bool BallCones::decide(const RigidInstant& now, const Stage& stage, double per_force,
                       double per_change, RigidRows& rigid) {
  const Balls balls = gather(now, stage, rigid);
  if (balls.all.empty() || !condense(now, stage)) return false;
  Matrix D = answers(now, balls);
  if (!(balls.viscous.isZero(0.0))) {
    // Viscous torques −c w follow what the dry ones do to the rates.
    Matrix damped = per_force * per_change * D * balls.viscous.asDiagonal();
    damped.diagonal().array() += 1.0;
    D = damped.partialPivLu().solve(D);
    D = (0.5 * (D + D.transpose())).eval();
  }
  // Rates, converted to changes at the end of the step.
  Vector P = per_force * balls.torque;
  const Vector b = D * P - balls.rate / per_change;
  std::vector<double> most = balls.most;
  for (double& size : most) size *= per_force;
  sweep(D, b, most, P);
  const Vector rates = per_change * (D * P - b);
  const double none = std::max(loads::RigidBallFriction::kAtRest,
                               kStill * per_change * (D.cwiseAbs() * P.cwiseAbs()).maxCoeff());
  bool has_moved = false;
  for (std::size_t k = 0; k < balls.all.size(); ++k) {
    const Eigen::Index first = kAxesOfBall * static_cast<Eigen::Index>(k);
    const bool sticks = rates.segment<kAxesOfBall>(first).norm() <= none;
    const Ball& ball = *balls.all[k];
    const int regime = rigid.stands()[static_cast<std::size_t>(ball.rigid)].regime;
    if (stage.is_settled && !sticks && regime == 2 && holds(ball, now.rows, rigid)) continue;
    has_moved = put(ball, P.segment<kAxesOfBall>(first) / per_force, sticks, rigid) || has_moved;
  }
  return has_moved;
}

bool BallCones::put(const Ball& ball, const Vector3d& torque, bool sticks, RigidRows& rigid) {
  constexpr int kHeld = loads::RigidLaw::kHeldDirection;
  const loads::RowStand* stands = rigid.stands().data() + ball.rigid;
  const int before = stands->regime;
  if (sticks && before == 1) return false;
  int regime = 1;
  if (!sticks) {
    // A new direction gets a new regime number.
    const Vector3d old(stands[0].force, stands[1].force, stands[2].force);
    const bool is_same =
        before >= kHeld && (old.normalized() - torque.normalized()).norm() <= kInLine;
    if (is_same) return false;
    regime = std::max(before + 1, kHeld);
  }
  for (int k = 0; k < kAxesOfBall; ++k) rigid.put(ball.rigid + k, {regime, torque[k]});
  return true;
}

}  // namespace buckens::stepping

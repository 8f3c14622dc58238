// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/damping_work.h"

#include <cmath>

#include "buckens/dynamics/coupling_terms.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {
// Lengths of steps that are equal except for the rounding of summed times.
constexpr double kSameStep = 1e-6;
}  // namespace

DampingWork::DampingWork(const model::Model& model, std::size_t body, const model::State& start,
                         bool holds_at_states)
    : body_(&model.bodies[body]), index_(body), t_(start.t) {
  const body::FlexiblePart& part = *body_->flexible;
  const model::BodyState& s = start.bodies[body];
  std::optional<double> beta;
  if (holds_at_states && !part.is_reduced() && !part.is_quasi_static) {
    beta = stepping::stiffness_damping(part);
  }
  forms_elastic_load_ = model.may_have_rigid_rows();
  is_direct_ = !beta;
  if (beta) {
    beta_ = *beta;
    // Any step will do: only products with M are needed.
    mass_.emplace(part, stepping::Scheme(stepping::Method::newmark, 1.0, 0.0));
  }
  begin_at(s);
}

void DampingWork::start(const model::State& state) { begin_at(state.bodies[index_]); }

void DampingWork::begin_at(const model::BodyState& s) {
  if (const auto others = s.d_dot.others()) return begin_there(s, others);
  if (is_direct_) {
    rates_ = s.d_dot.whole();
    return;
  }
  power_ = mass_power(s.d_dot);
  d_ = s.d.whole();
  elastic_ = body_->flexible->fe.K * s.d.whole();
  last_step_ = 0.0;
  ++products_;
}

double DampingWork::direct_work(const linalg::NodalVector& d_dot, double h) {
  if (!body_->flexible->is_damped()) return 0.0;
  if (const auto others = d_dot.others()) return direct_work_there(d_dot, h, others);
  motion_ = 0.5 * (rates_.whole() + d_dot.whole());
  rates_ = d_dot.whole();
  linalg::multiply({{&body_->flexible->C, &motion_, &image_}});
  ++products_;
  return h * motion_.dot(image_);
}

double DampingWork::mass_power(const Vector& d_dot) {
  const double alpha = body_->flexible->fe.mass_damping;
  if (alpha == 0.0) return 0.0;
  mass_->multiply_mass(d_dot, image_);
  return alpha * d_dot.dot(image_);
}

void DampingWork::find_elastic_load(const model::State& state, const dynamics::Forces& forces,
                                    double h, Vector& now) {
  const body::FlexiblePart& part = *body_->flexible;
  const model::BodyState& s = state.bodies[index_];
  motion_ = s.d_ddot.whole() + part.fe.mass_damping * s.d_dot.whole();
  mass_->multiply_mass(motion_, image_);
  now = -image_;
  if (s.terms.have_load()) now += s.coupling.load.whole();
  part.invariants.add_centrifugal_load(dynamics::centrifugal_weights(s.terms, s.frame.w), now);
  const Vector& f = forces.interface[index_];
  for (int row = 0; row < part.num_interface_rows; ++row) {
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(part.rows, row); it; ++it) {
      now[it.col()] += it.value() * f[row];
    }
  }
  // κ + β κ̇ = now for κ = K d.
  if (!knows_rate(h)) {
    now = (now + beta_ / h * elastic_.whole()) / (1.0 + beta_ / h);
  } else {
    const double s2 = 0.5 * beta_ / h;
    now = (now + s2 * (4.0 * elastic_.whole() - elastic_before_.whole())) / (1.0 + 3.0 * s2);
  }
}

/// Of K d, from the last step, which had this length.
bool DampingWork::knows_rate(double h) const {
  return elastic_before_.size() > 0 && std::abs(h - last_step_) <= kSameStep * h;
}

double DampingWork::add(const model::State& state, const dynamics::Forces& forces,
                        RatesAtEnd rates) {
  const model::BodyState& s = state.bodies[index_];
  const double h = state.t - t_;
  t_ = state.t;
  if (is_direct_) return direct_work(s.d_dot, h);
  const bool is_formed = forms_elastic_load_ || rates == RatesAtEnd::have_jumped;
  if (const auto others = s.d.others()) return work_there(state, forces, is_formed, h, others);
  if (is_formed) {
    now_ = body_->flexible->fe.K * s.d.whole();
    ++products_;
  } else {
    find_elastic_load(state, forces, h, now_.overwrite(s.d.size()));
  }
  const double power = mass_power(s.d_dot);
  const double work = proportional_work(s.d, now_, power, h);
  d_ = s.d.whole();
  go_on(now_, power, is_formed ? 0.0 : h);
  return work;
}

void DampingWork::go_on(linalg::NodalVector& elastic, double power, double step) {
  power_ = power;
  swap(elastic_before_, elastic_);
  swap(elastic_, elastic);
  last_step_ = step;
}

double DampingWork::add_before_blows(const stepping::ShapeAndRates& before,
                                     const model::State& state) {
  const double h = state.t - t_;
  t_ = state.t;
  double work = 0;
  if (is_direct_) {
    work = direct_work(linalg::NodalVector(before.d_dot), h);
  } else {
    now_ = body_->flexible->fe.K * before.d;
    ++products_;
    work = proportional_work(before.d, now_, mass_power(before.d_dot), h);
  }
  begin_at(state.bodies[index_]);
  return work;
}

double DampingWork::proportional_work(const Vector& d, const Vector& elastic, double power,
                                      double h) {
  motion_ = d - d_.whole();
  const double stiffness = beta_ / h * (motion_.dot(elastic) - motion_.dot(elastic_.whole()));
  return 0.5 * h * (power_ + power) + stiffness;
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
// The part of MultiplierCondensation that solves by iteration.
#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/linalg/small_lu.h"

namespace buckens::dynamics {

using linalg::Vector;

namespace {

// Residual that ends the iteration, relative to the right-hand side. Steps iterate with exact
// residuals around it.
constexpr double kSolved = 1e-10;
constexpr int kMostSweeps = 200;
// Blocks of up to so many rows are inverted without memory from the heap: eight spots with
// friction.
constexpr int kSmall = 24;

Eigen::Map<const Eigen::Matrix<double, 6, 1>> numbers_of(const double* values) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(values);
}

/// What an interface gives along one row under a unit multiplier of another on the same marker.
double interface_share(const linalg::Matrix& interface, const RowBlock::Side& side,
                       const double* test, const double* force) {
  std::array<int, 6> rows{};
  for (int i = 0; i < 3; ++i) {
    rows[static_cast<std::size_t>(i)] = side.translation_row + i;
    rows[static_cast<std::size_t>(3 + i)] = side.rotation_row + i;
  }
  const std::size_t count = side.rotation_row < 0 ? 3 : 6;
  double out = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) out += test[i] * interface(rows[i], rows[j]) * force[j];
  }
  return out;
}

void invert(Eigen::MatrixXd& S) {
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kSmall, kSmall>;
  if (S.rows() > kSmall) {
    S = linalg::general_inverse(S);
    return;
  }
  const Small before = S;
  const Small inverse = before.inverse();
  S = inverse;
}

/// Vectors of the iteration, kept so that steps allocate nothing.
struct SweepVectors {
  Vector b, r0, r, p, p_hat, s_hat, v, t;
};

}  // namespace

void MultiplierCondensation::set_loose_blocks() {
  const RowBlocks& test = test_rows();
  const int first_soft = size() - static_cast<int>(soft_compliance_.size());
  const auto& blocks = force_.blocks();
  loose_inverse_.resize(blocks.size() - num_direct_blocks_);
  for (std::size_t n = num_direct_blocks_; n < blocks.size(); ++n) {
    const RowBlock& block = blocks[n];
    Eigen::MatrixXd& S = loose_inverse_[n - num_direct_blocks_];
    S.setZero(block.count, block.count);
    for (std::size_t s = 0; s < block.num_sides; ++s) {
      const RowBlock::Side& side = force_.sides(block)[s];
      const RowBlock::Side& closing = test.sides(block)[s];
      if (side.body == model::kGround) continue;
      const BodyCompliance& own = compliance_[static_cast<std::size_t>(side.body)];
      const auto& W = own.frame;
      const bool bends = own.interface != nullptr && side.follows_mesh();
      for (int m = 0; m < block.count; ++m) {
        const Eigen::Matrix<double, 6, 1> image = W * numbers_of(force_.frame(side, m));
        for (int k = 0; k < block.count; ++k) {
          S(k, m) += numbers_of(test.frame(closing, k)).dot(image);
          if (!bends) continue;
          S(k, m) += interface_share(*own.interface, side, test.interface(closing, k),
                                     force_.interface(side, m));
        }
      }
    }
    for (int k = 0; k < block.count; ++k) {
      S(k, k) += soft_compliance_[static_cast<std::size_t>(block.rows[0] + k - first_soft)];
    }
    invert(S);
  }
}

void MultiplierCondensation::multiply(const Vector& x, Vector& y, Slopes slopes) const {
  const std::size_t bodies = compliance_.size();
  responses_.resize(bodies);
  moved_.resize(bodies);
  moved_interface_.resize(bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    const linalg::Matrix* interface = compliance_[b].interface;
    responses_[b].interface_load.resize(interface == nullptr ? 0 : interface->rows());
  }
  gather(x, responses_);
  for (std::size_t b = 0; b < bodies; ++b) {
    moved_[b].noalias() = compliance_[b].frame * responses_[b].frame_load;
    if (compliance_[b].interface == nullptr) continue;
    moved_interface_[b].noalias() = *compliance_[b].interface * responses_[b].interface_load;
  }
  test_rows().changes(y, [&](int b) {
    const auto k = static_cast<std::size_t>(b);
    return Displacement{&moved_[k], &moved_interface_[k]};
  });
  const auto soft = static_cast<Eigen::Index>(soft_compliance_.size());
  y.tail(soft) +=
      Eigen::Map<const Vector>(soft_compliance_.data(), soft).cwiseProduct(x.tail(soft));
  if (slopes == Slopes::left_out || !has_sloped_) return;
  const Eigen::Index first_soft = size() - soft;
  for (const MultiplierSlope& slope : slopes_) {
    y[slope.soft_row] -= soft_compliance_[static_cast<std::size_t>(slope.soft_row - first_soft)] *
                         slope.value * x[slope.row];
  }
}

void MultiplierCondensation::precondition(const Vector& x, Vector& y, Slopes slopes) const {
  y.resize(x.size());
  if (num_direct_blocks_ > 0) {
    direct_ = x.head(size() - num_loose_);
    solve_direct(direct_, slopes);
    y.head(direct_.size()) = direct_;
  }
  for (std::size_t n = num_direct_blocks_; n < force_.blocks().size(); ++n) {
    const RowBlock& block = force_.blocks()[n];
    y.segment(block.rows[0], block.count).noalias() =
        loose_inverse_[n - num_direct_blocks_] * x.segment(block.rows[0], block.count);
  }
}

// Stabilised biconjugate gradients (van der Vorst 1992): S is symmetric only where rows are closed
// in the directions in which their multipliers act.
void MultiplierCondensation::iterate(Vector& x, Slopes slopes) const {
  thread_local SweepVectors kept;
  auto& [b, r0, r, p, p_hat, s_hat, v, t] = kept;
  b = x;
  const double enough = kSolved * b.norm();
  x.setZero();
  if (!(enough > 0.0)) return;
  r0 = r = p = b;
  double rho = r0.squaredNorm();
  for (int k = 0; k < kMostSweeps; ++k) {
    precondition(p, p_hat, slopes);
    multiply(p_hat, v, slopes);
    const double alpha = rho / r0.dot(v);
    if (!std::isfinite(alpha)) return;
    x += alpha * p_hat;
    r -= alpha * v;
    if (r.norm() <= enough) return;
    precondition(r, s_hat, slopes);
    multiply(s_hat, t, slopes);
    const double omega = t.dot(r) / t.squaredNorm();
    if (!std::isfinite(omega)) return;
    x += omega * s_hat;
    r -= omega * t;
    if (r.norm() <= enough) return;
    const double rho_next = r0.dot(r);
    const double beta = rho_next / rho * (alpha / omega);
    if (!std::isfinite(beta)) return;
    rho = rho_next;
    p = r + beta * (p - omega * v);
  }
}

}  // namespace buckens::dynamics

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/stability.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/singular_values.h"
#include "buckens/linalg/sparse_lu.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::analysis {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr std::size_t kDenseLimit = 600;
// Motions that the joints prevent respond to a load by rounding only.
constexpr double kForbidden = 1e-11;
// Finite differences are good to about 1e-10 of the largest stiffness.
constexpr double kZeroStiffness = 1e-9;

}  // namespace

std::optional<StaticModes> static_modes(const StaticSystem& system, double sigma,
                                        const RestStands& stands) {
  std::vector<int> frame;
  for (int k = 0; k < system.size(); ++k) {
    if (system.share(k) == StaticSystem::Share::frame) frame.push_back(k);
  }
  if (frame.empty() || frame.size() > kDenseLimit) return std::nullopt;
  const SparseMatrix A = system.tangent(sigma, stands);
  linalg::SparseLu lu(A);
  if (!lu.factorise(A)) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(frame.size());
  Matrix responses(system.size(), count), W(count, count);
  Matrix compliance(count, count);
  const SparseMatrix mass = system.mass();
  double stiffest = 0.0;
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = frame[static_cast<std::size_t>(j)];
    Vector unit = Vector::Unit(system.size(), column);
    lu.solve_in_place(unit);
    responses.col(j) = unit;
    for (Eigen::Index i = 0; i < count; ++i) {
      compliance(i, j) = unit[frame[static_cast<std::size_t>(i)]];
      W(i, j) = mass.coeff(frame[static_cast<std::size_t>(i)], column);
    }
    stiffest = std::max(stiffest, std::abs(A.coeff(column, column) / W(j, j) - sigma));
  }
  const Matrix R = linalg::DenseCholesky(W).lower();
  const Matrix mobility = R.transpose() * (0.5 * (compliance + compliance.transpose())) * R;
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(mobility);
  // κ = 1/μ − σ: ascending κ is descending 1/μ, negative μ first.
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double mu = eigen.values[k];
    if (std::abs(mu) * sigma > kForbidden) order.emplace_back(1.0 / mu - sigma, k);
  }
  std::sort(order.begin(), order.end());
  StaticModes modes;
  modes.tolerance = 1e-6 * sigma + kZeroStiffness * stiffest;
  modes.stiffness.resize(static_cast<Eigen::Index>(order.size()));
  modes.shapes.resize(system.size(), modes.stiffness.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    modes.stiffness[column] = order[k].first;
    modes.shapes.col(column) =
        responses * (R * eigen.vectors.col(order[k].second)) * (order[k].first + sigma);
  }
  return modes;
}

std::optional<StaticModes> softest_mode(const StaticSystem& system, double sigma,
                                        const RestStands& stands) {
  constexpr int kRounds = 30;
  const SparseMatrix A = system.tangent(sigma, stands);
  const SparseMatrix W = system.mass();
  linalg::SparseLu lu(A);
  if (!lu.factorise(A)) return std::nullopt;
  // No two entries alike, so that no symmetric motion is missed.
  Vector x(system.size());
  for (int k = 0; k < system.size(); ++k) x[k] = 1.0 + std::sin(1.0 + 7.0 * k);
  double mobility = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const Vector load = W * x;
    const double size = x.dot(load);
    if (!(size > 0.0)) return std::nullopt;
    Vector next = load;
    lu.solve_in_place(next);
    if (!next.allFinite()) return std::nullopt;
    mobility = next.dot(load) / size;
    x = next / std::sqrt(next.dot(W * next));
  }
  double stiffest = 0.0;
  for (int k = 0; k < system.size(); ++k) {
    const double mass = W.coeff(k, k);
    if (mass > 0.0) stiffest = std::max(stiffest, std::abs(A.coeff(k, k) / mass - sigma));
  }
  StaticModes modes;
  modes.tolerance = 1e-6 * sigma + kZeroStiffness * stiffest;
  modes.stiffness = Vector::Constant(1, 1.0 / mobility - sigma);
  modes.shapes = x;
  return modes;
}

std::string direction_text(const Vector3d& direction) {
  const Vector3d n = direction.normalized();
  const auto clean = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", clean(n.x()), clean(n.y()), clean(n.z()));
}

namespace {

/// The body whose frame moves most in a step.
std::size_t most_moved(const model::Model& model, const StaticSystem& system, const Vector& step) {
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Vector6 u = system.frame_step(b, step);
    const double size =
        std::max(u.head<3>().norm() * model.bodies[b].length_scale(), u.tail<3>().norm());
    if (size <= largest) continue;
    largest = size;
    worst = b;
  }
  return worst;
}

/// "along (0, 0, 1)", or the text for several directions.
std::string span_text(const Matrix& directions, const char* one, const char* plane,
                      const char* any) {
  constexpr double kSameDirection = 1e-3;
  const linalg::SingularValues svd = linalg::singular_values(directions, linalg::LeftVectors::full);
  const auto rank = svd.rank(kSameDirection);
  if (rank >= 3) return any;
  if (rank == 2) return plane + direction_text(svd.U.col(2));
  return one + direction_text(directions.col(0));
}

}  // namespace

std::string describe_motion(const model::Model& model, const StaticSystem& system,
                            const StaticPoint& point, const Vector& step) {
  return describe_motions(model, system, point, step);
}

std::string describe_motions(const model::Model& model, const StaticSystem& system,
                             const StaticPoint& point, const Matrix& steps) {
  const std::size_t worst = most_moved(model, system, steps.col(0));
  const body::Body& body = model.bodies[worst];
  Matrix turns(3, steps.cols()), moves(3, steps.cols());
  for (Eigen::Index k = 0; k < steps.cols(); ++k) {
    const Vector6 u = system.frame_step(worst, steps.col(k));
    turns.col(k) = point.poses[worst].q * Eigen::Vector3d(u.head<3>());
    moves.col(k) = u.tail<3>();
  }
  if (turns.col(0).norm() * body.length_scale() > 0.5 * moves.col(0).norm()) {
    return fmt::format("body \"{}\" turns {}", body.name,
                       span_text(turns, "about ", "about any axis across ", "about any axis"));
  }
  return fmt::format("body \"{}\" moves {}", body.name,
                     span_text(moves, "along ", "in any direction across ", "in any direction"));
}

}  // namespace buckens::analysis

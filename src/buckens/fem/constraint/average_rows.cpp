// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/average_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using FitMatrix = Eigen::Matrix<double, 6, 6>;
using FitVector = Eigen::Matrix<double, 6, 1>;

// Fraction of the largest eigenvalue below which the fit does not determine a motion: nodes within
// 1e-6 of their extent from a line do not define a rotation about it.
constexpr double kOpenMotion = 1e-12;
// Share of a motion that may be open through rounding.
constexpr double kRoundedMotion = 1e-6;

const Vector3d& node_place(const std::vector<Node>& nodes, int node) {
  return nodes[static_cast<std::size_t>(node)].position;
}

/// The rigid motion of a reference that fits the chosen displacements of nodes best. Rotations
/// count as displacements at the mean distance of the nodes.
class ComponentFit {
 public:
  ComponentFit(const std::vector<Node>& nodes, const AverageLink& link)
      : nodes_(nodes), link_(link) {
    double sum = 0.0, total = 0.0;
    for (std::size_t k = 0; k < link.nodes.size(); ++k) {
      sum += link.weights[k] * (node_place(nodes, link.nodes[k]) - reference()).norm();
      total += link.weights[k];
    }
    if (sum > 0.0) distance_ = sum / total;
    FitMatrix S = FitMatrix::Zero();
    for (std::size_t k = 0; k < link.nodes.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (link.components.at(k)[c])
          S += link.weights[k] / total * motion(k, c) * motion(k, c).transpose();
      }
    }
    const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(S);
    const double least = kOpenMotion * eigen.values[5];
    FitMatrix told = FitMatrix::Zero();
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double value = eigen.values[k];
      if (!(value > least)) continue;
      const FitVector v = eigen.vectors.col(k);
      told += v * v.transpose();
      inverse_ += v * v.transpose() / value / total;
    }
    for (int k = 0; k < 6; ++k) {
      tells_[static_cast<std::size_t>(k)] =
          (told.col(k) - FitVector::Unit(k)).norm() <= kRoundedMotion;
    }
  }

  const std::array<bool, 6>& tells() const { return tells_; }

  PointRows rows(const DofMap& dofs) const {
    PointRows out;
    out.position = reference();
    out.has_rotation = tells_[3] && tells_[4] && tells_[5];
    for (std::size_t k = 0; k < link_.nodes.size(); ++k) {
      const auto& own = dofs.node_dofs[static_cast<std::size_t>(link_.nodes[k])];
      for (std::size_t c = 0; c < 3; ++c) {
        if (!link_.components[k][c] || own[c] < 0) continue;
        const FitVector share = link_.weights[k] * (inverse_ * motion(k, c));
        for (int row = 0; row < 3; ++row) {
          if (tells_[static_cast<std::size_t>(row)] && share[row] != 0.0) {
            out.translation.emplace_back(row, own[c], share[row]);
          }
          if (tells_[static_cast<std::size_t>(3 + row)] && share[3 + row] != 0.0) {
            out.rotation.emplace_back(row, own[c], share[3 + row] / distance_);
          }
        }
      }
    }
    return out;
  }

 private:
  const Vector3d& reference() const { return node_place(nodes_, link_.reference); }

  /// Displacement c of a node by the six motions of the reference.
  FitVector motion(std::size_t k, std::size_t c) const {
    const auto axis = static_cast<Eigen::Index>(c);
    const Vector3d r = (node_place(nodes_, link_.nodes[k]) - reference()) / distance_;
    FitVector out;
    out << Vector3d::Unit(axis), r.cross(Vector3d::Unit(axis));  // e·(θ × r) = θ·(r × e)
    return out;
  }

  const std::vector<Node>& nodes_;
  const AverageLink& link_;
  double distance_ = 1.0;
  FitMatrix inverse_ = FitMatrix::Zero();
  std::array<bool, 6> tells_{};
};

bool follows_rotation(const DofMap& dofs, const AverageLink& link) {
  for (std::size_t k = 3; k < 6; ++k) {
    const int dof = dofs.node_dofs[static_cast<std::size_t>(link.reference)][k];
    if (link.variables[k] && dof >= 0) return true;
  }
  return false;
}

bool follows_translation(const AverageLink& link) {
  return link.variables[0] || link.variables[1] || link.variables[2];
}

}  // namespace

PointRows average_rows(const std::vector<Node>& nodes, const DofMap& dofs, const AverageLink& link,
                       double length) {
  if (!link.components.empty()) {
    const ComponentFit fit(nodes, link);
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = dofs.node_dofs[static_cast<std::size_t>(link.reference)][k];
      if (!link.variables[k] || dof < 0 || fit.tells()[k]) continue;
      throw ModelError(fmt::format(
          "{}: the chosen displacements of its {} nodes do not determine the {} {} of {}; use more "
          "of them, or let {} follow in fewer",
          link.label, link.nodes.size(), k < 3 ? "displacement along" : "rotation about",
          "xyz"[k % 3], node_label(nodes, link.reference), node_label(nodes, link.reference)));
    }
    return fit.rows(dofs);
  }
  const NodeRegion region = weighted_region(nodes, link.nodes, link.weights);
  const bool is_beside = follows_translation(link) &&
                         (node_place(nodes, link.reference) - region.centre).norm() > 1e-6 * length;
  if (!region.turns() && (is_beside || follows_rotation(dofs, link))) {
    throw ModelError(
        fmt::format("{}: its {} nodes lie on one line or at one point and determine no rotation, "
                    "which {} {}; use nodes that span a surface",
                    link.label, region.nodes.size(), node_label(nodes, link.reference),
                    is_beside ? "beside them needs" : "has"));
  }
  return region_rows(nodes, dofs, region, node_place(nodes, link.reference));
}

bool gives_rotation(const std::vector<Node>& nodes, const AverageLink& link) {
  if (!(link.variables[3] && link.variables[4] && link.variables[5])) return false;
  if (link.components.empty()) {
    return weighted_region(nodes, link.nodes, link.weights).turns();
  }
  const auto tells = ComponentFit(nodes, link).tells();
  return tells[3] && tells[4] && tells[5];
}

}  // namespace buckens::fem

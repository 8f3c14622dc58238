// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/constraint/elimination.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/constraint/average_rows.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/singular_values.h"

namespace buckens::fem {

using Eigen::Vector3d;
using linalg::Triplet;

namespace {

// Fraction of the largest coefficient below which a row is rounding.
constexpr double kNothing = 1e-10;
// Share of the largest coefficient that the wanted variable must have to be eliminated.
constexpr double kPivot = 1e-6;
// Fraction by which coefficients of files may violate rigid motion by rounding; they are corrected.
constexpr double kRounding = 1e-4;

using Row = std::map<int, double>;  // coefficient by variable, in a fixed order

constexpr std::array<const char*, 6> kVariables = {"x",          "y",          "z",
                                                   "rotation x", "rotation y", "rotation z"};

/// The rigid motions that the variables of a mesh can represent: fewer in planar models.
struct RigidMotions {
  Eigen::Matrix<double, Eigen::Dynamic, 6> columns;  // zero where a motion leaves the plane
  Eigen::VectorXd size;                              // of each variable: 1 or 1/length

  RigidMotions(const std::vector<Node>& nodes, const DofMap& dofs) {
    std::array<bool, 6> known{};
    Vector3d centre = Vector3d::Zero();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      centre += nodes[n].position / static_cast<double>(nodes.size());
      for (std::size_t k = 0; k < 6; ++k) known[k] = known[k] || dofs.node_dofs[n][k] >= 0;
    }
    double length = 0.0;
    for (const Node& node : nodes) {
      length += (node.position - centre).norm() / static_cast<double>(nodes.size());
    }
    if (!(length > 0.0)) length = 1.0;
    const bool is_planar = !(known[0] && known[1] && known[2]);
    columns.setZero(dofs.num_dofs, 6);
    size.setOnes(dofs.num_dofs);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Vector3d x = nodes[n].position - centre;
      for (int k = 0; k < 6; ++k) {
        const int dof = dofs.node_dofs[n][static_cast<std::size_t>(k)];
        if (dof < 0) continue;
        if (k > 2) size[dof] = 1.0 / length;
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          if (k == axis) columns(dof, axis) = 1.0;
          if (is_planar && known[a]) continue;  // turns out of the plane
          if (k < 3) columns(dof, 3 + axis) = Vector3d::Unit(axis).cross(x)[k] / length;
          if (k == 3 + axis) columns(dof, 3 + axis) = 1.0 / length;
        }
      }
    }
  }
};

class Eliminator {
 public:
  Eliminator(const std::vector<Node>& nodes, const DofMap& dofs)
      : nodes_(nodes), dofs_(dofs), rigid_(nodes, dofs) {}

  void add(const RigidLink& link);
  void add(const AverageLink& link);
  void add(const LinearEquation& equation);
  Elimination result() const;

 private:
  int dof(int node, int variable) const {
    return dofs_.node_dofs.at(static_cast<std::size_t>(node))[static_cast<std::size_t>(variable)];
  }
  const Vector3d& place(int node) const { return nodes_[static_cast<std::size_t>(node)].position; }
  /// Adds the equation Σ row = 0.
  void eliminate(const Row& row, int wanted);
  Row replaced(const Row& row) const;
  int pivot_of(const Row& row, int wanted) const;
  void require_free(Row& row, const std::string& label) const;

  const std::vector<Node>& nodes_;
  const DofMap& dofs_;
  RigidMotions rigid_;
  std::unordered_map<int, Row> known_;              // dependent variable by independent ones
  std::unordered_map<int, std::vector<int>> used_;  // dependent variables with an independent one
};

Row Eliminator::replaced(const Row& row) const {
  Row out;
  for (const auto& [dof, factor] : row) {
    const auto known = known_.find(dof);
    if (known == known_.end()) {
      out[dof] += factor;
      continue;
    }
    for (const auto& [other, share] : known->second) out[other] += factor * share;
  }
  return out;
}

int Eliminator::pivot_of(const Row& row, int wanted) const {
  double largest = 0.0;
  int best = -1;
  for (const auto& [dof, factor] : row) {
    const double weight = std::abs(factor) * rigid_.size[dof];
    if (weight > largest * (1 + 1e-9)) {
      largest = weight;
      best = dof;
    }
  }
  const auto found = row.find(wanted);
  if (found == row.end()) return best;
  return std::abs(found->second) * rigid_.size[wanted] >= kPivot * largest ? wanted : best;
}

void Eliminator::eliminate(const Row& given, int wanted) {
  double scale = 0.0;
  for (const auto& [dof, factor] : given) {
    scale = std::max(scale, std::abs(factor) * rigid_.size[dof]);
  }
  Row row = replaced(given);
  std::erase_if(row, [&](const auto& entry) {
    return std::abs(entry.second) * rigid_.size[entry.first] <= kNothing * scale;
  });
  if (row.empty()) return;
  const int pivot = pivot_of(row, wanted);
  const double by = -1.0 / row.at(pivot);
  row.erase(pivot);
  for (auto& [dof, factor] : row) factor *= by;
  for (const int dependent : used_[pivot]) {
    Row& own = known_.at(dependent);
    const auto found = own.find(pivot);
    if (found == own.end()) continue;
    const double share = found->second;
    own.erase(found);
    for (const auto& [dof, factor] : row) {
      if (own.emplace(dof, 0.0).second) used_[dof].push_back(dependent);
      own[dof] += share * factor;
    }
  }
  used_.erase(pivot);
  for (const auto& [dof, factor] : row) used_[dof].push_back(pivot);
  known_.emplace(pivot, std::move(row));
}

void Eliminator::add(const RigidLink& link) {
  const Vector3d centre = place(link.reference);
  for (const int node : link.nodes) {
    if (node == link.reference) continue;
    const Vector3d r = place(node) - centre;
    for (int k = 0; k < 6; ++k) {
      const int own = dof(node, k);
      if (own < 0 || !link.variables[static_cast<std::size_t>(k)]) continue;
      Row row{{own, 1.0}};
      if (const int same = dof(link.reference, k); same >= 0) row[same] -= 1.0;
      for (int axis = 0; axis < 3 && k < 3; ++axis) {
        const double arm = Vector3d::Unit(axis).cross(r)[k];
        const int turn = dof(link.reference, 3 + axis);
        if (turn >= 0 && arm != 0.0) row[turn] -= arm;
      }
      eliminate(row, own);
    }
  }
}

void Eliminator::add(const AverageLink& link) {
  const PointRows rows = average_rows(nodes_, dofs_, link, 1.0 / rigid_.size.minCoeff());
  std::array<Row, 6> mean;
  for (const Triplet& entry : rows.translation) {
    mean[static_cast<std::size_t>(entry.row())][entry.col()] -= entry.value();
  }
  for (const Triplet& entry : rows.rotation) {
    mean[static_cast<std::size_t>(3 + entry.row())][entry.col()] -= entry.value();
  }
  for (int k = 0; k < 6; ++k) {
    const int own = dof(link.reference, k);
    if (own < 0 || !link.variables[static_cast<std::size_t>(k)]) continue;
    Row& row = mean[static_cast<std::size_t>(k)];
    row[own] += 1.0;
    eliminate(row, own);
  }
}

/// Corrects rounding of the coefficients, so that rigid motion stays possible to the last digit.
void Eliminator::require_free(Row& row, const std::string& label) const {
  Eigen::MatrixXd motions(static_cast<Eigen::Index>(row.size()), 6);
  Eigen::VectorXd c(motions.rows());
  Eigen::Index k = 0;
  for (const auto& [dof, factor] : row) {
    motions.row(k) = rigid_.columns.row(dof) / rigid_.size[dof];
    c[k++] = factor * rigid_.size[dof];
  }
  const Eigen::VectorXd work = motions.transpose() * c;
  const linalg::SingularValues svd = linalg::singular_values(motions, linalg::LeftVectors::thin);
  const Eigen::MatrixXd U = svd.U.leftCols(svd.rank(1e-10));
  const Eigen::VectorXd mended = c - U * (U.transpose() * c);
  if ((mended - c).norm() > kRounding * c.norm()) {
    Eigen::Index worst = 0;
    work.cwiseAbs().maxCoeff(&worst);
    throw ModelError(fmt::format(
        "{}: it holds the body against rigid {} {}; inside a body an equation may relate motions "
        "of nodes to each other only (give an offset its lever times the rotation), hold the body "
        "by a joint to ground instead",
        label, worst < 3 ? "displacement along" : "rotation about", "xyz"[worst % 3]));
  }
  k = 0;
  for (auto& [dof, factor] : row) factor = mended[k++] / rigid_.size[dof];
}

void Eliminator::add(const LinearEquation& equation) {
  Row row;
  int wanted = -1;
  for (const LinearEquation::Term& term : equation.terms) {
    if (term.coefficient == 0.0) continue;
    const int own = dof(term.node, term.variable);
    if (own < 0) {
      throw ModelError(fmt::format(
          "{}: {} has no variable {}; solids and bars have displacements only, planar models those "
          "of their plane",
          equation.label, node_label(nodes_, term.node),
          kVariables[static_cast<std::size_t>(term.variable)]));
    }
    if (wanted < 0) wanted = own;
    row[own] += term.coefficient;
  }
  if (row.empty()) {
    throw ModelError(equation.label + ": all its coefficients are zero; remove it");
  }
  require_free(row, equation.label);
  eliminate(row, wanted);
}

Elimination Eliminator::result() const {
  Elimination out;
  out.dofs = dofs_;
  out.dofs.num_dofs = 0;
  std::vector<int> number(static_cast<std::size_t>(dofs_.num_dofs), -1);
  for (auto& node : out.dofs.node_dofs) {
    bool is_free = true;
    for (int& dof : node) {
      if (dof < 0) continue;
      const int old = dof;
      const bool depends = known_.contains(old);
      is_free = is_free && !depends;
      dof = depends ? -1 : out.dofs.num_dofs++;
      number[static_cast<std::size_t>(old)] = dof;
    }
    out.is_free.push_back(is_free);
  }
  std::vector<Triplet> entries;
  for (int old = 0; old < dofs_.num_dofs; ++old) {
    if (const int own = number[static_cast<std::size_t>(old)]; own >= 0) {
      entries.emplace_back(old, own, 1.0);
      continue;
    }
    for (const auto& [dof, factor] : known_.at(old)) {
      entries.emplace_back(old, number[static_cast<std::size_t>(dof)], factor);
    }
  }
  out.T.resize(dofs_.num_dofs, out.dofs.num_dofs);
  out.T.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

Elimination eliminate(const std::vector<Node>& nodes, const DofMap& dofs, const NodeLinks& links) {
  Eliminator eliminator(nodes, dofs);
  for (const RigidLink& link : links.rigid) eliminator.add(link);
  for (const AverageLink& link : links.averages) eliminator.add(link);
  for (const LinearEquation& equation : links.equations) eliminator.add(equation);
  return eliminator.result();
}

}  // namespace buckens::fem

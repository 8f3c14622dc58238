// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/loose_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/element/block.h"
#include "buckens/fem/element/node_label.h"
#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::body {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Share of a node's mass that a motion of it must have: rounding stays below 1e-15, nodes that are
// nearly on a line above 1e-10.
constexpr double kMassless = 1e-12;
// Nodes around a loose one that are looked at first: those of one element.
constexpr std::size_t kFewest = 8;

/// The variables of a node, which follow each other where links are solved.
struct OwnVariables {
  int first = 0, count = 0;
  std::array<int, 6> kinds{};  // 0…2 translations, 3…5 rotations
};

OwnVariables variables_of(const fem::DofMap& dofs, int node) {
  OwnVariables out;
  for (int k = 0; k < 6; ++k) {
    const int dof = dofs.node_dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(k)];
    if (dof < 0) continue;
    if (out.count == 0) out.first = dof;
    out.kinds[static_cast<std::size_t>(out.count++)] = k;
  }
  return out;
}

/// Calls visit(node, block) with the entries of a symmetric matrix between the variables of each of
/// these nodes, which are all that is read of it.
template <class Visit>
void visit_blocks(const linalg::SymmetricMatrix& A, const fem::DofMap& dofs,
                  const std::vector<int>& nodes, Visit&& visit) {
  if (nodes.empty()) return;
  std::vector<int> lengths(static_cast<std::size_t>(dofs.num_dofs), 0);
  for (const int node : nodes) {
    const OwnVariables own = variables_of(dofs, node);
    for (int k = 0; k < own.count; ++k) {
      lengths[static_cast<std::size_t>(own.first + k)] = own.count - k;
    }
  }
  const VectorXd entries = A.near_diagonal(lengths);
  const double* next = entries.data();
  for (const int node : nodes) {
    const int count = variables_of(dofs, node).count;
    MatrixXd block(count, count);
    for (int column = 0; column < count; ++column) {
      for (int row = column; row < count; ++row) block(row, column) = block(column, row) = *next++;
    }
    visit(node, block);
  }
}

/// Roots of the diagonal; variables without an entry stand for themselves.
VectorXd sizes_of(const MatrixXd& A) {
  return (A.diagonal().array() > 0.0).select(A.diagonal().cwiseSqrt(), VectorXd::Ones(A.rows()));
}

/// Motions among the columns of Z that a matrix resists by less than a share of its diagonal,
/// orthonormal where each variable counts by the root of its entry there.
MatrixXd unresisted(const MatrixXd& A, const MatrixXd& Z) {
  const VectorXd size = sizes_of(A);
  const MatrixXd own = linalg::orthonormal_span(size.asDiagonal() * Z);
  const MatrixXd scaled = size.cwiseInverse().asDiagonal() * A * size.cwiseInverse().asDiagonal();
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(own.transpose() * scaled * own);
  Eigen::Index count = 0;
  while (count < Z.cols() && eigen.values[count] <= kMassless) ++count;
  return size.cwiseInverse().asDiagonal() * (own * eigen.vectors.leftCols(count));
}

/// Whether every motion has mass: most nodes are done with after this.
bool has_mass_everywhere(const MatrixXd& M) {
  if (!(M.diagonal().minCoeff() > 0.0)) return false;
  const VectorXd size = M.diagonal().cwiseSqrt().cwiseInverse();
  const linalg::DenseCholesky factor(size.asDiagonal() * M * size.asDiagonal());
  // det = Π λ with Σ λ = n: the least eigenvalue is at least det (1 − 1/n)^(n − 1) > det / 3.
  return factor.is_positive_definite() && factor.diagonal().prod() > 1e-3;
}

/// Nodes of beams, bars, solids and shells.
std::vector<int> nodes_of_elements(const fem::FeModel& full) {
  std::vector<int> out;
  for (const auto& block : full.blocks) {
    if (!block->is_line() && !block->is_solid() && !block->is_shell()) continue;
    for (int e = 0; e < block->num_elements(); ++e) {
      const auto own = block->nodes(e);
      out.insert(out.end(), own.begin(), own.end());
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

class Follower {
 public:
  Follower(const std::string& body, const fem::FeModel& full)
      : body_(body), full_(full), candidates_(nodes_of_elements(full)) {
    owners_.resize(static_cast<std::size_t>(full.dofs.num_dofs));
    for (std::size_t node = 0; node < full.nodes.size(); ++node) {
      for (std::size_t k = 0; k < 6; ++k) {
        const int dof = full.dofs.node_dofs[node][k];
        if (dof < 0) continue;
        owners_[static_cast<std::size_t>(dof)] = {static_cast<int>(node), static_cast<int>(k)};
      }
    }
  }

  fem::LinearEquation equation(const LooseMotion& motion) {
    if (motion.node >= static_cast<int>(full_.nodes.size())) {
      throw ModelError(
          fmt::format("body \"{}\": the nodes of a rigid interface lie on one line or "
                      "at one point; choose nodes that span a surface",
                      body_));
    }
    const fem::PointRows& rows = rows_at(motion.node);
    fem::LinearEquation out;
    out.label = fmt::format("{}, which moves neither mass nor an element",
                            fem::node_label(full_.nodes, motion.node));
    for (int k = 0; k < 6; ++k) {
      if (motion.variables[k] != 0.0) out.terms.push_back({motion.node, k, motion.variables[k]});
    }
    const auto largest =
        std::max_element(out.terms.begin(), out.terms.end(), [](const auto& a, const auto& b) {
          return std::abs(a.coefficient) < std::abs(b.coefficient);
        });
    std::iter_swap(out.terms.begin(), largest);
    add(rows.translation, motion.variables.head<3>(), out);
    add(rows.rotation, motion.variables.tail<3>(), out);
    return out;
  }

 private:
  /// The rigid motion of the nearest nodes that tell rotations.
  const fem::PointRows& rows_at(int node) {
    if (node == last_) return rows_;
    const auto place = [&](int n) { return full_.nodes[static_cast<std::size_t>(n)].position; };
    std::vector<int> others;
    std::copy_if(candidates_.begin(), candidates_.end(), std::back_inserter(others),
                 [node](int n) { return n != node; });
    for (std::size_t count = kFewest;; count *= 2) {
      const std::size_t taken = std::min(count, others.size());
      std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(taken),
                        others.end(), [&](int a, int b) {
                          const double da = (place(a) - place(node)).squaredNorm();
                          const double db = (place(b) - place(node)).squaredNorm();
                          return da != db ? da < db : a < b;
                        });
      std::vector<int> nearest(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(taken));
      std::sort(nearest.begin(), nearest.end());
      const fem::NodeRegion region =
          fem::weighted_region(full_.nodes, nearest, std::vector<double>(taken, 1.0));
      if (taken > 0 && region.turns()) {
        rows_ = fem::region_rows(full_, region, place(node));
        last_ = node;
        return rows_;
      }
      if (taken == others.size()) break;
    }
    // All on one line: the nearest of those that have rotations leads alone.
    for (const int other : others) {
      const auto& own = full_.dofs.node_dofs[static_cast<std::size_t>(other)];
      if (*std::min_element(own.begin(), own.end()) < 0) continue;
      rows_ = rigid_rows(own, place(node) - place(other));
      last_ = node;
      return rows_;
    }
    refuse(node);
  }

  /// Motion at the arm r from a node: u + θ × r, θ.
  static fem::PointRows rigid_rows(const std::array<int, 6>& dofs, const Eigen::Vector3d& r) {
    fem::PointRows out;
    out.has_rotation = true;
    for (int row = 0; row < 3; ++row) {
      const auto axis = static_cast<std::size_t>(row);
      out.translation.emplace_back(row, dofs[axis], 1.0);
      out.rotation.emplace_back(row, dofs[3 + axis], 1.0);
      // (θ × r)_row = θ_b r_c − θ_c r_b with row, b, c in cyclic order.
      const int b = (row + 1) % 3, c = (row + 2) % 3;
      out.translation.emplace_back(row, dofs[static_cast<std::size_t>(3 + b)], r[c]);
      out.translation.emplace_back(row, dofs[static_cast<std::size_t>(3 + c)], -r[b]);
    }
    return out;
  }

  [[noreturn]] void refuse(int node) const {
    throw ModelError(fmt::format(
        "body \"{}\": {} can move or turn without moving any mass, since what is linked to it does "
        "not hold it in all directions; link nodes that span a surface, or nodes with rotations, "
        "or give it a point mass with inertia",
        body_, fem::node_label(full_.nodes, node)));
  }

  void add(const std::vector<linalg::Triplet>& rows, const Eigen::Vector3d& shares,
           fem::LinearEquation& out) const {
    for (const linalg::Triplet& entry : rows) {
      const double share = shares[entry.row()];
      if (share == 0.0) continue;
      const auto& [node, variable] = owners_[static_cast<std::size_t>(entry.col())];
      out.terms.push_back({node, variable, -share * entry.value()});
    }
  }

  const std::string& body_;
  const fem::FeModel& full_;
  std::vector<int> candidates_;
  std::vector<std::pair<int, int>> owners_;  // node and variable of each degree of freedom
  int last_ = -1;
  fem::PointRows rows_;
};

}  // namespace

std::vector<LooseMotion> loose_motions(const fem::FeModel& fe) {
  std::vector<int> nodes;
  for (int node = 0; node < static_cast<int>(fe.dofs.node_dofs.size()); ++node) {
    if (variables_of(fe.dofs, node).count > 0) nodes.push_back(node);
  }
  std::vector<int> light;
  std::vector<MatrixXd> massless;  // motions of each of these
  visit_blocks(fe.M, fe.dofs, nodes, [&](int node, const MatrixXd& M) {
    if (has_mass_everywhere(M)) return;
    MatrixXd own = unresisted(M, MatrixXd::Identity(M.rows(), M.cols()));
    if (own.cols() == 0) return;
    light.push_back(node);
    massless.push_back(std::move(own));
  });
  std::vector<LooseMotion> out;
  auto next = massless.cbegin();
  visit_blocks(fe.K, fe.dofs, light, [&](int node, const MatrixXd& K) {
    const OwnVariables own = variables_of(fe.dofs, node);
    const MatrixXd loose = unresisted(K, *next++);
    for (Eigen::Index z = 0; z < loose.cols(); ++z) {
      LooseMotion motion{node, Eigen::Matrix<double, 6, 1>::Zero()};
      const double largest = loose.col(z).cwiseAbs().maxCoeff();
      for (int k = 0; k < own.count; ++k) {
        // What is left by rounding would couple variables that have nothing to do with it.
        const double share = loose(k, z) / largest;
        if (std::abs(share) < 1e-13) continue;
        motion.variables[own.kinds[static_cast<std::size_t>(k)]] = share;
      }
      out.push_back(motion);
    }
  });
  return out;
}

std::vector<fem::LinearEquation> follow_nearest(const std::string& body, const fem::FeModel& full,
                                                const std::vector<LooseMotion>& motions) {
  Follower follower(body, full);
  std::vector<fem::LinearEquation> out;
  for (const LooseMotion& motion : motions) out.push_back(follower.equation(motion));
  return out;
}

std::string loose_motions_note(const fem::FeModel& full, const std::vector<LooseMotion>& motions) {
  std::set<int> nodes;
  for (const LooseMotion& motion : motions) nodes.insert(motion.node);
  std::string out = fem::node_label(full.nodes, motions.front().node);
  if (nodes.size() > 1) out += fmt::format(" and {} others", nodes.size() - 1);
  return out + (nodes.size() > 1 ? " move or turn" : " moves or turns") +
         " in some directions without mass or stiffness; there they follow the elements around";
}

}  // namespace buckens::body

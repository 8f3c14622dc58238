// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/body_matrices.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

// Masses of a body agree in the three directions within this fraction; matrices are often written
// with about seven digits.
constexpr double kSameMass = 1e-6;
// Entries of blocks that are to be multiples of the unit matrix: above rounding of their sums.
constexpr double kSameEntry = 1e-10;

constexpr std::array<std::array<int, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// The permutation symbol.
int epsilon(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

/// Where a row of the matrices belongs.
struct DofPlace {
  int node = -1;
  int variable = -1;
};

std::vector<DofPlace> places_of(const DofMap& dofs) {
  std::vector<DofPlace> out(static_cast<std::size_t>(dofs.num_dofs));
  for (std::size_t node = 0; node < dofs.node_dofs.size(); ++node) {
    for (int k = 0; k < 6; ++k) {
      const int dof = dofs.node_dofs[node][static_cast<std::size_t>(k)];
      if (dof >= 0) out[static_cast<std::size_t>(dof)] = {static_cast<int>(node), k};
    }
  }
  return out;
}

class IntegralMaker {
 public:
  explicit IntegralMaker(const BodyMatrices& body)
      : body_(body), places_(places_of(body.dofs)), n_(body.dofs.num_dofs) {}

  ShapeIntegrals run() {
    find_mass();
    if (has_scalar_masses()) {
      make_nodal();
    } else {
      uses_nodal_ = false;
    }
    for (int column = 0; column < n_; ++column) {
      for (SparseMatrix::InnerIterator it(body_.M, column); it; ++it) {
        add_products(static_cast<int>(it.row()), column, it.value());
      }
    }
    for (std::size_t k = 0; k < 6; ++k) {
      out_.W[k].resize(n_, n_);
      out_.W[k].setFromTriplets(W_[k].begin(), W_[k].end());
      W_[k] = {};
    }
    make_moments();
    return std::move(out_);
  }

 private:
  const Vector3d& position(int node) const {
    return body_.nodes[static_cast<std::size_t>(node)].position;
  }
  int dof(int node, int variable) const {
    return body_.dofs.node_dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(variable)];
  }

  /// Rigid motions about a point.
  Matrix rigid(const Vector3d& origin) const {
    Matrix out = Matrix::Zero(n_, 6);
    for (int i = 0; i < n_; ++i) {
      const auto [node, variable] = places_[static_cast<std::size_t>(i)];
      if (variable >= 3) {
        out(i, variable) = 1.0;
        continue;
      }
      out(i, variable) = 1.0;
      const Vector3d x = position(node) - origin;
      for (int axis = 0; axis < 3; ++axis) {
        out(i, 3 + axis) = Vector3d::Unit(axis).cross(x)[variable];
      }
    }
    return out;
  }

  void find_mass() {
    // About the middle of the nodes, so that places far from the origin cost no digits.
    Vector3d middle = Vector3d::Zero();
    for (const Node& node : body_.nodes) middle += node.position;
    middle /= static_cast<double>(body_.nodes.size());
    const Matrix Phi = rigid(middle);
    const Matrix S = Phi.transpose() * (body_.M * Phi);
    const Vector3d masses = S.diagonal().head<3>();
    out_.mass = masses.mean();
    if (!(masses.minCoeff() > 0.0)) {
      throw ModelError(
          fmt::format("the mass matrix gives the body the masses {:g}, {:g}, {:g} kg "
                      "along x, y, z; all must be positive. Is it the mass matrix, "
                      "and is no node held?",
                      masses[0], masses[1], masses[2]));
    }
    const double coupled = std::abs(S(0, 1)) + std::abs(S(0, 2)) + std::abs(S(1, 2));
    if (masses.maxCoeff() - masses.minCoeff() > kSameMass * out_.mass ||
        coupled > kSameMass * out_.mass) {
      throw ModelError(fmt::format(
          "the mass matrix gives the body different masses along x, y, z: {:g}, {:g}, {:g} kg. "
          "Rows are missing (of held nodes?), or the table of nodes names the wrong ones",
          masses[0], masses[1], masses[2]));
    }
    out_.com = middle + Vector3d(S(1, 5) - S(2, 4), S(2, 3) - S(0, 5), S(0, 4) - S(1, 3)) /
                            (2.0 * out_.mass);
  }

  /// Whether all blocks between translations are multiples of the unit matrix.
  bool has_scalar_masses() {
    double largest = 0.0;
    for (int i = 0; i < n_; ++i) {
      if (places_[static_cast<std::size_t>(i)].variable < 3) {
        largest = std::max(largest, body_.M.coeff(i, i));
      }
    }
    const double limit = kSameEntry * largest;
    for (int column = 0; column < n_; ++column) {
      const DofPlace to = places_[static_cast<std::size_t>(column)];
      if (to.variable >= 3) continue;
      for (SparseMatrix::InnerIterator it(body_.M, column); it; ++it) {
        const DofPlace from = places_[static_cast<std::size_t>(it.row())];
        if (from.variable >= 3) continue;
        if (from.variable != to.variable) {
          if (std::abs(it.value()) > limit) return false;
          continue;
        }
        const int next = (to.variable + 1) % 3;
        const double other = body_.M.coeff(dof(from.node, next), dof(to.node, next));
        if (std::abs(other - it.value()) > limit) return false;
      }
    }
    return true;
  }

  void make_nodal() {
    std::vector<Triplet> entries;
    for (int column = 0; column < n_; ++column) {
      const DofPlace to = places_[static_cast<std::size_t>(column)];
      if (to.variable >= 3) continue;
      for (SparseMatrix::InnerIterator it(body_.M, column); it; ++it) {
        const DofPlace from = places_[static_cast<std::size_t>(it.row())];
        if (from.variable != to.variable) continue;
        entries.emplace_back(from.node, to.node, it.value() / 3.0);
      }
    }
    const auto count = static_cast<int>(body_.nodes.size());
    SparseMatrix Ms(count, count);
    Ms.setFromTriplets(entries.begin(), entries.end());
    out_.nodal.Ms = linalg::SharedMatrix(std::move(Ms));
    for (const auto& node : body_.dofs.node_dofs) {
      out_.nodal.dofs.push_back({node[0], node[1], node[2]});
    }
  }

  /// What the entry M(i, j) adds to the six matrices W.
  void add_products(int i, int j, double m) {
    const auto [node_i, p] = places_[static_cast<std::size_t>(i)];
    const auto [node_j, q] = places_[static_cast<std::size_t>(j)];
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [a, b] = kPairs[k];
      auto& W = W_[k];
      if (p < 3 && q < 3) {
        if (uses_nodal_) return;
        if (a == q) W.emplace_back(i, dof(node_j, b), 0.5 * m);
        if (b == p) W.emplace_back(dof(node_i, a), j, 0.5 * m);
      } else if (p < 3) {
        if (b == p) W.emplace_back(dof(node_i, a), j, m);
      } else if (q < 3) {
        if (a == q) W.emplace_back(i, dof(node_j, b), m);
      } else {
        add_rotations(node_i, p - 3, node_j, q - 3, m, a, b, W);
      }
    }
  }

  /// ε_aij ε_bkl E_jl with E = ½ tr(X) 1 − Xᵀ, for X with the one entry X(p, q) = m.
  void add_rotations(int node_i, int p, int node_j, int q, double m, int a, int b,
                     std::vector<Triplet>& W) const {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        double value = -m * epsilon(a, i, q) * epsilon(b, k, p);
        if (p == q) value += 0.5 * m * ((a == b && i == k ? 1 : 0) - (a == k && i == b ? 1 : 0));
        if (value != 0.0) W.emplace_back(dof(node_i, 3 + i), dof(node_j, 3 + k), value);
      }
    }
  }

  /// c and J0, from the mass centre.
  void make_moments() {
    const Matrix Phi = rigid(out_.com);
    const Matrix P = body_.M * Phi;
    out_.J0 = Phi.rightCols<3>().transpose() * P.rightCols<3>();
    out_.J0 = (0.5 * (out_.J0 + out_.J0.transpose())).eval();
    out_.C0 = 0.5 * out_.J0.trace() * Matrix3d::Identity() - out_.J0;

    // Displacements s0_a e_b of the nodes, column 3a + b.
    Matrix fields = Matrix::Zero(n_, 9);
    Matrix turns = Matrix::Zero(n_, 3);
    for (int i = 0; i < n_; ++i) {
      const auto [node, variable] = places_[static_cast<std::size_t>(i)];
      if (variable >= 3) {
        turns(i, variable - 3) = 1.0;
        continue;
      }
      const Vector3d x = position(node) - out_.com;
      for (int a = 0; a < 3; ++a) fields(i, 3 * a + variable) = x[a];
    }
    out_.c = body_.M * fields;
    const Matrix T = body_.M * turns;  // forces of a common rotation of all nodes
    for (std::size_t node = 0; node < body_.nodes.size(); ++node) {
      add_turns(static_cast<int>(node), T);
    }
  }

  /// What nodal rotations add to c at a node.
  void add_turns(int node, const Matrix& T) {
    add_offsets(node, T);
    if (dof(node, 3) < 0) return;
    Matrix3d X;
    for (int i = 0; i < 3; ++i) X.row(i) = rotations_only(node, i);
    const Matrix3d E = 0.5 * X.trace() * Matrix3d::Identity() - X.transpose();
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        for (int k = 0; k < 3; ++k) {
          for (int l = 0; l < 3; ++l) {
            out_.c(dof(node, 3 + k), 3 * a + b) += epsilon(b, k, l) * E(l, a);
          }
        }
      }
    }
  }

  /// Sum of the blocks between the rotation `axis` of a node and all rotations.
  Eigen::RowVector3d rotations_only(int node, int axis) const {
    Eigen::RowVector3d out = Eigen::RowVector3d::Zero();
    for (SparseMatrix::InnerIterator it(body_.M, dof(node, 3 + axis)); it; ++it) {
      const DofPlace from = places_[static_cast<std::size_t>(it.row())];
      if (from.variable >= 3) out[from.variable - 3] += it.value();
    }
    return out;
  }

  /// A block r between the translations of a node and a common rotation is that of points whose
  /// first moment is S, r = −S×; c_ab takes S_a e_b from it. The non-skew part of r is distributed
  /// so that c_ab − c_ba stays exact.
  void add_offsets(int node, const Matrix& T) {
    Matrix3d r;
    for (int i = 0; i < 3; ++i) r.row(i) = T.row(dof(node, i));
    const Matrix3d rest = 0.5 * (r + r.transpose());
    const Vector3d S = 0.5 * Vector3d(r(1, 2) - r(2, 1), r(2, 0) - r(0, 2), r(0, 1) - r(1, 0));
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        Vector3d share = S[a] * Vector3d::Unit(b);
        for (int c = 0; c < 3; ++c) share += 0.5 * epsilon(a, b, c) * rest.col(c);
        for (int i = 0; i < 3; ++i) out_.c(dof(node, i), 3 * a + b) += share[i];
      }
    }
  }

  const BodyMatrices& body_;
  std::vector<DofPlace> places_;
  int n_;
  bool uses_nodal_ = true;
  std::array<std::vector<Triplet>, 6> W_;
  ShapeIntegrals out_;
};

}  // namespace

ShapeIntegrals matrix_integrals(const BodyMatrices& body) { return IntegralMaker(body).run(); }

}  // namespace buckens::fem

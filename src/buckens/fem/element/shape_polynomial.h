// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace buckens::fem {

/// A vector field along a line element as a polynomial in ξ ∈ [0, 1], linear in N nodal variables:
/// g(ξ) = Σ ξ^k terms[k] q.
template <int N>
struct ShapePolynomial {
  using Term = Eigen::Matrix<double, 3, N>;
  std::array<Term, 4> terms = {Term::Zero(), Term::Zero(), Term::Zero(), Term::Zero()};
  int degree = 0;  ///< higher terms are zero

  Term at(double xi) const {
    Term value = terms[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k)
      value = (value * xi + terms[static_cast<std::size_t>(k)]).eval();
    return value;
  }
};

/// A straight line of points: origin + ξ slope.
struct LinePosition {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};

/// Inertia integrals of one element in model axes.
template <int N>
struct ElementInertia {
  using Square = Eigen::Matrix<double, N, N>;
  /// W_11, W_22, W_33, W_12, W_13, W_23.
  std::array<Square, 6> W = {Square::Zero(), Square::Zero(), Square::Zero(),
                             Square::Zero(), Square::Zero(), Square::Zero()};
  Eigen::Matrix<double, N, 9> c = Eigen::Matrix<double, N, 9>::Zero();
  Eigen::Matrix3d C0 = Eigen::Matrix3d::Zero();

  /// Adds ∫ over ξ of `weight` ξ^power times the products of g and the position s, by the exact
  /// integrals of monomials ∫ ξ^k dξ = 1/(k+1).
  void add(double weight, const ShapePolynomial<N>& g, const LinePosition& s, int power = 0) {
    for (int i = 0; i <= g.degree; ++i) {
      for (int j = 0; j <= g.degree; ++j) add_product(weight / (i + j + power + 1), g, i, j);
      const Eigen::Vector3d moment =
          weight / (i + power + 1) * s.origin + weight / (i + power + 2) * s.slope;
      const auto& term = g.terms[static_cast<std::size_t>(i)];
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) c.col(3 * a + b) += moment[a] * term.row(b).transpose();
      }
    }
    const Eigen::Matrix3d mixed = s.origin * s.slope.transpose();
    C0 += weight * (s.origin * s.origin.transpose() / (power + 1.0) +
                    (mixed + mixed.transpose()) / (power + 2.0) +
                    s.slope * s.slope.transpose() / (power + 3.0));
  }

  /// Removes rounding errors from the symmetry of W_aa.
  void symmetrise() {
    for (std::size_t a = 0; a < 3; ++a) W[a] = (0.5 * (W[a] + W[a].transpose())).eval();
  }

 private:
  void add_product(double weight, const ShapePolynomial<N>& g, int i, int j) {
    static constexpr std::array<std::array<int, 2>, 6> kPairs = {
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    const auto& left = g.terms[static_cast<std::size_t>(i)];
    const auto& right = g.terms[static_cast<std::size_t>(j)];
    for (std::size_t k = 0; k < kPairs.size(); ++k) {
      W[k].noalias() += weight * left.row(kPairs[k][0]).transpose() * right.row(kPairs[k][1]);
    }
  }
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/shape.h"

#include "buckens/fem/element/quadrature.h"

namespace buckens::fem {

namespace {

using Place = std::array<double, 2>;
using Piece = std::array<int, 4>;

constexpr std::array<Place, 8> kQuadPlaces = {{{-1.0, -1.0},
                                               {1.0, -1.0},
                                               {1.0, 1.0},
                                               {-1.0, 1.0},
                                               {0.0, -1.0},
                                               {1.0, 0.0},
                                               {0.0, 1.0},
                                               {-1.0, 0.0}}};
constexpr std::array<Place, 6> kTrianglePlaces = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};

constexpr std::array<int, 4> kLinearRim = {0, 1, 2, 3};
constexpr std::array<int, 6> kTriangleRim = {0, 3, 1, 4, 2, 5};
constexpr std::array<int, 8> kQuadRim = {0, 4, 1, 5, 2, 6, 3, 7};

constexpr std::array<Piece, 1> kTri3Pieces = {{{0, 1, 2, -1}}};
constexpr std::array<Piece, 1> kQuad4Pieces = {{{0, 1, 2, 3}}};
constexpr std::array<Piece, 4> kTri6Pieces = {
    {{0, 3, 5, -1}, {3, 1, 4, -1}, {5, 4, 2, -1}, {3, 4, 5, -1}}};
constexpr std::array<Piece, 5> kQuad8Pieces = {
    {{0, 4, 7, -1}, {4, 1, 5, -1}, {5, 2, 6, -1}, {6, 3, 7, -1}, {4, 5, 6, 7}}};

ShellShape triangle_6(double r, double s) {
  const double t = 1 - r - s;
  ShellShape out;
  out.N.resize(6);
  out.N << t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t;
  out.slope.resize(2, 6);
  out.slope << 1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s, 1 - 4 * t, 0, 4 * s - 1, -4 * r,
      4 * r, 4 * (t - s);
  return out;
}

ShellShape quadrilateral_8(double r, double s) {
  ShellShape out;
  out.N.resize(8);
  out.slope.resize(2, 8);
  for (Eigen::Index k = 0; k < 8; ++k) {
    const auto [a, b] = kQuadPlaces[static_cast<std::size_t>(k)];
    if (a == 0) {
      out.N[k] = 0.5 * (1 - r * r) * (1 + b * s);
      out.slope.col(k) << -r * (1 + b * s), 0.5 * b * (1 - r * r);
    } else if (b == 0) {
      out.N[k] = 0.5 * (1 + a * r) * (1 - s * s);
      out.slope.col(k) << 0.5 * a * (1 - s * s), -s * (1 + a * r);
    } else {
      out.N[k] = 0.25 * (1 + a * r) * (1 + b * s) * (a * r + b * s - 1);
      out.slope.col(k) << 0.25 * a * (1 + b * s) * (2 * a * r + b * s),
          0.25 * b * (1 + a * r) * (a * r + 2 * b * s);
    }
  }
  return out;
}

}  // namespace

ShellShape shell_shape(Eigen::Index num_nodes, double r, double s) {
  if (num_nodes == 8) return quadrilateral_8(r, s);
  if (num_nodes == 6) return triangle_6(r, s);
  ShellShape out;
  if (num_nodes == 3) {
    out.N.resize(3);
    out.N << 1 - r - s, r, s;
    out.slope.resize(2, 3);
    out.slope << -1, 1, 0, -1, 0, 1;
    return out;
  }
  out.N.resize(4);
  out.N << (1 - r) * (1 - s), (1 + r) * (1 - s), (1 + r) * (1 + s), (1 - r) * (1 + s);
  out.N *= 0.25;
  out.slope.resize(2, 4);
  out.slope << -(1 - s), 1 - s, 1 + s, -(1 + s), -(1 - r), -(1 + r), 1 + r, 1 - r;
  out.slope *= 0.25;
  return out;
}

std::span<const Place> shell_node_places(Eigen::Index num_nodes) {
  const std::span<const Place> all =
      is_shell_triangle(num_nodes) ? std::span<const Place>(kTrianglePlaces) : kQuadPlaces;
  return all.first(static_cast<std::size_t>(num_nodes));
}

std::span<const int> shell_rim(Eigen::Index num_nodes) {
  if (num_nodes == 6) return kTriangleRim;
  if (num_nodes == 8) return kQuadRim;
  return std::span<const int>(kLinearRim).first(static_cast<std::size_t>(num_nodes));
}

std::span<const Piece> shell_pieces(Eigen::Index num_nodes) {
  if (num_nodes == 6) return kTri6Pieces;
  if (num_nodes == 8) return kQuad8Pieces;
  if (num_nodes == 3) return kTri3Pieces;
  return kQuad4Pieces;
}

std::vector<ShellRulePoint> shell_rule(bool is_triangle, int n) {
  const LineRule first = gauss_jacobi(n, is_triangle ? 1 : 0), second = gauss_jacobi(n, 0);
  std::vector<ShellRulePoint> out;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double weight = first.weight[i] * second.weight[j];
      if (is_triangle) {
        const double r = 0.5 * (1 + first.place[i]);
        out.push_back({r, 0.5 * (1 + second.place[j]) * (1 - r), weight / 8});
      } else {
        out.push_back({first.place[i], second.place[j], weight});
      }
    }
  }
  return out;
}

std::vector<ShellRulePoint> triangle_rule_of_degree_4() {
  std::vector<ShellRulePoint> out;
  const auto add = [&out](double b, double weight) {  // area coordinates 1 − 2b, b, b
    out.push_back({b, b, 0.5 * weight});
    out.push_back({1 - 2 * b, b, 0.5 * weight});
    out.push_back({b, 1 - 2 * b, 0.5 * weight});
  };
  add(0.44594849091596488632, 0.22338158967801146570);
  add(0.09157621350977074346, 0.10995174365532186764);
  return out;
}

std::vector<ShellRulePoint> shell_mass_rule(Eigen::Index num_nodes) {
  // Degree of N_i N_j times the area: in each coordinate 4 + 3 with eight nodes, in total 4 + 2
  // with six.
  return shell_rule(is_shell_triangle(num_nodes), is_shell_quadratic(num_nodes) ? 4 : 3);
}

}  // namespace buckens::fem

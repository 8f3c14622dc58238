// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "buckens/fem/element/elasticity.h"

namespace buckens::fem {

/// The sum ∫ Bᵀ D B dV of an element, point by point, from the gradients g of its functions. Each
/// has three columns in B, those of its displacement in x, y and z, with three strains each:
///
///     xx  g_x  ·   ·
///     yy   ·  g_y  ·
///     zz   ·   ·  g_z
///     xy  g_y g_x  ·
///     yz   ·  g_z g_y
///     zx  g_z  ·  g_x
///
/// Nothing is multiplied by the zeros: 27 (functions)² multiply-adds a point, half of those of the
/// full products. Rows are plain arrays of a length known to the compiler, which vectorises them;
/// as fixed-size products of Eigen the seven elements took a minute to compile.
template <int functions>
class GradientStiffness {
 public:
  static constexpr std::size_t kSize = 3 * functions;

  /// @param gradients of all functions [1/m]
  /// @param volume weight of the point [m³]
  void add(const std::array<Eigen::Vector3d, functions>& gradients, double volume,
           const Elasticity& D) {
    Rows<6> stress{};
    for (std::size_t i = 0; i < 6; ++i) {
      std::array<double, 6> d{};
      for (std::size_t k = 0; k < 6; ++k) {
        d[k] = volume * D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      }
      for (std::size_t b = 0; b < functions; ++b) {
        const double x = gradients[b][0], y = gradients[b][1], z = gradients[b][2];
        stress[i][3 * b] = d[0] * x + d[3] * y + d[5] * z;
        stress[i][3 * b + 1] = d[3] * x + d[1] * y + d[4] * z;
        stress[i][3 * b + 2] = d[5] * x + d[4] * y + d[2] * z;
      }
    }
    for (std::size_t a = 0; a < functions; ++a) {
      const double x = gradients[a][0], y = gradients[a][1], z = gradients[a][2];
      for (std::size_t j = 0; j < kWidth; ++j) {
        rows_[3 * a][j] += x * stress[0][j] + y * stress[3][j] + z * stress[5][j];
        rows_[3 * a + 1][j] += x * stress[3][j] + y * stress[1][j] + z * stress[4][j];
        rows_[3 * a + 2][j] += x * stress[5][j] + y * stress[4][j] + z * stress[2][j];
      }
    }
  }

  /// An entry, symmetric to the last bit.
  double operator()(std::size_t i, std::size_t j) const {
    return 0.5 * (rows_[i][j] + rows_[j][i]);
  }

 private:
  /// Even, so that pairs of entries fill vector registers.
  static constexpr std::size_t kWidth = kSize + kSize % 2;
  template <std::size_t count>
  using Rows = std::array<std::array<double, kWidth>, count>;

  Rows<kSize> rows_{};
};

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/element/quadrature.h"

#include <cmath>

#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::fem {

LineRule gauss_jacobi(int n, int power) {
  const double a = power;
  Eigen::VectorXd diagonal(n), beside(std::max(n - 1, 0));
  for (int k = 0; k < n; ++k) {
    const double s = 2.0 * k + a;
    diagonal[k] = k == 0 ? -a / (a + 2.0) : -a * a / (s * (s + 2.0));
    if (k > 0) {
      beside[k - 1] = std::sqrt(4.0 * k * (k + a) * k * (k + a) / (s * s * (s + 1.0) * (s - 1.0)));
    }
  }
  const linalg::SymmetricEigen eigen = linalg::tridiagonal_eigen(diagonal, beside);
  const double total = std::pow(2.0, a + 1.0) / (a + 1.0);
  LineRule out{eigen.values, total * eigen.vectors.row(0).cwiseAbs2().transpose()};
  if (power == 0) {  // exactly symmetric, so that entries of symmetric elements cancel to zero
    out.place = (0.5 * (out.place - out.place.reverse())).eval();
    out.weight = (0.5 * (out.weight + out.weight.reverse())).eval();
  }
  return out;
}

QuadratureRule cube_rule(int n) {
  const LineRule line = gauss_jacobi(n, 0);
  QuadratureRule out;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        out.push_back({{line.place[i], line.place[j], line.place[k]},
                       line.weight[i] * line.weight[j] * line.weight[k]});
      }
    }
  }
  return out;
}

QuadratureRule conical_rule(int n) {
  const LineRule u = gauss_jacobi(n, 2), v = gauss_jacobi(n, 1), w = gauss_jacobi(n, 0);
  QuadratureRule out;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const double x = 0.5 * (1.0 + u.place[i]);
        const double y = 0.5 * (1.0 + v.place[j]) * (1.0 - x);
        const double z = 0.5 * (1.0 + w.place[k]) * (1.0 - x - y);
        // The weights of (1 − t) and (1 − t)² on [−1, 1] shrink by 4 and 8 on [0, 1].
        out.push_back({{x, y, z}, u.weight[i] * v.weight[j] * w.weight[k] / (8.0 * 4.0 * 2.0)});
      }
    }
  }
  return out;
}

QuadratureRule wedge_rule(int n) {
  const LineRule u = gauss_jacobi(n, 1), v = gauss_jacobi(n, 0);
  QuadratureRule out;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const double x = 0.5 * (1.0 + u.place[i]);
        const double y = 0.5 * (1.0 + v.place[j]) * (1.0 - x);
        out.push_back({{x, y, v.place[k]}, u.weight[i] * v.weight[j] * v.weight[k] / (4.0 * 2.0)});
      }
    }
  }
  return out;
}

QuadratureRule symmetric_wedge_rule(int triangle_points, int n) {
  const LineRule line = gauss_jacobi(n, 0);
  QuadratureRule out;
  const auto add = [&](double b, double weight) {  // area coordinates 1 − 2b, b, b
    for (int k = 0; k < n; ++k) {
      const double z = line.place[k], w = 0.5 * weight * line.weight[k];
      out.push_back({{b, b, z}, w});
      out.push_back({{1.0 - 2.0 * b, b, z}, w});
      out.push_back({{b, 1.0 - 2.0 * b, z}, w});
    }
  };
  if (triangle_points == 3) {
    add(1.0 / 6.0, 1.0 / 3.0);
  } else {
    add(0.44594849091596488632, 0.22338158967801146570);
    add(0.09157621350977074346, 0.10995174365532186764);
  }
  return out;
}

QuadratureRule pyramid_rule(int n) {
  const LineRule u = gauss_jacobi(n, 2), v = gauss_jacobi(n, 0);
  QuadratureRule out;
  for (int i = 0; i < n; ++i) {
    const double z = 0.5 * (1.0 + u.place[i]);
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        // The weight of (1 − t)² on [−1, 1] shrinks by 8 on [0, 1].
        out.push_back({{(1.0 - z) * v.place[j], (1.0 - z) * v.place[k], z},
                       u.weight[i] * v.weight[j] * v.weight[k] / 8.0});
      }
    }
  }
  return out;
}

QuadratureRule symmetric_tetrahedron_rule() {
  QuadratureRule out;
  const auto add = [&out](double b, double weight) {  // volume coordinates 1 − 3b, b, b, b
    out.push_back({Eigen::Vector3d::Constant(b), weight / 6.0});
    for (int a = 0; a < 3; ++a) {
      Eigen::Vector3d at = Eigen::Vector3d::Constant(b);
      at[a] = 1.0 - 3.0 * b;
      out.push_back({at, weight / 6.0});
    }
  };
  add(0.3108859192633006, 0.1126879257180158);
  add(0.09273525031089123, 0.07349304311636194);
  constexpr double c = 0.04550370412564965;  // volume coordinates c, c, ½ − c, ½ − c
  constexpr double weight = 0.04254602077708147 / 6.0;
  for (int a = 0; a < 3; ++a) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(c);
    at[a] = 0.5 - c;
    out.push_back({at, weight});
    out.push_back({Eigen::Vector3d::Constant(0.5) - at, weight});
  }
  return out;
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/section_taper.h"

#include "buckens/fem/element/quadrature.h"
#include "buckens/linalg/small_lu.h"

namespace buckens::fem {

namespace {

/// Coefficients of the polynomial through values at ξ = 0, ¼, ½, ¾, 1.
Quartic quartic_through(const Eigen::Matrix<double, 5, 1>& values) {
  Eigen::Matrix<double, 5, 5> powers;
  for (int i = 0; i < 5; ++i) {
    powers(i, 0) = 1.0;
    for (int k = 1; k < 5; ++k) powers(i, k) = powers(i, k - 1) * (0.25 * i);
  }
  const Eigen::Matrix<double, 5, 1> c = linalg::general_solution(powers, values);
  return {c[0], c[1], c[2], c[3], c[4]};
}

}  // namespace

double value_at(const Quartic& p, double xi) {
  return (((p[4] * xi + p[3]) * xi + p[2]) * xi + p[1]) * xi + p[0];
}

double integral(const Quartic& p) { return p[0] + p[1] / 2 + p[2] / 3 + p[3] / 4 + p[4] / 5; }

SectionTaper section_taper(const SectionLaw& law, double from, double to) {
  SectionTaper out;
  Eigen::Matrix<double, 5, 1> A, Iy, Iz;
  for (int i = 0; i < 5; ++i) {
    const Section section = law(from + 0.25 * i * (to - from));
    A[i] = section.A;
    Iy[i] = section.Iy;
    Iz[i] = section.Iz;
    if (i == 0) out.first = section;
    if (i == 2) out.middle = section;
    if (i == 4) out.last = section;
  }
  out.A = quartic_through(A);
  out.Iy = quartic_through(Iy);
  out.Iz = quartic_through(Iz);
  static const LineRule rule = gauss_jacobi(12, 0);
  for (Eigen::Index g = 0; g < rule.place.size(); ++g) {
    const double xi = 0.5 * (1.0 + rule.place[g]);
    const Section section = law(from + xi * (to - from));
    double weight = 0.5 * rule.weight[g];
    out.per_A += weight / section.A;
    out.per_J += weight / section.J;
    out.per_shear_y += weight / (section.shear_y * section.A);
    out.per_shear_z += weight / (section.shear_z * section.A);
    for (std::size_t k = 0; k < 3; ++k, weight *= 1.0 - xi) {
      out.per_Iy[k] += weight / section.Iy;
      out.per_Iz[k] += weight / section.Iz;
    }
  }
  return out;
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/uniform_shares.h"

#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/solid/element.h"

namespace buckens::fem {

NodeShares solid_shares(const SolidBlock& solids, const std::vector<Node>& nodes, int element) {
  const auto own = solids.nodes(element);
  const NodeVectors x = solids.positions(nodes, element);
  return {{own.begin(), own.end()},
          solid_volume_products(solids.form(element).kind, x).rowwise().sum()};
}

LineIntegral line_integral(const FeModel& fe, int line, const Quartic& weight) {
  const LineRule rule = gauss_jacobi(4, 0);  // exact for the cubic shape functions of beams
  LineIntegral out;
  const PointRows first = point_rows(fe, line, 0.0), last = point_rows(fe, line, 1.0);
  const double length = (last.position - first.position).norm();
  out.middle = 0.5 * (first.position + last.position);
  for (Eigen::Index k = 0; k < rule.place.size(); ++k) {
    const double xi = 0.5 * (1.0 + rule.place[k]);
    const double share = 0.5 * rule.weight[k] * length * value_at(weight, xi);
    out.extent += share;
    out.first_moment += share * (first.position + xi * (last.position - first.position));
    for (const auto& entry : point_rows(fe, line, xi).translation) {
      out.rows.emplace_back(entry.row(), entry.col(), share * entry.value());
    }
  }
  return out;
}

LineSection line_section(const Structure& structure, int line) {
  const int beams = structure.beams.num_elements();
  const BarBlock& bars = structure.bars;
  LineSection out;
  out.area =
      line < beams ? structure.beams.area(line) : constant_quartic(bars.section(line - beams)->A);
  const double rho =
      line < beams ? structure.beams.material(line)->rho : bars.material(line - beams)->rho;
  for (std::size_t k = 0; k < out.area.size(); ++k) out.mass_per_length[k] = rho * out.area[k];
  return out;
}

}  // namespace buckens::fem

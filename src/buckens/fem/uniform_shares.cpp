// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/uniform_shares.h"

#include "buckens/fem/quadrature.h"
#include "buckens/fem/recovery.h"
#include "buckens/fem/solid_element.h"

namespace buckens::fem {

NodeShares solid_shares(const SolidBlock& solids, const std::vector<Node>& nodes, int element) {
  const auto own = solids.nodes(element);
  const NodeVectors x = solids.positions(nodes, element);
  return {{own.begin(), own.end()},
          solid_volume_products(solids.form(element).kind, x).rowwise().sum()};
}

LineIntegral line_integral(const FeModel& fe, int line) {
  const LineRule rule = gauss_jacobi(2, 0);  // exact for the cubic shape functions of beams
  LineIntegral out;
  const PointRows first = point_rows(fe, line, 0.0), last = point_rows(fe, line, 1.0);
  out.length = (last.position - first.position).norm();
  out.middle = 0.5 * (first.position + last.position);
  for (Eigen::Index k = 0; k < rule.place.size(); ++k) {
    const double weight = 0.5 * rule.weight[k] * out.length;
    for (const auto& entry : point_rows(fe, line, 0.5 * (1.0 + rule.place[k])).translation) {
      out.rows.emplace_back(entry.row(), entry.col(), weight * entry.value());
    }
  }
  return out;
}

LineSection line_section(const Structure& structure, int line) {
  const int beams = structure.beams.num_elements();
  const ElementBlock& block = line < beams ? static_cast<const ElementBlock&>(structure.beams)
                                           : static_cast<const ElementBlock&>(structure.bars);
  const int own = line < beams ? line : line - beams;
  const double area = block.section(own)->A;
  return {block.material(own)->rho * area, area};
}

}  // namespace buckens::fem

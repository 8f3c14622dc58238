// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/recovery.h"

#include "buckens/fem/shell/element.h"

namespace buckens::fem {

ShellRecovery::ShellRecovery(const FeModel& fe) {
  std::vector<linalg::Triplet> entries;
  for (const auto& block : fe.blocks) {
    const auto* shells = dynamic_cast<const ShellBlock*>(block.get());
    if (shells == nullptr) continue;
    for (int e = 0; e < shells->num_elements(); ++e) {
      const ShellStrainRows strain = shell_centre_strain(shell_element(*shells, fe.nodes, e));
      const int first = 8 * num_elements();
      Eigen::Index column = 0;
      for (const int node : shells->nodes(e)) {
        for (const int dof : fe.dofs.node_dofs[static_cast<std::size_t>(node)]) {
          for (int row = 0; row < 8 && dof >= 0; ++row) {
            const double value = strain.rows(row, column);
            if (value != 0.0) entries.emplace_back(first + row, dof, value);
          }
          ++column;
        }
      }
      axes_.push_back(strain.axes);
      sections_.push_back(shells->shell_section(e));
      stiffness_.push_back(shells->stiffness(e));
    }
  }
  rows_.resize(8 * num_elements(), fe.dofs.num_dofs);
  rows_.setFromTriplets(entries.begin(), entries.end());
}

linalg::Matrix ShellRecovery::strains(const linalg::Vector& d) const {
  linalg::Matrix out(8, num_elements());
  out.reshaped().noalias() = rows_ * d;
  return out;
}

linalg::Matrix ShellRecovery::resultants(const linalg::Matrix& strains) const {
  linalg::Matrix out(8, strains.cols());
  for (Eigen::Index e = 0; e < strains.cols(); ++e) {
    const ShellStiffness& s = stiffness_[static_cast<std::size_t>(e)];
    const Eigen::Vector3d strain = strains.col(e).head<3>(), bend = strains.col(e).segment<3>(3);
    out.col(e).head<3>() = s.A * strain + s.B * bend;
    out.col(e).segment<3>(3) = s.B * strain + s.D * bend;
    out.col(e).tail<2>() = s.H * strains.col(e).tail<2>();
  }
  return out;
}

Eigen::Vector3d ShellRecovery::stress(const linalg::Matrix& strains, int element,
                                      const ShellLevel& level) const {
  const ShellSection& section = sections_.at(static_cast<std::size_t>(element));
  const auto layer = static_cast<std::size_t>(level.layer);
  double z = -0.5 * section.thickness();
  for (std::size_t k = 0; k < layer; ++k) z += section.layers[k].thickness;
  z += level.height * section.layers.at(layer).thickness;
  const auto of_element = strains.col(element);
  return layer_elasticity(section.layers[layer]).in_plane *
         (of_element.head<3>() + z * of_element.segment<3>(3));
}

}  // namespace buckens::fem

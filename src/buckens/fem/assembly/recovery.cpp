// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/recovery.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

namespace {

constexpr int kRowsOfLine = 12;

struct EndStress {
  double normal = 0;
  double mises = 0;
};

/// @param f N, Q_y, Q_z, M_t, M_y, M_z
EndStress end_stress(const Section& s, const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& f) {
  EndStress out;
  const double axial = f[0] / s.A;
  out.normal = std::abs(axial);
  if (!f.tail<5>().isZero(0.0)) {
    for (const Eigen::Vector2d& p : s.stress_points) {
      const double bending = f[4] * p.y() / s.Iy - f[5] * p.x() / s.Iz;
      out.normal = std::max(out.normal, std::abs(axial + bending));
    }
  }
  const double torsion = s.torsion_modulus > 0.0 ? std::abs(f[3]) / s.torsion_modulus : 0.0;
  const double shear = torsion + std::hypot(s.shear_peak_y * f[1], s.shear_peak_z * f[2]) / s.A;
  out.mises = std::sqrt(out.normal * out.normal + 3.0 * shear * shear);
  return out;
}

}  // namespace

std::vector<LineElement> line_elements(const FeModel& fe) {
  std::vector<LineElement> lines;
  for (const auto& block : fe.blocks) {
    for (int e = 0; block->is_line() && e < block->num_elements(); ++e) {
      const auto [a, b] = block->ends(e);
      lines.push_back({a,
                       b,
                       {block->end_section(e, 0), block->end_section(e, 1)},
                       block->line_axes(fe.nodes, e),
                       block->has_rotations()});
    }
  }
  return lines;
}

PointRows point_rows(const FeModel& fe, int element, double xi) {
  if (!(xi >= 0.0 && xi <= 1.0)) {
    throw ModelError(
        fmt::format("point at {:g} of element {}: give a place from 0 to 1", xi, element));
  }
  int local = element;
  for (const auto& block : fe.blocks) {
    if (!block->is_line()) continue;
    if (local >= 0 && local < block->num_elements()) {
      return block->point_rows({fe.nodes, fe.dofs}, local, xi);
    }
    local -= block->num_elements();
  }
  throw ModelError(fmt::format("there is no element number {}", element));
}

PointRows node_rows(const FeModel& fe, int node) {
  const auto& dofs = fe.dofs.node_dofs.at(static_cast<std::size_t>(node));
  PointRows rows;
  rows.position = fe.nodes[static_cast<std::size_t>(node)].position;
  for (int k = 0; k < 6; ++k) {
    const int dof = dofs[static_cast<std::size_t>(k)];
    if (dof >= 0) (k < 3 ? rows.translation : rows.rotation).emplace_back(k % 3, dof, 1.0);
  }
  rows.has_rotation = !rows.rotation.empty();
  return rows;
}

Recovery::Recovery(const FeModel& fe) {
  std::vector<linalg::Triplet> triplets;
  const MeshView mesh{fe.nodes, fe.dofs};
  for (const auto& block : fe.blocks) {
    if (!block->is_line()) continue;
    block->add_force_rows(mesh, num_elements(), triplets);
    for (int e = 0; e < block->num_elements(); ++e) {
      const Section *first = block->end_section(e, 0), *last = block->end_section(e, 1);
      const std::size_t index = sections_.size();
      sections_.push_back(*first);
      if (last != first) sections_.push_back(*last);
      at_ends_.push_back({index, sections_.size() - 1});
    }
  }
  rows_.resize(Eigen::Index{kRowsOfLine} * num_elements(), fe.dofs.num_dofs);
  rows_.setFromTriplets(triplets.begin(), triplets.end());
}

linalg::Matrix Recovery::section_forces(const linalg::Vector& d) const {
  linalg::Matrix forces(12, num_elements());
  forces.reshaped().noalias() = rows_ * d;
  return forces;
}

Eigen::Vector2d Recovery::stresses_of(
    std::size_t element, const Eigen::Ref<const linalg::Vector>& section_forces) const {
  const auto [first, last] = at_ends_[element];
  const EndStress a = end_stress(sections_[first], section_forces.head<6>());
  const EndStress b = end_stress(sections_[last], section_forces.tail<6>());
  return {std::max(a.normal, b.normal), std::max(a.mises, b.mises)};
}

linalg::Matrix Recovery::stresses(const linalg::Matrix& section_forces) const {
  linalg::Matrix out(2, section_forces.cols());
  for (Eigen::Index e = 0; e < out.cols(); ++e) {
    out.col(e) = stresses_of(static_cast<std::size_t>(e), section_forces.col(e));
  }
  return out;
}

linalg::Matrix Recovery::stresses(const linalg::Matrix& section_forces,
                                  std::span<const int> elements) const {
  linalg::Matrix out(2, section_forces.cols());
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const int element = elements[static_cast<std::size_t>(k)];
    out.col(k) = stresses_of(static_cast<std::size_t>(element), section_forces.col(k));
  }
  return out;
}

linalg::SparseRows::RowMajor Recovery::rows_of(std::span<const int> elements) const {
  std::vector<linalg::Triplet> entries;
  int row = 0;
  for (const int element : elements) {
    for (int k = 0; k < kRowsOfLine; ++k, ++row) {
      using Entries = linalg::SparseRows::RowMajor::InnerIterator;
      for (Entries it(rows_, Eigen::Index{kRowsOfLine} * element + k); it; ++it) {
        entries.emplace_back(row, static_cast<int>(it.col()), it.value());
      }
    }
  }
  linalg::SparseRows::RowMajor out(row, rows_.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/largest_strain.h"

#include <algorithm>
#include <cmath>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::analysis {

using Eigen::Index;
using fem::TensorColumns;
using linalg::Vector;

namespace {

/// Raises `largest` to the largest principal strain of the columns, shear strains being 2ε.
void include_principal(const TensorColumns& strains, double& largest) {
  for (Index k = 0; k < strains.cols(); ++k) {
    const auto s = strains.col(k);
    // No principal value exceeds the norm of the tensor: most columns need no eigenvalues.
    const double square = s.head<3>().squaredNorm() + 0.5 * s.tail<3>().squaredNorm();
    if (!(square > largest * largest)) continue;
    Eigen::Matrix3d T;
    T << s[0], 0.5 * s[3], 0.5 * s[5],  //
        0.5 * s[3], s[1], 0.5 * s[4],   //
        0.5 * s[5], 0.5 * s[4], s[2];
    largest = std::max(largest, spatial::principal_values(T).cwiseAbs().maxCoeff());
  }
}

/// Nodes on the surface of solids, and those where solids of several materials meet.
std::vector<int> strained_nodes(const fem::FeModel& fe) {
  std::vector<bool> is_wanted(fe.nodes.size(), false);
  for (const fem::SurfaceFace& face : fem::surface_faces(fe)) {
    for (const int node : face.nodes) {
      if (node >= 0) is_wanted[static_cast<std::size_t>(node)] = true;
    }
  }
  std::vector<const fem::Material*> first(fe.nodes.size(), nullptr);
  for (const auto& block : fe.blocks) {
    for (int e = 0; block->is_solid() && e < block->num_elements(); ++e) {
      for (const int node : block->nodes(e)) {
        const fem::Material*& known = first[static_cast<std::size_t>(node)];
        if (known == nullptr) known = block->material(e);
        if (known != block->material(e)) is_wanted[static_cast<std::size_t>(node)] = true;
      }
    }
  }
  std::vector<int> out;
  for (std::size_t n = 0; n < is_wanted.size(); ++n) {
    if (is_wanted[n]) out.push_back(static_cast<int>(n));
  }
  return out;
}

}  // namespace

LargestStrain::LargestStrain(const fem::FeModel& fe) {
  bool has_solids = false;
  bool has_shells = false;
  for (const auto& block : fe.blocks) {
    has_solids = has_solids || (block->is_solid() && block->num_elements() > 0);
    has_shells = has_shells || (block->is_shell() && block->num_elements() > 0);
    for (int e = 0; block->is_line() && e < block->num_elements(); ++e) {
      modulus_.push_back(block->material(e)->E);
    }
  }
  if (!has_solids && !has_shells) return;
  const std::vector<int> nodes = strained_nodes(fe);
  if (has_solids) solids_ = std::make_unique<fem::SolidStrains>(fe, nodes, std::vector<int>{});
  if (has_shells) shells_ = std::make_unique<fem::ShellNodeStresses>(fe, nodes);
}

double LargestStrain::measure(const Vector& d, const linalg::Matrix& section_forces,
                              const fem::Recovery& recovery, TaskPool* pool) const {
  double largest = 0;
  if (!modulus_.empty()) {
    const linalg::Matrix stresses = recovery.stresses(section_forces);
    for (std::size_t e = 0; e < modulus_.size(); ++e) {
      largest = std::max(largest, stresses(0, static_cast<Index>(e)) / modulus_[e]);
    }
  }
  if (solids_) {
    TensorColumns at_nodes, at_elements;
    solids_->evaluate(d, at_nodes, at_elements, pool);
    include_principal(at_nodes, largest);
  }
  if (shells_) {
    const Vector rows = shells_->rows() * d;
    TensorColumns strains = rows.reshaped(6, rows.size() / 6);
    include_principal(shells_->surface(strains).strain, largest);
    strains.bottomRows<3>() *= -1.0;  // bending on the other side
    include_principal(shells_->surface(strains).strain, largest);
  }
  return largest;
}

}  // namespace buckens::analysis

// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid_recovery.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "buckens/fem/element_block.h"

namespace buckens::fem {

namespace {

template <class Visitor>
void visit_solids(const FeModel& fe, Visitor&& visit) {
  int number = 0;
  for (const auto& block : fe.blocks) {
    if (!block->is_solid()) continue;
    for (int e = 0; e < block->num_elements(); ++e) visit(*block, e, number++);
  }
}

}  // namespace

double mises_stress(const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& s) {
  const double direct =
      std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2);
  return std::sqrt(0.5 * direct + 3.0 * s.tail<3>().squaredNorm());
}

bool solids_join_by_faces(const FeModel& fe) {
  std::map<std::array<int, 4>, int> first;  // element that was seen with the face
  std::vector<int> parent;
  const auto root = [&parent](int e) {
    while (parent[static_cast<std::size_t>(e)] != e) e = parent[static_cast<std::size_t>(e)];
    return e;
  };
  int parts = 0;
  visit_solids(fe, [&](const ElementBlock& block, int e, int number) {
    parent.push_back(number);
    ++parts;
    for (auto face : block.faces(e)) {
      std::sort(face.begin(), face.end());
      const auto [entry, is_new] = first.emplace(face, number);
      const int other = root(entry->second);
      const int own = root(number);
      if (other == own) continue;
      parent[static_cast<std::size_t>(own)] = other;
      --parts;
    }
  });
  return parts <= 1;
}

std::vector<SurfaceFace> surface_faces(const FeModel& fe) {
  struct Seen {
    SurfaceFace face;
    int count = 0;
  };
  std::map<std::array<int, 4>, Seen> seen;
  visit_solids(fe, [&](const ElementBlock& block, int e, int number) {
    for (const auto& face : block.faces(e)) {
      std::array<int, 4> key = face;
      std::sort(key.begin(), key.end());
      Seen& entry = seen[key];
      if (entry.count++ == 0) entry.face = {face, number};
    }
  });
  std::vector<SurfaceFace> out;
  for (const auto& [key, entry] : seen) {
    if (entry.count == 1) out.push_back(entry.face);
  }
  std::stable_sort(out.begin(), out.end(), [](const SurfaceFace& a, const SurfaceFace& b) {
    return a.element < b.element;
  });
  return out;
}

int num_solids(const FeModel& fe) {
  int count = 0;
  visit_solids(fe, [&count](const ElementBlock&, int, int) { ++count; });
  return count;
}

std::vector<std::vector<int>> solids_at_nodes(const FeModel& fe) {
  std::vector<std::vector<int>> out(fe.nodes.size());
  visit_solids(fe, [&](const ElementBlock& block, int e, int number) {
    for (const int node : block.nodes(e)) out[static_cast<std::size_t>(node)].push_back(number);
  });
  return out;
}

SolidRecovery::SolidRecovery(const FeModel& fe) {
  std::vector<linalg::Triplet> triplets;
  int count = 0;
  for (const auto& block : fe.blocks) {
    if (!block->is_solid()) continue;
    block->add_stress_rows({fe.nodes, fe.dofs}, count, triplets);
    count += block->num_elements();
  }
  rows_.resize(6 * count, fe.dofs.num_dofs);
  rows_.setFromTriplets(triplets.begin(), triplets.end());
}

linalg::Matrix SolidRecovery::stresses(const linalg::Vector& d) const {
  linalg::Vector values = rows_ * d;
  linalg::Matrix out(7, num_elements());
  out.topRows<6>() = values.reshaped(6, num_elements());
  for (Eigen::Index e = 0; e < out.cols(); ++e) out(kMises, e) = mises_stress(out.col(e).head<6>());
  return out;
}

}  // namespace buckens::fem

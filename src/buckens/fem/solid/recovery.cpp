// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/recovery.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "buckens/fem/assembly/stress_rows.h"
#include "buckens/fem/element/block.h"

namespace buckens::fem {

namespace {

/// Solids, then shells; shells may be left out.
template <class Visitor>
void visit_elements(const FeModel& fe, Visitor&& visit) {
  int number = 0;
  for (const bool of_shells : {false, true}) {
    for (const auto& block : fe.blocks) {
      if (of_shells ? !block->is_shell() : !block->is_solid()) continue;
      for (int e = 0; e < block->num_elements(); ++e) visit(*block, e, number++);
    }
  }
}

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

Eigen::Matrix<double, 6, 6> mises_factor() {
  Eigen::Matrix<double, 6, 6> F = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < 3; ++k) {
    F(k, k) = std::sqrt(0.5);
    F(k, (k + 1) % 3) = -F(k, k);
    F(3 + k, 3 + k) = std::sqrt(3.0);
  }
  return F;
}

bool solids_join_by_faces(const FeModel& fe) {
  std::map<std::array<int, 4>, int> first;  // element that was seen with the face
  std::vector<int> parent;
  const auto root = [&parent](int e) {
    while (parent[static_cast<std::size_t>(e)] != e) {
      int& up = parent[static_cast<std::size_t>(e)];
      up = parent[static_cast<std::size_t>(up)];  // halves the way of those that come later
      e = up;
    }
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
  visit_elements(fe, [&out](const ElementBlock& block, int e, int number) {
    if (!block.is_shell()) return;
    for (const auto& face : block.faces(e)) out.push_back({face, number});
  });
  return out;
}

int num_solids(const FeModel& fe) {
  int count = 0;
  visit_elements(fe, [&count](const ElementBlock&, int, int) { ++count; });
  return count;
}

std::vector<std::vector<int>> solids_at_nodes(const FeModel& fe) {
  std::vector<std::vector<int>> out(fe.nodes.size());
  visit_elements(fe, [&](const ElementBlock& block, int e, int number) {
    for (const int node : block.nodes(e)) out[static_cast<std::size_t>(node)].push_back(number);
  });
  return out;
}

SolidRecovery::SolidRecovery(const FeModel& fe)
    : rows_(stress_rows(fe.blocks, {fe.nodes, fe.dofs}, fe.parts)) {
  for (const auto& block : fe.blocks) {
    if (block->is_solid()) num_solids_ += block->num_elements();
    if (block->is_shell()) num_shells_ += block->num_elements();
  }
}

linalg::Matrix stresses_of_rows(const linalg::Vector& products, Eigen::Index solids,
                                Eigen::Index shells, TaskPool* pool) {
  linalg::Matrix out(7, solids + shells);
  run_ranges(pool, static_cast<int>(solids), [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index e = begin; e < end; ++e) {
      out.col(e).head<6>() = products.segment<6>(6 * e);
      out(kMises, e) = mises_stress(products.segment<6>(6 * e));
    }
  });
  for (Eigen::Index e = 0; e < shells; ++e) {
    const Eigen::Index first = 6 * solids + 12 * e;
    out.col(solids + e).head<6>() = products.segment<6>(first);
    out(kMises, solids + e) = std::max(mises_stress(products.segment<6>(first)),
                                       mises_stress(products.segment<6>(first + 6)));
  }
  return out;
}

linalg::Matrix SolidRecovery::stresses(const linalg::Vector& d, TaskPool* pool) const {
  return stresses_of_rows(rows_.multiplied(d, pool), num_solids_, num_shells_, pool);
}

}  // namespace buckens::fem

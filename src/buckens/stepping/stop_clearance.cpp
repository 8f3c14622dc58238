// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/stop_clearance.h"

#include <algorithm>

#include "buckens/stepping/complementarity.h"

namespace buckens::stepping {

namespace {

// Share of their compliance with which meshes take part.
constexpr double kMeshes = 1e-9;

}  // namespace

std::vector<StopClearance::Shift> StopClearance::find(
    const std::vector<End>& ends, const std::vector<dynamics::BodyCompliance>& compliance,
    const std::vector<dynamics::BodyMotion>& motions, const std::vector<int>& rows_in_use,
    const std::vector<dynamics::SystemRow>& holding, const model::RowMemory* memory, double t) {
  const bool are_clear =
      std::all_of(ends.begin(), ends.end(), [](const End& end) { return end.gap >= 0.0; });
  if (are_clear) return {};
  std::vector<linalg::Matrix> interfaces(compliance.size());
  std::vector<dynamics::BodyCompliance> stiff = compliance;
  for (std::size_t b = 0; b < stiff.size(); ++b) {
    if (compliance[b].interface == nullptr) continue;
    interfaces[b] = kMeshes * *compliance[b].interface;
    stiff[b].interface = &interfaces[b];
  }
  if (!answers_to_.condense(stiff, motions, rows_in_use, memory, t, holding)) return {};
  const auto n = static_cast<Eigen::Index>(ends.size());
  std::vector<Push> pushes(ends.size());
  linalg::Matrix D(n, n);
  linalg::Vector asked(n);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    pushes[k].row = ends[k].row;
    answers_to_.answer(pushes[k]);
    asked[static_cast<Eigen::Index>(k)] = -ends[k].gap;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto row = static_cast<std::size_t>(i), of = static_cast<std::size_t>(j);
      D(i, j) = PushAnswers::along(ends[row].row, pushes[of]);
    }
  }
  const linalg::Vector p = solve_complementarity(D, asked);
  std::vector<Shift> out(compliance.size());
  for (std::size_t k = 0; k < pushes.size(); ++k) {
    const double pushed = p[static_cast<Eigen::Index>(k)];
    for (const PushedBody& moved : pushes[k].bodies) {
      Shift& shift = out[moved.body];
      if (shift.impulse_time.size() == 0) shift.impulse_time.setZero(moved.load.size());
      shift.frame += pushed * moved.u;
      shift.impulse_time += (kMeshes * pushed) * moved.load;
    }
  }
  return out;
}

}  // namespace buckens::stepping

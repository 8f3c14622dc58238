// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/deformation_limits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "buckens/fem/element/block.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::analysis {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Vector;

namespace {

constexpr double kLargeRotation = 0.1;   // rad
constexpr double kLargeStrain = 0.05;    // linear strain errs by half of it
constexpr double kDoubtedStrain = 0.10;  // the same at an error of 5 %
constexpr double kDoubtedError = 0.05;   // of deflections under axial loads
// More frames reduce axial loads to this, where deflections err by less than 5 %.
constexpr double kSafeAxialLoad = 0.045;
constexpr double kNoBending = 1e-6;   // rad; below this there is no bending that could err
constexpr double kStraight = 0.9998;  // cosine of a kink of about 1°

Vector3d displacement(const fem::FeModel& fe, int node, const Vector& d) {
  Vector3d u = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const int dof = fe.dofs.node_dofs[static_cast<std::size_t>(node)][k];
    if (dof >= 0) u[static_cast<Eigen::Index>(k)] = d[dof];
  }
  return u;
}

double nodal_rotation(const fem::FeModel& fe, const Vector& d) {
  double largest = 0;
  for (const auto& dofs : fe.dofs.node_dofs) {
    double square = 0;
    for (std::size_t k = 3; k < 6; ++k) {
      if (dofs[k] >= 0) square += d[dofs[k]] * d[dofs[k]];
    }
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

/// Sums over the nodes of an element, about their means: x xᵀ of positions, u xᵀ with
/// displacements.
struct Moments {
  Matrix3d xx = Matrix3d::Zero();
  Matrix3d ux = Matrix3d::Zero();
};

Moments moments_of(const fem::FeModel& fe, std::span<const int> nodes, const Vector& d) {
  Vector3d mean_x = Vector3d::Zero();
  Vector3d mean_u = Vector3d::Zero();
  for (const int node : nodes) {
    mean_x += fe.nodes[static_cast<std::size_t>(node)].position;
    mean_u += displacement(fe, node, d);
  }
  const double count = static_cast<double>(nodes.size());
  Moments out;
  for (const int node : nodes) {
    const Vector3d x = fe.nodes[static_cast<std::size_t>(node)].position - mean_x / count;
    out.xx += x * x.transpose();
    out.ux += (displacement(fe, node, d) - mean_u / count) * x.transpose();
  }
  return out;
}

/// Displacement gradient that best fits the nodes of an element; for lines along the line only.
Matrix3d fitted_gradient(const fem::FeModel& fe, std::span<const int> nodes, const Vector& d) {
  const Moments m = moments_of(fe, nodes, d);
  if (nodes.size() == 2) return m.ux / m.xx.trace();
  return m.ux * m.xx.inverse();
}

/// Slope of a shell's middle surface out of its plane.
double slope_of_shell(const fem::FeModel& fe, std::span<const int> nodes, const Vector& d) {
  const Moments m = moments_of(fe, nodes, d);
  const spatial::PrincipalAxes spread = spatial::principal_axes(m.xx);
  const Eigen::Matrix<double, 3, 2> plane = spread.vectors.rightCols<2>();
  const Eigen::Matrix<double, 3, 2> slopes =
      m.ux * plane * spread.values.tail<2>().cwiseInverse().asDiagonal();
  return (spread.vectors.col(0).transpose() * slopes).norm();
}

double rotation_of(const fem::FeModel& fe, const fem::ElementBlock& block, int e, const Vector& d) {
  if (block.is_shell()) return slope_of_shell(fe, block.nodes(e), d);
  const Matrix3d G = fitted_gradient(fe, block.nodes(e), d);
  if (block.is_line()) {
    const auto [a, b] = block.ends(e);
    const Vector3d axis = (fe.nodes[static_cast<std::size_t>(b)].position -
                           fe.nodes[static_cast<std::size_t>(a)].position)
                              .normalized();
    const Vector3d slope = G * axis;
    return (slope - slope.dot(axis) * axis).norm();
  }
  return 0.5 * Vector3d(G(2, 1) - G(1, 2), G(0, 2) - G(2, 0), G(1, 0) - G(0, 1)).norm();
}

/// Relative error of deflections that neglect an axial load.
double bending_error(const DeformationMeasure& found) {
  const double softening =
      found.compression < 1.0 ? found.compression / (1.0 - found.compression) : HUGE_VAL;
  return std::max(found.tension / (1.0 + found.tension), softening);
}

/// Verdict on axial loads that bending neglects; empty: nothing.
std::string doubt_axial_load(const DeformedBody& body, const DeformationMeasure& found) {
  const double error = bending_error(found);
  if (body.is_stiffened || error <= kDoubtedError) return {};
  if (found.rotation <= kNoBending && found.compression < 1.0) return {};
  // The load of a part falls with the square of their number.
  const int frames =
      body.frames * static_cast<int>(std::ceil(std::sqrt(found.axial_load() / kSafeAxialLoad)));
  const bool is_tension = found.tension / (1.0 + found.tension) >= error;
  const std::string load = fmt::format("{:.2g} of its buckling load pi^2 EI/L^2 in {}",
                                       is_tension ? found.tension : found.compression,
                                       is_tension ? "tension" : "compression");
  const std::string size = std::isfinite(error)
                               ? fmt::format("by up to about {:.0f} %", 100.0 * error)
                               : std::string("without bound");
  return fmt::format(
      "body \"{}\" carries up to {}; linear elasticity within one frame ignores its effect on "
      "bending, and deflections err {}; use `frames: {}`",
      body.name, load, size, frames);
}

}  // namespace

void DeformationMeasure::include(const DeformationMeasure& other) {
  rotation = std::max(rotation, other.rotation);
  strain = std::max(strain, other.strain);
  tension = std::max(tension, other.tension);
  compression = std::max(compression, other.compression);
}

DeformationLimits::DeformationLimits(const body::Body& body)
    : fe_(body.flexible->mesh()), recovery_(fe_), strain_(fe_) {
  find_members();
}

void DeformationLimits::find_members() {
  struct Line {
    Vector3d axis = Vector3d::Zero();
    double length = 0;
    double EI = 0;
  };
  std::vector<Line> lines;
  std::multimap<int, std::size_t> at_node;
  for (const auto& block : fe_.blocks) {
    for (int e = 0; block->is_line() && e < block->num_elements(); ++e) {
      const auto [a, b] = block->ends(e);
      const Vector3d way = fe_.nodes[static_cast<std::size_t>(b)].position -
                           fe_.nodes[static_cast<std::size_t>(a)].position;
      const fem::Section& section = *block->section(e);
      const double EI = block->material(e)->E * std::min(section.Iy, section.Iz);
      for (const int node : {a, b}) at_node.emplace(node, lines.size());
      lines.push_back({way.normalized(), way.norm(), block->has_rotations() ? EI : 0.0});
    }
  }
  std::vector<std::size_t> parent(lines.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  for (auto i = at_node.begin(); i != at_node.end(); ++i) {
    for (auto j = std::next(i); j != at_node.end() && j->first == i->first; ++j) {
      const Line& first = lines[i->second];
      const Line& second = lines[j->second];
      if (first.EI <= 0.0 || second.EI <= 0.0) continue;
      if (std::abs(first.axis.dot(second.axis)) < kStraight) continue;
      parent[root(i->second)] = root(j->second);
    }
  }
  std::vector<double> length(lines.size(), 0.0);
  for (std::size_t k = 0; k < lines.size(); ++k) length[root(k)] += lines[k].length;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double L = length[root(k)];
    buckling_load_.push_back(std::pow(std::numbers::pi / L, 2) * lines[k].EI);
  }
}

double DeformationLimits::largest_rotation(const Vector& d, TaskPool* pool) const {
  double largest = nodal_rotation(fe_, d);
  std::mutex turn;
  for (const auto& block : fe_.blocks) {
    if (!block->is_line() && !block->is_solid() && !block->is_shell()) continue;
    run_ranges(pool, block->num_elements(), [&](int begin, int end) {
      double own = 0;
      for (int e = begin; e < end; ++e) own = std::max(own, rotation_of(fe_, *block, e, d));
      const std::lock_guard lock(turn);
      largest = std::max(largest, own);
    });
  }
  return largest;
}

DeformationMeasure DeformationLimits::measure(const Vector& d, TaskPool* pool) const {
  DeformationMeasure out;
  out.rotation = largest_rotation(d, pool);
  const linalg::Matrix forces = recovery_.section_forces(d);
  out.strain = strain_.measure(d, forces, recovery_, pool);
  for (std::size_t e = 0; e < buckling_load_.size(); ++e) {
    if (buckling_load_[e] <= 0.0) continue;
    const double load = forces(0, static_cast<Eigen::Index>(e)) / buckling_load_[e];
    out.tension = std::max(out.tension, load);
    out.compression = std::max(out.compression, -load);
  }
  return out;
}

DeformationVerdict judge_deformation(const DeformedBody& body, const DeformationMeasure& found) {
  DeformationVerdict out;
  if (found.rotation > kLargeRotation) {
    out.trust.push_back(fmt::format(
        "body \"{}\" bends by up to {:.2g} rad within a frame, more than the {:.1f} rad that "
        "linear elasticity allows; give it more `frames` or divide it into several bodies",
        body.most_bent_part, found.rotation, kLargeRotation));
  }
  if (found.strain > kLargeStrain) {
    auto& list = found.strain > kDoubtedStrain ? out.trust : out.warnings;
    list.push_back(
        fmt::format("body \"{}\" is strained by up to {:.2g}, more than the {:.2f} that linear "
                    "elasticity allows; more frames do not help: stiffen it or reduce its loads",
                    body.name, found.strain, kLargeStrain));
  }
  const std::string axial = doubt_axial_load(body, found);
  if (!axial.empty()) out.trust.push_back(axial);
  return out;
}

}  // namespace buckens::analysis

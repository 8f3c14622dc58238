// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/section_report.h"

#include <algorithm>
#include <cmath>

#include "buckens/fem/line/beam_block.h"
#include "buckens/fem/line/frame.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

// Relative difference and sine of the angle below which two sections are one entry.
constexpr double kSame = 1e-6;

bool is_near(double a, double b) { return std::abs(a - b) <= kSame * std::max(a, b); }

/// Extent of a section along a direction (y, z) of its plane.
double extent(const fem::Section& section, const Eigen::Vector2d& along) {
  double out = 0;
  for (const Eigen::Vector2d& p : section.stress_points) {
    out = std::max(out, 2.0 * std::abs(p.dot(along)));
  }
  return out;
}

SectionReport report_of(const fem::BeamBlock& beams, int e, const std::vector<fem::Node>& nodes,
                        const std::optional<Vector3d>& normal) {
  const auto [a, b] = beams.ends(e);
  const auto& up = beams.portion(e).up ? beams.portion(e).up : beams.properties(e).up;
  const Eigen::Matrix3d axes = fem::line_frame(nodes[static_cast<std::size_t>(a)].position,
                                               nodes[static_cast<std::size_t>(b)].position, up)
                                   .axes;
  const fem::Section& section = *beams.section(e);
  const double E = beams.material(e)->E;
  SectionReport out;
  out.elements = 1;
  out.y = axes.col(1);
  out.z = axes.col(2);
  out.width = extent(section, Eigen::Vector2d::UnitX());
  out.height = extent(section, Eigen::Vector2d::UnitY());
  out.EI_y = E * section.Iy;
  out.EI_z = E * section.Iz;
  if (!normal) return out;
  const Eigen::Vector2d n(normal->dot(out.y), normal->dot(out.z));
  const Eigen::Vector2d t(-n.y(), n.x());
  out.planar = PlanarBending{*normal, out.EI_y * n.x() * n.x() + out.EI_z * n.y() * n.y(),
                             extent(section, t), extent(section, n)};
  return out;
}

/// In a plane the orientation is that across it; a line may point anywhere.
bool is_same(const SectionReport& a, const SectionReport& b) {
  const bool has_same_section = is_near(a.width, b.width) && is_near(a.height, b.height) &&
                                is_near(a.EI_y, b.EI_y) && is_near(a.EI_z, b.EI_z);
  if (!has_same_section) return false;
  if (a.planar) return is_near(a.planar->EI, b.planar->EI);
  const bool is_round = is_near(a.width, a.height) && is_near(a.EI_y, a.EI_z);
  return is_round || a.z.cross(b.z).norm() <= kSame || a.y.cross(b.y).norm() <= kSame;
}

}  // namespace

std::vector<SectionReport> report_sections(const fem::FeModel& fe,
                                           const std::optional<Vector3d>& normal) {
  std::vector<SectionReport> out;
  for (const auto& block : fe.blocks) {
    const auto* beams = dynamic_cast<const fem::BeamBlock*>(block.get());
    for (int e = 0; beams != nullptr && e < beams->num_elements(); ++e) {
      const SectionReport one = report_of(*beams, e, fe.nodes, normal);
      const auto known = std::find_if(out.begin(), out.end(),
                                      [&](const SectionReport& r) { return is_same(r, one); });
      if (known == out.end()) {
        out.push_back(one);
      } else {
        known->elements += 1;
      }
    }
  }
  return out;
}

}  // namespace buckens::analysis

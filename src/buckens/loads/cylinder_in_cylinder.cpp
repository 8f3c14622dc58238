// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cylinder_in_cylinder.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/disc_section.h"
#include "buckens/loads/rooted_quadrature.h"

namespace buckens::loads {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Sine between axes that count as parallel: sections would tilt by as much.
constexpr double kParallelAxes = 1e-8;
constexpr int kHalvingsOfRange = 200;
constexpr int kParts = 4;
// Gauss's points on −1 … 1.
constexpr std::array<double, 5> kAcrossPoint = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                                0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> kAcrossWeight = {0.2369268850561891, 0.4786286704993665,
                                                 0.5688888888888889, 0.4786286704993665,
                                                 0.2369268850561891};

/// Sections parallel to both axes: u along the first axis, y across it, z from section to section.
struct ParallelSections {
  Vector3d u, y, z;
  double first_radius, first_half, radius, half;
  Vector2d along;   // the second axis in u and y
  Vector3d middle;  // of the second in u, y, z

  ParallelSections(const PlacedCylinder& first, const PlacedCylinder& second)
      : u(first.axis),
        first_radius(first.radius),
        first_half(first.half_length),
        radius(second.radius),
        half(second.half_length) {
    const Vector3d across = u.cross(second.axis);
    const Vector3d beside = u.cross(second.middle);
    if (across.norm() > kParallelAxes) {
      z = across.normalized();
    } else {  // sections that the line between the axes lies in
      z = beside.norm() > 1e-9 * first_radius ? Vector3d(beside.normalized()) : u.unitOrthogonal();
    }
    y = z.cross(u);
    along = Vector2d(u.dot(second.axis), y.dot(second.axis)).normalized();
    middle = {u.dot(second.middle), y.dot(second.middle), z.dot(second.middle)};
  }
  double first_width(double at) const {
    return std::sqrt(std::max(0.0, first_radius * first_radius - at * at));
  }
  double width(double at) const {
    const double away = at - middle.z();
    return std::sqrt(std::max(0.0, radius * radius - away * away));
  }
  /// By which both rectangles overlap along the side where they do least; concave.
  double overlap(double at) const {
    const double w = first_width(at), v = width(at);
    const double c = std::abs(along.x()), s = std::abs(along.y());
    const double forth = along.x() * middle.x() + along.y() * middle.y();
    const double beside = -along.y() * middle.x() + along.x() * middle.y();
    return std::min({first_half + half * c + v * s - std::abs(middle.x()),
                     w + half * s + v * c - std::abs(middle.y()),
                     half + first_half * c + w * s - std::abs(forth),
                     v + first_half * s + w * c - std::abs(beside)});
  }
  /// What both rectangles have in common.
  ConvexSection common(double at) const {
    ConvexSection out = ConvexSection::rectangle(first_half, first_width(at));
    const Vector2d across(-along.y(), along.x());
    const Vector2d m(middle.x(), middle.y());
    const double v = width(at);
    for (const double side : {1.0, -1.0}) {
      out.cut(-side * along.dot(m) - half, side * along);
      out.cut(-side * across.dot(m) - v, side * across);
    }
    return out;
  }
};

/// Sections that have something in common.
bool find_range(const ParallelSections& of, double& low, double& high) {
  low = std::max(-of.first_radius, of.middle.z() - of.radius);
  high = std::min(of.first_radius, of.middle.z() + of.radius);
  if (!(high > low)) return false;
  double a = low, b = high, inside = 0.5 * (low + high);
  for (int k = 0; !(of.overlap(inside) > 0.0); ++k) {
    const double c = a + 0.382 * (b - a), d = b - 0.382 * (b - a);
    if (k == kHalvingsOfRange || !(c > a) || !(d > c) || !(b > d)) return false;
    const bool is_lower = of.overlap(c) > of.overlap(d);
    inside = is_lower ? c : d;
    (is_lower ? b : a) = is_lower ? d : c;
  }
  const auto border = [&](double outside) {
    if (of.overlap(outside) > 0.0) return outside;
    double within = inside;
    for (int k = 0; k < kHalvingsOfRange; ++k) {
      const double middle = 0.5 * (outside + within);
      if (middle == outside || middle == within) break;
      (of.overlap(middle) > 0.0 ? within : outside) = middle;
    }
    return within;
  };
  low = border(low);
  high = border(high);
  return high > low;
}

/// Adds what lies along one line parallel to the first axis.
void add_line(const ParallelSections& of, double y, double z, double low, double high,
              double weight, CylinderCells& cells) {
  const double rho = std::hypot(y, z);
  const double below = of.first_radius - rho;  // the side
  // Further along, an end is nearer.
  const double border = std::max(0.0, of.first_half - below);
  const double side_low = std::max(low, -border), side_high = std::min(high, border);
  if (side_high > side_low && rho > 0.0) {
    const double length = weight * (side_high - side_low);
    const double place = 0.5 * (side_high + side_low);
    const Vector3d n = (y * of.y + z * of.z) / rho;
    SideCell& side = cells.side;
    side.volume += length;
    side.depth += length * below;
    side.push += length * n;
    side.moment += length * place * n;
    side.first += length * place;
    side.square +=
        length * (place * place + (side_high - side_low) * (side_high - side_low) / 12.0);
  }
  for (std::size_t end = 0; end < 2; ++end) {
    const double sign = end == 0 ? 1.0 : -1.0;
    const double begin = end == 0 ? std::max(low, border) : std::max(-high, border);
    const double stop = end == 0 ? high : -low;  // both as seen along sign u
    if (!(stop > begin)) continue;
    const double length = weight * (stop - begin), place = 0.5 * (stop + begin);
    const Vector3d x = sign * place * of.u + y * of.y + z * of.z;
    OverlapCell& cell = cells.ends[end];
    cell.volume += length;
    cell.depth += length * (of.first_half - place);
    cell.first += length * x;
    cell.second += length * (x * x.transpose() +
                             (stop - begin) * (stop - begin) / 12.0 * of.u * of.u.transpose());
  }
}

/// One side of a section between two corners: u = value + slope y.
struct SectionSide {
  double value = 0, slope = 0;
  double at(double y) const { return value + slope * y; }
};

/// Both sides of a section at a height between its corners.
std::array<SectionSide, 2> sides_at(const ConvexSection& section, double y) {
  std::array<SectionSide, 2> out;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t c = 0; c < section.count; ++c) {
    const Vector2d& one = section.corners[c];
    const Vector2d& next = section.corners[c + 1 < section.count ? c + 1 : 0];
    if ((one.y() - y) * (next.y() - y) > 0.0 || one.y() == next.y()) continue;
    SectionSide side;
    side.slope = (next.x() - one.x()) / (next.y() - one.y());
    side.value = one.x() - side.slope * one.y();
    const double u = side.at(y);
    if (u < low) out[0] = side;
    if (u > high) out[1] = side;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  return out;
}

/// Heights between low and high at which a side is as far from an end as from the curved side.
template <class F>
void for_borders(const ParallelSections& of, const SectionSide& side, double z, F&& add) {
  for (const double end : {1.0, -1.0}) {
    // a + b y = √(y² + z²)
    const double a = end * side.value + of.first_radius - of.first_half, b = end * side.slope;
    const double q = 1.0 - b * b, square = a * a * b * b + q * (a * a - z * z);
    if (!(square >= 0.0)) continue;
    if (q == 0.0) {
      if (a * b != 0.0) add((z * z - a * a) / (2.0 * a * b));
      continue;
    }
    for (const double sign : {1.0, -1.0}) add((a * b + sign * std::sqrt(square)) / q);
  }
}

/// Heights between which a section keeps its form.
struct Levels {
  std::array<double, ConvexSection::kMostCorners> at;
  std::size_t count = 0;
  void add(double y) {
    if (count < at.size()) at[count++] = y;
  }
  void sort() { std::sort(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(count)); }
};

void add_parallel_section(const ParallelSections& of, double z, double weight,
                          CylinderCells& cells) {
  const ConvexSection section = of.common(z);
  if (section.count < 3) return;
  Levels levels;
  for (std::size_t k = 0; k < section.count; ++k) levels.add(section.corners[k].y());
  levels.sort();
  for (std::size_t k = 0; k + 1 < levels.count; ++k) {
    const double low = levels.at[k], high = levels.at[k + 1];
    if (!(high > low)) continue;
    const auto sides = sides_at(section, 0.5 * (low + high));
    Levels own;
    own.add(low);
    for (const SectionSide& side : sides) {
      for_borders(of, side, z, [&](double y) {
        if (y > low && y < high) own.add(y);
      });
    }
    own.add(high);
    own.sort();
    for (std::size_t part = 0; part + 1 < own.count; ++part) {
      const double middle = 0.5 * (own.at[part] + own.at[part + 1]);
      const double half = 0.5 * (own.at[part + 1] - own.at[part]);
      for (std::size_t p = 0; p < kAcrossPoint.size(); ++p) {
        const double y = middle + half * kAcrossPoint[p];
        const double from = sides[0].at(y), to = sides[1].at(y);
        if (to > from) add_line(of, y, z, from, to, weight * half * kAcrossWeight[p], cells);
      }
    }
  }
}

}  // namespace

bool find_cylinder_in_cylinder(const PlacedCylinder& first, const PlacedCylinder& second,
                               CylinderCells& cells) {
  cells = {};
  const ParallelSections of(first, second);
  double low = 0.0, high = 0.0;
  if (!find_range(of, low, high)) return false;
  // Where both circles, as seen along parallel axes, intersect, one side takes over from the other.
  std::array<double, 4> breaks = {low, high, high, high};
  std::size_t count = 1;
  const Vector2d beside(of.middle.y(), of.middle.z());
  const double apart = beside.norm();
  if (apart > 0.0) {
    const double R = of.first_radius, r = of.radius;
    const double along = (apart * apart + R * R - r * r) / (2.0 * apart);
    const double square = R * R - along * along;
    for (const double side : {-1.0, 1.0}) {
      if (square < 0.0) break;
      const double at = (along * beside.y() + side * std::sqrt(square) * beside.x()) / apart;
      if (at > low && at < high) breaks[count++] = at;
    }
  }
  breaks[count++] = high;
  std::sort(breaks.begin(), breaks.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t k = 0; k + 1 < count; ++k) {
    // In parts, as ends of cylinders may cut in anywhere.
    const double part = (breaks[k + 1] - breaks[k]) / kParts;
    if (!(part > 0.0)) continue;
    for (int p = 0; p < kParts; ++p) {
      for_rooted(breaks[k] + (p + 0.5) * part, 0.5 * part,
                 [&](double z, double weight) { add_parallel_section(of, z, weight, cells); });
    }
  }
  return true;
}

}  // namespace buckens::loads

// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cylinder_in_box.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/disc_section.h"
#include "buckens/loads/rooted_quadrature.h"

namespace buckens::loads {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kBoxFaces = 6;
// Discs begin and end to pass each face, and each plane that is as far from two of them; each edge
// enters and leaves; sections pass eight corners.
constexpr std::size_t kMostBreaks = 2 * kBoxFaces + 2 * 12 + 2 * 12 + 8 + 2;
// This close to the ends, as a share of the length, sections say whether all of it counts.
constexpr double kJustInside = 1e-9;
constexpr int kSearches = 200;

/// Heights above the six faces over sections across a cylinder: value + slope·x.
struct Sections {
  const Vector3d& half;
  const PlacedCylinder& cylinder;
  Vector3d e, f;
  std::array<Vector2d, kBoxFaces> slopes;
  std::array<double, kBoxFaces> tilts;  // size of the slope

  Sections(const Vector3d& half_in, const PlacedCylinder& cylinder_in)
      : half(half_in), cylinder(cylinder_in) {
    e = cylinder.axis.unitOrthogonal();
    f = cylinder.axis.cross(e);
    for (std::size_t i = 0; i < kBoxFaces; ++i) {
      slopes[i] = side(i) * Vector2d(e[axis(i)], f[axis(i)]);
      tilts[i] = slopes[i].norm();
    }
  }
  static int axis(std::size_t face) { return static_cast<int>(face / 2); }
  static double side(std::size_t face) { return face % 2 == 0 ? 1.0 : -1.0; }
  Vector3d origin(double s) const { return cylinder.middle + s * cylinder.axis; }
  double value(std::size_t face, double s) const {
    return side(face) * origin(s)[axis(face)] - half[axis(face)];
  }
  /// The box as cut at s, at least where it is near the cylinder.
  ConvexSection of_box(double s, double reach) const {
    ConvexSection out = ConvexSection::rectangle(reach, reach);
    for (std::size_t i = 0; i < kBoxFaces; ++i) out.cut(value(i, s), slopes[i]);
    return out;
  }
};

/// Part of the axis, as places along it.
struct Range {
  double low, high;
  bool is_empty() const { return !(high > low); }
};

/// Where no single face separates a section from the box.
Range range_of_faces(const Sections& of) {
  const PlacedCylinder& c = of.cylinder;
  Range out{-c.half_length, c.half_length};
  for (std::size_t i = 0; i < kBoxFaces; ++i) {
    const double at_middle = of.value(i, 0.0) - c.radius * of.tilts[i];
    const double slope = Sections::side(i) * c.axis[Sections::axis(i)];
    if (slope == 0.0) {
      if (at_middle >= 0.0) return {0.0, 0.0};
    } else if (slope > 0.0) {
      out.high = std::min(out.high, -at_middle / slope);
    } else {
      out.low = std::max(out.low, -at_middle / slope);
    }
  }
  // And where there are sections of the box.
  const double reach = of.half.dot(c.axis.cwiseAbs()), at = c.axis.dot(c.middle);
  out.low = std::max(out.low, -reach - at);
  out.high = std::min(out.high, reach - at);
  return out;
}

/// Narrows it down to the sections that have something in common with the box.
Range touching_range(const Sections& of, const Range& all) {
  const double radius = of.cylinder.radius;
  const double reach =
      of.cylinder.middle.norm() + of.half.norm() + of.cylinder.half_length + radius;
  const auto away = [&](double s) {
    const ConvexSection section = of.of_box(s, reach);
    return section.count > 0 ? section.distance() - radius : HUGE_VAL;
  };
  const double little = kJustInside * (all.high - all.low);
  const bool has_low = away(all.low + little) < 0.0, has_high = away(all.high - little) < 0.0;
  if (has_low && has_high) return all;
  // The distance is convex along the axis: any section that touches will do.
  double inside = has_low ? all.low + little : all.high - little;
  if (!has_low && !has_high) {
    double low = all.low + little, high = all.high - little;
    for (int k = 0;; ++k) {
      if (k == kSearches || !(high > low)) return {0.0, 0.0};
      const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
      const double at_a = away(a), at_b = away(b);
      inside = at_a < at_b ? a : b;
      if (std::min(at_a, at_b) < 0.0) break;
      if (b <= low || a >= high || a >= b) return {0.0, 0.0};
      (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
  }
  const auto border = [&](double outside, double within) {
    for (int k = 0; k < kSearches; ++k) {
      const double middle = 0.5 * (outside + within);
      if (middle == outside || middle == within) break;
      (away(middle) < 0.0 ? within : outside) = middle;
    }
    return within;
  };
  return {has_low ? all.low : border(all.low, inside),
          has_high ? all.high : border(all.high, inside)};
}

/// Places between which sections keep their form.
struct Breaks {
  std::array<double, kMostBreaks> at;
  std::size_t count = 0;
};

/// Where the edge between two faces enters and leaves the cylinder. @param add (place)
template <class F>
void add_edge(const Sections& of, std::size_t i, std::size_t j, F&& add) {
  const PlacedCylinder& c = of.cylinder;
  const int along = 3 - Sections::axis(i) - Sections::axis(j);
  const double lean = c.axis[along];
  if (lean == 0.0) return;
  Vector3d at = Vector3d::Zero();
  at[Sections::axis(i)] = Sections::side(i) * of.half[Sections::axis(i)];
  at[Sections::axis(j)] = Sections::side(j) * of.half[Sections::axis(j)];
  // Beside the axis at the place s along it: from + s step.
  const Vector3d step = Vector3d::Unit(along) / lean - c.axis;
  const Vector3d from = at - c.middle - c.axis.dot(at - c.middle) / lean * Vector3d::Unit(along);
  const double aa = step.squaredNorm(), ab = step.dot(from);
  const double square = ab * ab - aa * (from.squaredNorm() - c.radius * c.radius);
  if (!(aa > 0.0) || !(square > 0.0)) return;
  for (const double side : {-1.0, 1.0}) add((-ab + side * std::sqrt(square)) / aa);
}

Breaks breaks_in(const Sections& of, const Range& range) {
  Breaks out;
  out.at[out.count++] = range.low;
  const auto add = [&](double s) {
    if (s > range.low && s < range.high) out.at[out.count++] = s;
  };
  const PlacedCylinder& c = of.cylinder;
  // Where a plane value + rise s + slope·x touches the side of the cylinder.
  const auto add_plane = [&](double value, double rise, const Vector2d& slope) {
    if (rise == 0.0) return;
    for (const double side : {-1.0, 1.0}) add(-(value + side * c.radius * slope.norm()) / rise);
  };
  const auto rise = [&](std::size_t i) { return Sections::side(i) * c.axis[Sections::axis(i)]; };
  for (std::size_t i = 0; i < kBoxFaces; ++i) {
    add_plane(of.value(i, 0.0), rise(i), of.slopes[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (Sections::axis(i) == Sections::axis(j)) continue;
      add_plane(of.value(i, 0.0) - of.value(j, 0.0), rise(i) - rise(j),
                of.slopes[i] - of.slopes[j]);
      add_edge(of, i, j, add);
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d at = of.half;
    for (int k = 0; k < 3; ++k) {
      if ((corner & (1 << k)) != 0) at[k] = -at[k];
    }
    add(c.axis.dot(at - c.middle));
  }
  out.at[out.count++] = range.high;
  std::sort(out.at.begin(), out.at.begin() + static_cast<std::ptrdiff_t>(out.count));
  return out;
}

void add_section(const Sections& of, double s, double weight, BoxCells& cells) {
  const double radius = of.cylinder.radius;
  std::array<double, kBoxFaces> values;
  for (std::size_t i = 0; i < kBoxFaces; ++i) values[i] = of.value(i, s);
  const auto upper =
      static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  const Vector3d o = of.origin(s);
  for (std::size_t i = 0; i < kBoxFaces; ++i) {
    // Below this face, and further below all others; first the one that leaves least.
    ConvexSection section = ConvexSection::rectangle(radius, radius);
    const auto cut_beyond = [&](std::size_t j) {
      if (j != i) section.cut(values[j] - values[i], of.slopes[j] - of.slopes[i]);
    };
    cut_beyond(upper);
    if (section.count > 0) section.cut(values[i], of.slopes[i]);
    for (std::size_t j = 0; j < kBoxFaces && section.count > 0; ++j) {
      if (j != upper) cut_beyond(j);
    }
    if (section.count == 0) continue;
    const SectionSums sums = sums_within_disc(section, radius, values[i], of.slopes[i]);
    OverlapCell& cell = cells[i];
    Eigen::Matrix<double, 3, 2> axes;
    axes << of.e, of.f;
    const Vector3d flat = axes * sums.first;
    cell.volume += weight * sums.area;
    cell.depth += weight * sums.depth;
    cell.first += weight * (sums.area * o + flat);
    cell.second += weight * (sums.area * o * o.transpose() + o * flat.transpose() +
                             flat * o.transpose() + axes * sums.second * axes.transpose());
  }
}

}  // namespace

bool find_cylinder_in_box(const Vector3d& half, const PlacedCylinder& cylinder, BoxCells& cells) {
  cells.fill({});
  const Sections of(half, cylinder);
  const Range all = range_of_faces(of);
  if (all.is_empty()) return false;
  const Range range = touching_range(of, all);
  if (range.is_empty()) return false;
  const Breaks breaks = breaks_in(of, range);
  for (std::size_t b = 0; b + 1 < breaks.count; ++b) {
    const double middle = 0.5 * (breaks.at[b] + breaks.at[b + 1]);
    const double length = 0.5 * (breaks.at[b + 1] - breaks.at[b]);
    if (!(length > 0.0)) continue;
    for_rooted(middle, length, [&](double s, double weight) { add_section(of, s, weight, cells); });
  }
  return true;
}

}  // namespace buckens::loads

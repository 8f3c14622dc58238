// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/section_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace buckens::mesh_io {

namespace {

using Dimensions = std::vector<double>;
using Shape = NastranShapeConstants;

double cubed(double t) { return t * t * t; }

/// A rectangle by its centre and sides.
struct Plate {
  double y, z, height, width;
};

/// A section of plates before its centroid is known; shear areas are not yet divided by A.
struct Plates {
  std::vector<Plate> plates;
  double J = 0, shear_y = 0, shear_z = 0;
  double centre_y = 0, centre_z = 0;  ///< shear centre, where `has_centre`
  bool has_centre = false;
};

/// Height, width of lower and upper flange, web, thickness of lower and upper flange.
Plates i_section(double h, double a, double b, double tw, double ta, double tb) {
  const double hw = h - ta - tb;
  Plates out{{{ta / 2, 0, ta, a}, {h - tb / 2, 0, tb, b}, {ta + hw / 2, 0, hw, tw}}};
  out.J = (a * cubed(ta) + b * cubed(tb) + (h - (ta + tb) / 2) * cubed(tw)) / 3;
  out.shear_y = hw * tw;
  out.shear_z = a * ta + b * tb;
  const double below = ta * cubed(a), above = tb * cubed(b);
  out.centre_y = ta / 2 + (h - (ta + tb) / 2) * above / (below + above);
  out.has_centre = true;
  return out;
}

/// Flange above, web below; `sign` −1: the other way round.
Plates t_section(const Dimensions& d, double sign) {
  const double b = d[0], h = d[1], tf = d[2], tw = d[3], hw = h - tf;
  Plates out{{{sign * -tf / 2, 0, tf, b}, {sign * -(tf + hw / 2), 0, hw, tw}}};
  out.J = (b * cubed(tf) + (h - tf / 2) * cubed(tw)) / 3;
  out.shear_y = hw * tw;
  out.shear_z = b * tf;
  out.centre_y = sign * -tf / 2;
  out.has_centre = true;
  return out;
}

/// Flange upright, web to the left of it.
Plates t1_section(const Dimensions& d) {
  const double h = d[0], lw = d[1], tf = d[2], tw = d[3];
  Plates out{{{0, tf / 2, h, tf}, {0, -lw / 2, tw, lw}}};
  out.J = (h * cubed(tf) + (lw + tf / 2) * cubed(tw)) / 3;
  out.shear_y = h * tf;
  out.shear_z = lw * tw;
  out.centre_z = tf / 2;
  out.has_centre = true;
  return out;
}

Plates l_section(const Dimensions& d) {
  const double b = d[0], h = d[1], t1 = d[2], t2 = d[3];
  Plates out{{{t1 / 2, b / 2, t1, b}, {t1 + (h - t1) / 2, t2 / 2, h - t1, t2}}};
  out.J = ((b - t2 / 2) * cubed(t1) + (h - t1 / 2) * cubed(t2)) / 3;
  out.shear_y = (h - t1) * t2;
  out.shear_z = (b - t2) * t1;
  out.centre_y = t1 / 2;
  out.centre_z = t2 / 2;
  out.has_centre = true;
  return out;
}

/// Open to the right.
Plates channel(double width, double height, double tw, double tf) {
  const double hw = height - 2 * tf, flange = width - tw, y = (height - tf) / 2;
  Plates out{{{0, tw / 2, height, tw},
              {y, tw + flange / 2, tf, flange},
              {-y, tw + flange / 2, tf, flange}}};
  const double b = width - tw / 2, h = height - tf;
  out.J = (2 * b * cubed(tf) + h * cubed(tw)) / 3;
  out.shear_y = tw * hw;
  out.shear_z = 2 * tf * flange;
  out.centre_z = tw / 2 - b * b * tf / (2 * b * tf + h * tw / 3);
  out.has_centre = true;
  if (!(hw > 0)) out.plates[0].height = 0;
  return out;
}

/// Open above.
Plates trough(const Dimensions& d) {
  const double leg = d[0], base = d[1], h = d[2], w = d[3];
  const double z = (w - leg) / 2, y = base + (h - base) / 2;
  Plates out{{{base / 2, 0, base, w}, {y, z, h - base, leg}, {y, -z, h - base, leg}}};
  out.J = (2 * (h - base / 2) * cubed(leg) + (w - leg) * cubed(base)) / 3;
  out.shear_y = 2 * leg * (h - base);
  out.shear_z = base * (w - 2 * leg);
  return out;
}

Plates cross(const Dimensions& d) {
  const double arms = d[0], tw = d[1], h = d[2], t = d[3];
  const double z = tw / 2 + arms / 4;
  Plates out{{{0, 0, h, tw}, {0, z, t, arms / 2}, {0, -z, t, arms / 2}}};
  out.J = (h * cubed(tw) + arms * cubed(t)) / 3;
  out.shear_y = h * tw;
  out.shear_z = arms * t;
  return out;
}

Plates h_section(const Dimensions& d) {
  const double inner = d[0], tf = d[1] / 2, h = d[2], tw = d[3];
  const double z = (inner + tf) / 2;
  Plates out{{{0, z, h, tf}, {0, -z, h, tf}, {0, 0, tw, inner}}};
  out.J = (2 * h * cubed(tf) + (inner + tf) * cubed(tw)) / 3;
  out.shear_y = 2 * h * tf;
  out.shear_z = inner * tw;
  return out;
}

/// Upper flange to the left, lower one to the right.
Plates z_section(const Dimensions& d) {
  const double flange = d[0], tw = d[1], hw = d[2], h = d[3];
  const double tf = (h - hw) / 2, y = (h - tf) / 2, z = (tw + flange) / 2;
  Plates out{{{0, 0, h, tw}, {y, -z, tf, flange}, {-y, z, tf, flange}}};
  out.J = (2 * (flange + tw / 2) * cubed(tf) + (h - tf) * cubed(tw)) / 3;
  out.shear_y = hw * tw;
  out.shear_z = 2 * flange * tf;
  return out;
}

Plates hat(const Dimensions& d) {
  const double h = d[0], t = d[1], top = d[2], brim = d[3];
  const double z = (top - t) / 2, brim_z = (top + brim - t) / 2;
  Plates out{{{h - t / 2, 0, t, top},
              {h / 2, z, h - 2 * t, t},
              {h / 2, -z, h - 2 * t, t},
              {t / 2, brim_z, t, brim + t},
              {t / 2, -brim_z, t, brim + t}}};
  out.J = cubed(t) / 3 * (2 * (brim + t / 2) + 2 * (h - t) + top - t);
  out.shear_y = 2 * t * (h - 2 * t);
  out.shear_z = t * (top - 2 * t + 2 * brim);
  if (!(top > 2 * t)) out.plates[0].width = 0;
  return out;
}

/// Width, height, walls above, below, left and right.
Plates box1(const Dimensions& d) {
  const double w = d[0], h = d[1], above = d[2], below = d[3], left = d[4], right = d[5];
  const double hw = h - above - below, y = below + hw / 2;
  Plates out{{{h - above / 2, w / 2, above, w},
              {below / 2, w / 2, below, w},
              {y, left / 2, hw, left},
              {y, w - right / 2, hw, right}}};
  const double wm = w - (left + right) / 2, hm = h - (above + below) / 2;
  out.J = 4 * wm * wm * hm * hm / (wm / above + wm / below + hm / left + hm / right);
  out.shear_y = hw * (left + right);
  out.shear_z = (w - left - right) * (above + below);
  if (!(w > left + right)) out.plates[0].width = 0;
  return out;
}

void add_corners(const std::vector<Plate>& plates, double y0, double z0, Shape& out) {
  for (const auto& [sy, sz] : {std::pair{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}) {
    std::array<double, 2> best{};
    double most = -1;
    for (const Plate& plate : plates) {
      const std::array<double, 2> corner = {plate.y + sy * plate.height / 2 - y0,
                                            plate.z + sz * plate.width / 2 - z0};
      const double reach = sy * corner[0] + sz * corner[1];
      if (reach > most) best = corner;
      most = std::max(most, reach);
    }
    out.corners.push_back(best);
  }
}

Shape constants_of(const Plates& section) {
  Shape out;
  double y = 0, z = 0;
  for (const Plate& plate : section.plates) {
    if (!(plate.height > 0 && plate.width > 0)) return {};
    const double A = plate.height * plate.width;
    out.A += A;
    y += A * plate.y;
    z += A * plate.z;
  }
  y /= out.A;
  z /= out.A;
  for (const Plate& plate : section.plates) {
    const double A = plate.height * plate.width, dy = plate.y - y, dz = plate.z - z;
    out.I1 += A * (plate.height * plate.height / 12 + dy * dy);
    out.I2 += A * (plate.width * plate.width / 12 + dz * dz);
    out.I12 += A * dy * dz;
  }
  // What symmetry makes zero must not turn the section by rounding.
  if (std::abs(out.I12) < 1e-12 * (out.I1 + out.I2)) out.I12 = 0;
  out.J = section.J;
  out.K1 = section.shear_y / out.A;
  out.K2 = section.shear_z / out.A;
  if (section.has_centre) {
    out.y = y - section.centre_y;
    out.z = z - section.centre_z;
  }
  add_corners(section.plates, y, z, out);
  return out;
}

Shape hexagon(const Dimensions& d) {
  const double corner = d[0], w = d[1], h = d[2], inner = w - 2 * corner;
  Shape out;
  if (!(inner > 0)) return out;
  out.A = h * (w - corner);
  out.I1 = inner * cubed(h) / 12 + corner * cubed(h) / 24;
  const double a = inner / 2;
  out.I2 =
      h * cubed(inner) / 12 + 2 * h * corner * (a * a / 2 + a * corner / 3 + corner * corner / 12);
  out.J = std::pow(out.A, 4) / (40 * (out.I1 + out.I2));
  out.K1 = out.K2 = 5.0 / 6.0;
  out.corners = {{h / 2, 0}, {0, w / 2}, {-h / 2, 0}, {0, -w / 2}};
  return out;
}

}  // namespace

int num_nastran_shape_dimensions(std::string_view type) {
  static const std::map<std::string_view, int> counts = {
      {"I", 6}, {"I1", 4},   {"T", 4},     {"T1", 4},    {"T2", 4},
      {"L", 4}, {"CHAN", 4}, {"CHAN1", 4}, {"CHAN2", 4}, {"H", 4},
      {"Z", 4}, {"HAT", 4},  {"BOX1", 6},  {"CROSS", 4}, {"HEXA", 3}};
  const auto entry = counts.find(type);
  return entry == counts.end() ? 0 : entry->second;
}

NastranShapeConstants nastran_shape(std::string_view type, const Dimensions& d) {
  if (type == "HEXA") return hexagon(d);
  if (type == "I") return constants_of(i_section(d[0], d[1], d[2], d[3], d[4], d[5]));
  if (type == "I1") {
    const double flange = (d[3] - d[2]) / 2, width = d[0] + d[1];
    return constants_of(i_section(d[3], width, width, d[1], flange, flange));
  }
  if (type == "T") return constants_of(t_section(d, 1.0));
  if (type == "T2") return constants_of(t_section(d, -1.0));
  if (type == "T1") return constants_of(t1_section(d));
  if (type == "L") return constants_of(l_section(d));
  if (type == "CHAN") return constants_of(channel(d[0], d[1], d[2], d[3]));
  if (type == "CHAN1") return constants_of(channel(d[0] + d[1], d[3], d[1], (d[3] - d[2]) / 2));
  if (type == "CHAN2") return constants_of(trough(d));
  if (type == "CROSS") return constants_of(cross(d));
  if (type == "H") return constants_of(h_section(d));
  if (type == "Z") return constants_of(z_section(d));
  if (type == "HAT") return constants_of(hat(d));
  return constants_of(box1(d));
}

}  // namespace buckens::mesh_io

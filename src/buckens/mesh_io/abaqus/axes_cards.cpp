// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/abaqus/cards.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::optional<Matrix3d> axes_from(const Vector3d& a, const Vector3d& b) {
  const Vector3d normal = a.cross(b);
  if (!(normal.norm() > 1e-10 * a.norm() * b.norm()) || a.norm() == 0.0) return std::nullopt;
  Matrix3d out;
  out.col(0) = a.normalized();
  out.col(2) = normal.normalized();
  out.col(1) = out.col(2).cross(out.col(0));
  return out;
}

namespace {

constexpr const char kDistribution[] = "a distribution";

/// Whether the first value is a name in place of a number.
bool is_by_distribution(AbaqusReading& in) {
  const std::string text = in.lines.first_cell_ahead();
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0;
}

/// The points a, b and c that span rectangular axes.
Matrix3d read_axes(AbaqusReading& in, const DeckKeyword& keyword, bool from_z) {
  DeckRow row;
  if (!in.lines.next_row(row)) {
    in.lines.fail(keyword.place, "the points a and b are missing on the next line");
  }
  const Vector3d origin = read_vector(in.lines, row, 6, "coordinate of point c");
  auto axes = axes_from(read_vector(in.lines, row, 0, "coordinate of point a") - origin,
                        read_vector(in.lines, row, 3, "coordinate of point b") - origin);
  if (!axes)
    in.lines.fail(row.place, "the points a, b and c lie on one line and do not define axes");
  if (!from_z) return *axes;
  // Point a lies on axis 3, b in the plane of axes 3 and 1.
  Matrix3d out;
  out << axes->col(1), axes->col(2), axes->col(0);
  return out;
}

/// The points a and b on the axis of cylindrical directions.
void read_axis(AbaqusReading& in, AbaqusOrientation& out) {
  DeckRow row;
  if (!in.lines.next_row(row)) return;
  out.a = read_vector(in.lines, row, 0, "coordinate of point a");
  out.b = read_vector(in.lines, row, 3, "coordinate of point b");
  if (out.a == out.b)
    in.lines.fail(row.place, "the points a and b coincide and do not define an axis");
  out.is_cylindrical = true;
}

/// The second line: one of the axes and an angle by which the others turn about it.
void read_additional_rotation(AbaqusReading& in, AbaqusOrientation& out) {
  DeckRow row;
  if (!in.lines.next_row(row)) return;
  const double axis = in.lines.number_or(row, 0, 1.0, "axis of the additional rotation");
  const double angle = in.lines.number_or(row, 1, 0.0, "angle of the additional rotation");
  if (axis != 1.0 && axis != 2.0 && axis != 3.0) {
    in.lines.fail(row.place, fmt::format("{:g} is not an axis; it must be 1, 2 or 3", axis));
  }
  out.normal = static_cast<int>(axis) - 1;
  const Vector3d about = out.axes.col(*out.normal);
  out.axes =
      Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, about).toRotationMatrix() * out.axes;
}

}  // namespace

void read_orientation(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusOrientation out;
  out.name = in.parameter(keyword, "NAME");
  out.place = keyword.place;
  out.system = upper(in.optional_parameter(keyword, "SYSTEM"));
  const std::string definition = upper(in.optional_parameter(keyword, "DEFINITION"));
  if (out.system.empty() || out.system == "R") out.system = "RECTANGULAR";
  const bool from_z = out.system == "Z RECTANGULAR";
  if (from_z) out.system = "RECTANGULAR";
  if (!definition.empty() && definition != "COORDINATES") out.system = "DEFINITION=" + definition;
  if (out.system == "RECTANGULAR" && is_by_distribution(in)) {
    out.system = kDistribution;
    DeckRow row;
    in.lines.next_row(row);
    out.distribution = row.cell(0);
    if (from_z) {
      in.lines.fail(row.place,
                    "SYSTEM=Z RECTANGULAR with a distribution is not supported; give points on "
                    "axes 1 and 2, SYSTEM=RECTANGULAR");
    }
    read_additional_rotation(in, out);
  } else if (out.system == "RECTANGULAR") {
    out.axes = read_axes(in, keyword, from_z);
    read_additional_rotation(in, out);
  } else {
    if (out.system.starts_with('C') && definition.empty() && !is_by_distribution(in)) {
      read_axis(in, out);
    }
    in.note(keyword.place, fmt::format("*ORIENTATION of {}: used for couplings, and for isotropic "
                                       "materials, where it changes nothing",
                                       out.system));
  }
  in.scope->orientations[upper(out.name)] = out;
}

void read_distribution(AbaqusReading& in, const DeckKeyword& keyword) {
  if (const std::string file = in.optional_parameter(keyword, "INPUT"); !file.empty()) {
    in.lines.include(file, keyword.place);
  }
  AbaqusDistribution out;
  out.place = keyword.place;
  const std::string location = upper(in.optional_parameter(keyword, "LOCATION"));
  out.is_of_elements = location.empty() || location == "ELEMENT";
  DeckRow row;
  while (in.lines.next_row(row)) {
    std::vector<double> values;
    for (std::size_t k = 1; k < row.cells.size(); ++k) {
      if (k + 1 == row.cells.size() && row.cell(k).empty()) break;  // behind a last comma
      values.push_back(in.lines.number_or(row, k, 0.0, "value of the distribution"));
    }
    if (row.cell(0).empty()) {
      out.otherwise = std::move(values);
    } else {
      out.entries.push_back({std::string(row.cell(0)), std::move(values), row.place});
    }
  }
  in.scope->distributions[upper(in.parameter(keyword, "NAME"))] = std::move(out);
}

void read_system(AbaqusReading& in, const DeckKeyword& keyword) {
  in.system_axes.setIdentity();
  in.system_origin.setZero();
  DeckRow row;
  if (!in.lines.next_row(row)) return;
  const Vector3d origin = read_vector(in.lines, row, 0, "coordinate of the origin");
  in.system_origin = origin;
  if (row.cell(3).empty() && row.cell(4).empty() && row.cell(5).empty()) return;
  const Vector3d on_x = read_vector(in.lines, row, 3, "coordinate on the x axis") - origin;
  DeckRow second;
  // Without a third point the z axis stays.
  Vector3d in_plane = Vector3d::UnitZ().cross(on_x);
  if (in.lines.next_row(second)) {
    in_plane = read_vector(in.lines, second, 0, "coordinate in the x-y plane") - origin;
  }
  const auto axes = axes_from(on_x, in_plane);
  if (!axes)
    in.lines.fail(keyword.place, "the points of *SYSTEM lie on one line and do not define axes");
  in.system_axes = *axes;
}

void read_transform(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusTransform out;
  out.node_set = in.parameter(keyword, "NSET");
  out.place = keyword.place;
  const std::string type = upper(in.optional_parameter(keyword, "TYPE"));
  out.is_cylindrical = type == "C";
  out.is_supported = type.empty() || type == "R" || out.is_cylindrical;
  DeckRow row;
  if (!in.lines.next_row(row)) {
    in.lines.fail(keyword.place, "the points a and b are missing on the next line");
  }
  out.a = read_vector(in.lines, row, 0, "coordinate of point a");
  out.b = read_vector(in.lines, row, 3, "coordinate of point b");
  const bool is_bad =
      out.is_cylindrical ? (out.a - out.b).norm() == 0.0 : !axes_from(out.a, out.b).has_value();
  if (is_bad) in.lines.fail(row.place, "the points a and b give no axes");
  in.scope->transforms.push_back(out);
}

}  // namespace buckens::mesh_io

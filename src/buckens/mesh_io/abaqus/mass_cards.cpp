// SPDX-License-Identifier: Apache-2.0
// *MASS and *ROTARY INERTIA.
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void read_mass(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string type = upper(in.optional_parameter(keyword, "TYPE"));
  if (!type.empty() && type != "ISOTROPIC") {
    in.lines.fail(keyword.place,
                  fmt::format("a *MASS of TYPE={} differs between directions, which is impossible "
                              "for a three-dimensional body; give one mass",
                              type));
  }
  AbaqusMass& mass = in.scope->masses.emplace_back();
  mass.element_set = in.parameter(keyword, "ELSET");
  mass.place = keyword.place;
  DeckRow row;
  if (!in.lines.next_row(row)) in.lines.fail(keyword.place, "the mass is missing on the next line");
  mass.mass = in.lines.number(row, 0, "mass");
  if (mass.mass < 0.0)
    in.lines.fail(row.place, fmt::format("the mass {:g} is negative", mass.mass));
}

void read_rotary_inertia(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusMass& mass = in.scope->masses.emplace_back();
  mass.element_set = in.parameter(keyword, "ELSET");
  mass.is_rotary = true;
  mass.orientation = in.optional_parameter(keyword, "ORIENTATION");
  mass.place = keyword.place;
  DeckRow row;
  if (!in.lines.next_row(row)) {
    in.lines.fail(keyword.place, "the moments of inertia are missing on the next line");
  }
  // The products stand as they do in the tensor, I12 = −∫ρ x1 x2 dV.
  Matrix3d& I = mass.inertia;
  for (int k = 0; k < 3; ++k) {
    I(k, k) = in.lines.number(row, static_cast<std::size_t>(k), "moment of inertia");
  }
  I(0, 1) = I(1, 0) = in.lines.number_or(row, 3, 0.0, "product of inertia");
  I(0, 2) = I(2, 0) = in.lines.number_or(row, 4, 0.0, "product of inertia");
  I(1, 2) = I(2, 1) = in.lines.number_or(row, 5, 0.0, "product of inertia");
  const Vector3d principal = spatial::principal_values(I);
  // Numbers of seven digits.
  if (principal[0] >= -1e-6 * principal.cwiseAbs().maxCoeff()) return;
  in.lines.fail(row.place, fmt::format("a principal moment of inertia, {:g}, is negative; products "
                                       "of inertia are I12, I13, I23 in this order",
                                       principal[0]));
}

}  // namespace buckens::mesh_io

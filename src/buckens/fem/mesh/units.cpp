// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/units.h"

#include <algorithm>

#include <fmt/format.h>

namespace buckens::fem {

namespace {

// Bounds beyond which a number is assumed to be in another unit. Few parts are wider than 20
// m, such as blades of wind turbines; parts of 20 mm and more are common. Meshed parts are
// above half a millimetre. Rubber has 1 MPa, diamond 1.2 TPa; osmium 22 600 kg/m³, aerogels 1
// kg/m³.
constexpr double kLargest = 20.0, kSmallest = 5e-4;
constexpr double kSoftest = 5e5, kStiffest = 3e12;
constexpr double kDensest = 30000.0, kLightest = 0.5;

constexpr char kRemedy[] =
    "write `length-unit: mm` beside the file (`--length-unit mm` on the command line)";

}  // namespace

std::vector<std::string> unit_warnings(const ImportedMesh& mesh, const Eigen::AlignedBox3d& box,
                                       bool units_given) {
  std::vector<std::string> out;
  const bool has_unit = mesh.format.starts_with("STEP");
  const char* given = has_unit ? "is the unit of the file right?" : "check `length-unit`";
  const double size = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (size > kLargest) {
    out.push_back(fmt::format("the mesh is {:.4g} m wide; its lengths are probably in mm: {}", size,
                              units_given ? given : kRemedy));
  } else if (size > 0 && size < kSmallest) {
    out.push_back(
        fmt::format("the mesh is only {:.4g} mm wide; its lengths are probably in m "
                    "already: {}",
                    1e3 * size, units_given ? given : "check the units of the file"));
  }
  for (const MaterialSpec& material : mesh.materials) {
    const double E = material.orthotropic
                         ? std::max({material.orthotropic->E1, material.orthotropic->E2,
                                     material.orthotropic->E3})
                         : material.E;
    if (E > 0 && E < kSoftest) {
      out.push_back(
          fmt::format("material \"{}\" has E = {:g} Pa, which is softer than rubber; it is "
                      "probably in MPa: {}",
                      material.name, E, units_given ? "check the units" : kRemedy));
    } else if (E > kStiffest) {
      out.push_back(
          fmt::format("material \"{}\" has E = {:.4g} Pa, which is stiffer than diamond; "
                      "check `length-unit` and `mass-unit`",
                      material.name, E));
    }
    if (material.rho > kDensest || (material.rho > 0 && material.rho < kLightest)) {
      out.push_back(
          fmt::format("material \"{}\" has the density {:.4g} kg/m^3; with lengths in mm "
                      "and stresses in MPa masses are in t (7.85e-9 t/mm^3 for steel): {}",
                      material.name, material.rho, units_given ? "check `mass-unit`" : kRemedy));
    }
  }
  return out;
}

}  // namespace buckens::fem

// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/mesh_conversion.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

namespace buckens::io {

namespace {

std::vector<std::uint8_t> members(const std::vector<int>& set, std::size_t count) {
  std::vector<std::uint8_t> out(count, 0);
  for (const int member : set) out[static_cast<std::size_t>(member)] = 1;
  return out;
}

/// Text that YAML reads as a string whatever is in it.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

/// A name as model files take it: letters, digits, _ and -.
std::string plain_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ? c : '_';
  }
  return out.empty() ? "material" : out;
}

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

std::string material_text(const fem::MaterialSpec& material) {
  std::string out = fmt::format("  {}:\n", plain_name(material.name));
  if (material.orthotropic) {
    const fem::OrthotropicSpec& o = *material.orthotropic;
    out += fmt::format(
        "    orthotropic:\n      {{E1: {}, E2: {}, E3: {}, nu12: {}, nu13: {}, nu23: {}, G12: {}, "
        "G13: {}, G23: {},\n       axis-1: {}, axis-2: {}}}\n",
        o.E1, o.E2, o.E3, o.nu12, o.nu13, o.nu23, o.G12, o.G13, o.G23, vector_text(o.axis_1),
        vector_text(o.axis_2));
  } else {
    out += fmt::format("    E: {}\n    nu: {}\n", material.E, material.nu);
    if (material.G) out += fmt::format("    G: {}\n", *material.G);
  }
  out += fmt::format("    rho: {}\n", material.rho);
  if (material.damping) {
    out += fmt::format("    damping: {{mass: {}, stiffness: {}}}\n", material.damping->alpha(),
                       material.damping->beta());
  }
  return out;
}

std::string masses_text(const fem::ImportedMesh& si) {
  std::string out;
  for (const fem::ImportedMass& point : si.masses) {
    if (point.offset.norm() > 0) {
      out += fmt::format("      # left out: the mass of {} kg beside node {}\n", point.mass,
                         si.node_ids[static_cast<std::size_t>(point.node)]);
      continue;
    }
    if (out.find("masses:") == std::string::npos) out += "      masses:\n";
    const Eigen::Matrix3d& J = point.inertia;
    out += fmt::format("        - {{at: n{}, mass: {}, inertia: [{}, {}, {}, {}, {}, {}]}}\n",
                       si.node_ids[static_cast<std::size_t>(point.node)], point.mass, J(0, 0),
                       J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2));
  }
  return out;
}

std::string properties_text(const fem::ImportedMesh& si) {
  std::string materials, remarks;
  std::set<std::string> known;
  for (const fem::ImportedProperty& property : si.properties) {
    if (property.thickness) {
      remarks += fmt::format("      # thickness of {}: {} m\n", quoted(property.name),
                             *property.thickness);
    }
    if (!property.layers.empty() || property.section || property.axes) {
      remarks += fmt::format("      # {} has layers, a section or axes, which are left out\n",
                             quoted(property.name));
    }
    if (property.material.empty() || !known.insert(property.name).second) continue;
    materials +=
        fmt::format("        {}: {}\n", quoted(property.name), plain_name(property.material));
  }
  if (materials.empty()) return remarks + "      # material: the mesh file gave none\n";
  return "      materials:\n" + materials + remarks;
}

}  // namespace

VtuGrid vtu_grid(const fem::ImportedMesh& mesh) {
  VtuGrid out;
  out.points = mesh.positions;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> properties;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    const auto count = static_cast<std::size_t>(fem::num_nodes(block.kind));
    for (std::size_t e = 0; e < block.ids.size(); ++e) {
      out.add_cell(block.kind, std::span(block.nodes).subspan(e * count, count));
      ids.push_back(block.ids[e]);
      properties.push_back(block.property);
    }
  }
  out.point_data.push_back({"node", 1, mesh.node_ids, {}});
  for (const auto& set : mesh.node_sets) {
    out.point_data.push_back({"set " + set.name, 1, members(set.nodes, out.points.size()), {}});
  }
  out.cell_data.push_back({"element", 1, std::move(ids), {}});
  out.cell_data.push_back({"property", 1, std::move(properties), {}});
  for (const auto& set : mesh.element_sets) {
    out.cell_data.push_back({"set " + set.name, 1, members(set.elements, out.types.size()), {}});
  }
  return out;
}

std::string model_of_mesh(const fem::ImportedMesh& mesh, const std::string& mesh_file,
                          fem::LengthUnit length, fem::MassUnit mass) {
  const fem::ImportedMesh si = fem::in_si(mesh, fem::size_of(length), fem::size_of(mass));
  std::string out = fmt::format(
      "# Written by `buckens convert` beside {}: what that file does not hold. Numbers are in SI "
      "units.\n# `buckens modes` on this file gives the frequencies of the part.\nbuckens: 1\n",
      mesh_file);
  if (!si.materials.empty()) out += "materials:\n";
  for (const fem::MaterialSpec& material : si.materials) out += material_text(material);
  out += fmt::format("bodies:\n  part:\n    mesh:\n      file: {}\n      length-unit: {}\n",
                     quoted(mesh_file), choice_names(length)[static_cast<std::size_t>(length)]);
  return out + properties_text(si) + masses_text(si);
}

}  // namespace buckens::io

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/fem/mesh/generate_mesh.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

using Eigen::Vector3d;

Found up_problem(const std::optional<Vector3d>& up, const Vector3d& along) {
  if (!up) return std::nullopt;
  if (up->norm() == 0.0) return Finding{"up", "a direction cannot be zero"};
  if (up->normalized().cross(along.normalized()).norm() < 1e-6) {
    return Finding{"up", "the direction is parallel to the beam; choose one across it"};
  }
  return std::nullopt;
}

Found path_problem(const fem::BeamPropertySpec& spec) {
  if (spec.path != fem::BeamPath::polyline && spec.through.empty()) {
    return Finding{"path",
                   "it needs points between the ends; give them in `through`, or remove it"};
  }
  if (spec.path == fem::BeamPath::arc && spec.through.size() > 1) {
    return Finding{"through", fmt::format("an arc goes through one point between its ends; {} are "
                                          "given. Take one, a spline, or several beams",
                                          spec.through.size())};
  }
  return std::nullopt;
}

}  // namespace

Found problem(const fem::BeamMemberSpec& spec, const ModelDescription&) {
  return path_problem(spec);
}

Found problem(const fem::BeamSpec& spec, const ModelDescription&) {
  if (Found found = path_problem(spec)) return found;
  const double length = (spec.to - spec.from).norm();
  if (spec.through.empty() && !(length > 0)) {
    return Finding{"to", "the beam has zero length: \"from\" and \"to\" are the same point"};
  }
  for (const auto& mass : spec.masses) {
    if (mass.at != "start" && mass.at != "mid" && mass.at != "end") {
      return Finding{
          "masses",
          fmt::format("unknown point \"{}\"; a beam has `start`, `mid` and `end`", mass.at)};
    }
    if (mass.at == "mid" && spec.elements % 2 != 0) {
      return Finding{"elements", fmt::format("a mass at mid needs an even number of elements, "
                                             "not {}",
                                             spec.elements)};
    }
  }
  return spec.through.empty() ? up_problem(spec.up, spec.to - spec.from) : std::nullopt;
}

Found problem(const fem::BarMemberSpec& spec, const ModelDescription&) {
  if (spec.section.has_value() != spec.area.has_value()) return std::nullopt;
  return Finding{"", "exactly one of the keys section and area is needed"};
}

namespace {

Found unknown_node(const std::string& key, const std::string& name,
                   const std::vector<std::string>& known) {
  return Finding{key, fmt::format("unknown node \"{}\".{}", name, base::suggestion(name, known))};
}

/// Found about the ends of a beam or bar between nodes.
template <class Member>
Found member_problem(const fem::StructureSpec& spec, const Member& member, const char* list,
                     std::size_t index) {
  const std::string key = fmt::format("{}.{}", list, index);
  std::array<const fem::NodeSpec*, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] = base::find_named(spec.nodes, member.between[i]);
    if (ends[i] != nullptr) continue;
    return unknown_node(key + ".between", member.between[i], names_of(spec.nodes));
  }
  const Vector3d along = ends[1]->position - ends[0]->position;
  if constexpr (requires { member.through; }) {
    if (!member.through.empty()) return std::nullopt;
  }
  if (!(along.norm() > 0)) {
    return Finding{
        key + ".between",
        fmt::format("the member has zero length: its nodes \"{}\" and \"{}\" are the same point",
                    member.between[0], member.between[1])};
  }
  if constexpr (requires { member.up; }) return under(key, up_problem(member.up, along));
  return std::nullopt;
}

/// Found about the corners of a solid or shell element.
Found corner_problem(const fem::StructureSpec& spec, const std::vector<std::string>& nodes,
                     const std::string& key) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (base::find_named(spec.nodes, nodes[i]) == nullptr) {
      return unknown_node(key, nodes[i], names_of(spec.nodes));
    }
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) !=
        nodes.begin() + static_cast<std::ptrdiff_t>(i)) {
      return Finding{
          key, fmt::format(
                   "node \"{}\" appears twice; the corners of an element must be different nodes",
                   nodes[i])};
    }
  }
  return std::nullopt;
}

/// Found about a node that a link names.
Found link_problem(const fem::StructureSpec& spec) {
  if (!spec.links) return std::nullopt;
  const auto check = [&spec](const std::string& key, const std::string& node) -> Found {
    if (base::find_named(spec.nodes, node) != nullptr) return std::nullopt;
    return unknown_node("links." + key, node, names_of(spec.nodes));
  };
  const auto check_links = [&check](const char* kind, const auto& links) -> Found {
    for (std::size_t i = 0; i < links.size(); ++i) {
      const std::string key = fmt::format("{}.{}", kind, i);
      if (Found found = check(key + ".reference", links[i].reference)) return found;
      for (const std::string& node : links[i].nodes) {
        if (Found found = check(key + ".nodes", node)) return found;
      }
    }
    return std::nullopt;
  };
  if (Found found = check_links("rigid", spec.links->rigid)) return found;
  if (Found found = check_links("averages", spec.links->averages)) return found;
  for (std::size_t i = 0; i < spec.links->equations.size(); ++i) {
    for (const auto& term : spec.links->equations[i].terms) {
      if (Found found = check(fmt::format("equations.{}.terms", i), term.node)) return found;
    }
  }
  for (std::size_t i = 0; i < spec.links->springs.size(); ++i) {
    for (const std::string& node : spec.links->springs[i].between) {
      if (Found found = check(fmt::format("springs.{}.between", i), node)) return found;
    }
  }
  return std::nullopt;
}

Found mass_problem(const std::vector<fem::PointMassSpec>& masses,
                   const std::vector<std::string>& nodes) {
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (std::find(nodes.begin(), nodes.end(), masses[i].at) != nodes.end()) continue;
    return unknown_node(fmt::format("masses.{}.at", i), masses[i].at, nodes);
  }
  return std::nullopt;
}

}  // namespace

Found problem(const fem::MeshSpec& spec, const ModelDescription&) {
  if (spec.is_file()) return std::nullopt;
  if (!spec.material) {
    return Finding{"", "the key \"material\" is missing; add it, for example material: steel"};
  }
  if (!spec.materials.empty()) {
    return Finding{"materials", "a generated mesh has one `material`; remove this key"};
  }
  const char* of_files = spec.section             ? "section"
                         : !spec.sections.empty() ? "sections"
                         : spec.links             ? "links"
                         : !spec.only.empty()     ? "only"
                         : !spec.skip.empty()     ? "skip"
                         : spec.integration       ? "integration"
                                                  : nullptr;
  if (of_files != nullptr) {
    if (std::string(of_files) == "integration" &&
        !std::holds_alternative<fem::PlateMeshSpec>(spec.shape)) {
      return Finding{"integration",
                     "for a generated mesh this key belongs to the shape; move it there"};
    }
    return Finding{of_files, "only meshes from files take this key; remove it"};
  }
  if (spec.length_unit || spec.mass_unit) {
    return Finding{spec.length_unit ? "length-unit" : "mass-unit",
                   "this key is for mesh files only; write the unit after the number"};
  }
  if (const auto found = fem::size_problem(spec)) return Finding{"", *found};
  return mass_problem(spec.masses, fem::named_nodes(spec));
}

Found problem(const fem::GeometrySpec& spec, const ModelDescription&) {
  if (spec.order == 1 || spec.order == 2) return std::nullopt;
  return Finding{"order", "elements are linear (1) or quadratic (2)"};
}

Found problem(const fem::FaceColorSpec& spec, const ModelDescription&) {
  for (const int part : spec.rgb) {
    if (part > 255) {
      return Finding{"", "red, green and blue go from 0 to 255, for example [255, 0, 0]"};
    }
  }
  return std::nullopt;
}

Found problem(const fem::StructureSpec& spec, const ModelDescription&) {
  if (spec.beams.empty() && spec.bars.empty() && spec.solids.empty() && spec.shells.empty()) {
    return Finding{"", "a structure needs beams, bars, solids or shells"};
  }
  for (const auto& node : spec.nodes) {
    if (node.name == "origin" || node.name == "com") {
      return Finding{"nodes",
                     fmt::format("the name \"{}\" is predefined; choose another", node.name)};
    }
  }
  for (std::size_t i = 0; i < spec.beams.size(); ++i) {
    if (Found found = member_problem(spec, spec.beams[i], "beams", i)) return found;
  }
  for (std::size_t i = 0; i < spec.bars.size(); ++i) {
    if (Found found = member_problem(spec, spec.bars[i], "bars", i)) return found;
  }
  for (std::size_t i = 0; i < spec.solids.size(); ++i) {
    const std::string key = fmt::format("solids.{}.nodes", i);
    if (Found found = corner_problem(spec, spec.solids[i].nodes, key)) return found;
  }
  for (std::size_t i = 0; i < spec.shells.size(); ++i) {
    const std::string key = fmt::format("shells.{}.nodes", i);
    if (Found found = corner_problem(spec, spec.shells[i].nodes, key)) return found;
  }
  if (Found found = link_problem(spec)) return found;
  return mass_problem(spec.masses, names_of(spec.nodes));
}

}  // namespace buckens::model

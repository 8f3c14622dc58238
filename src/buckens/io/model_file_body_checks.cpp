// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/body/reduction_conflict.h"
#include "buckens/fem/generate_mesh.h"
#include "buckens/io/model_file_checks.h"
#include "buckens/io/model_file_names.h"

namespace buckens::io {

namespace {

using Eigen::Vector3d;

Finding inertia_problem(const std::vector<double>& entries) {
  if (entries.empty()) return std::nullopt;
  if (entries.size() != 3 && entries.size() != 6) {
    return Problem{"inertia", fmt::format("{} values stand here; expected are 3 (Ixx, Iyy, Izz) or "
                                          "6 (Ixx, Iyy, Izz, Ixy, Ixz, Iyz)",
                                          entries.size())};
  }
  const Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(fem::symmetric_matrix(entries))
          .eigenvalues();  // ascending
  // Data sheets round to three digits or so; planar models often give Izz alone.
  const double tolerance = 1e-3 * std::max(std::abs(principal[0]), principal[2]);
  if (principal[0] < -1e-12 * std::abs(principal[2])) {
    return Problem{"inertia",
                   fmt::format("the principal moments are {:.4g}, {:.4g}, {:.4g} kg m^2; "
                               "none can be negative. Check the signs and the order "
                               "Ixx, Iyy, Izz, Ixy, Ixz, Iyz",
                               principal[0], principal[1], principal[2])};
  }
  const bool is_planar_data = principal[1] == 0.0;
  if (!is_planar_data && principal[0] + principal[1] < principal[2] - tolerance) {
    return Problem{"inertia",
                   fmt::format("the principal moments {:.4g}, {:.4g}, {:.4g} kg m^2 belong to no "
                               "body: the largest exceeds the sum of the others",
                               principal[0], principal[1], principal[2])};
  }
  return std::nullopt;
}

Finding up_problem(const std::optional<Vector3d>& up, const Vector3d& along) {
  if (!up) return std::nullopt;
  if (up->norm() == 0.0) return Problem{"up", "a direction cannot be zero"};
  if (up->normalized().cross(along.normalized()).norm() < 1e-6) {
    return Problem{"up", "the direction is parallel to the beam; choose one across it"};
  }
  return std::nullopt;
}

}  // namespace

Finding problem(const fem::DampingSpec& spec, const ReadContext&) {
  if (spec.ratio.has_value() != spec.at.has_value()) {
    return Problem{spec.ratio ? "ratio" : "at",
                   "\"ratio\" and \"at\" belong together: {ratio: 2 %, at: [10 Hz, 200 Hz]}"};
  }
  if (!spec.ratio) return std::nullopt;
  if (spec.mass != 0 || spec.stiffness != 0) {
    return Problem{"ratio", "give either \"ratio\" and \"at\", or \"mass\" and \"stiffness\""};
  }
  if ((*spec.at)[0] >= (*spec.at)[1]) {
    return Problem{"at", "the second frequency must be higher than the first"};
  }
  return std::nullopt;
}

Finding problem(const fem::TubeSpec& spec, const ReadContext&) {
  if (spec.thickness.has_value() == spec.inner_diameter.has_value()) {
    return Problem{"", "exactly one of the keys thickness and inner-diameter is needed"};
  }
  if (spec.inner() > 0 && spec.inner() < spec.outer_diameter) return std::nullopt;
  return Problem{spec.thickness ? "thickness" : "inner-diameter",
                 fmt::format("the inner diameter would be {:g} m, the outer one is {:g} m; it must "
                             "lie between 0 and that (a solid section is a circle)",
                             spec.inner(), spec.outer_diameter)};
}

Finding problem(const fem::BoxSpec& spec, const ReadContext&) {
  if (2 * spec.thickness < std::min(spec.width, spec.height)) return std::nullopt;
  return Problem{"thickness", "the wall is thicker than half of the box; use a rectangle"};
}

Finding problem(const fem::PointMassSpec& spec, const ReadContext&) {
  return inertia_problem(spec.inertia);
}

Finding problem(const fem::BeamSpec& spec, const ReadContext&) {
  const double length = (spec.to - spec.from).norm();
  if (!(length > 0)) {
    return Problem{"to", "the beam has the length zero: \"from\" and \"to\" are the same point"};
  }
  for (const auto& mass : spec.masses) {
    if (mass.at != "start" && mass.at != "mid" && mass.at != "end") {
      return Problem{"masses",
                     fmt::format("unknown place \"{}\"; a beam has start, mid and end", mass.at)};
    }
    if (mass.at == "mid" && spec.elements % 2 != 0) {
      return Problem{"elements", fmt::format("a mass at mid needs an even number of elements, "
                                             "not {}",
                                             spec.elements)};
    }
  }
  return up_problem(spec.up, spec.to - spec.from);
}

Finding problem(const fem::BarMemberSpec& spec, const ReadContext&) {
  if (spec.section.has_value() != spec.area.has_value()) return std::nullopt;
  return Problem{"", "exactly one of the keys section and area is needed"};
}

namespace {

Finding unknown_node(const std::string& key, const std::string& name,
                     const std::vector<std::string>& known) {
  return Problem{key, fmt::format("unknown node \"{}\".{}", name, base::suggestion(name, known))};
}

/// Finding about the ends of a beam or bar between nodes.
template <class Member>
Finding member_problem(const fem::StructureSpec& spec, const Member& member, const char* list,
                       std::size_t index) {
  const std::string key = fmt::format("{}.{}", list, index);
  std::array<const fem::NodeSpec*, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] = base::find_named(spec.nodes, member.between[i]);
    if (ends[i] != nullptr) continue;
    return unknown_node(key + ".between", member.between[i], names_of(spec.nodes));
  }
  const Vector3d along = ends[1]->position - ends[0]->position;
  if (!(along.norm() > 0)) {
    return Problem{key + ".between", fmt::format("the member has the length zero: its nodes \"{}\" "
                                                 "and \"{}\" are the same point",
                                                 member.between[0], member.between[1])};
  }
  if constexpr (requires { member.up; }) return under(key.c_str(), up_problem(member.up, along));
  return std::nullopt;
}

/// Finding about the corners of a solid or shell element.
Finding corner_problem(const fem::StructureSpec& spec, const std::vector<std::string>& nodes,
                       const std::string& key) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (base::find_named(spec.nodes, nodes[i]) == nullptr) {
      return unknown_node(key, nodes[i], names_of(spec.nodes));
    }
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) !=
        nodes.begin() + static_cast<std::ptrdiff_t>(i)) {
      return Problem{key, fmt::format("node \"{}\" stands here twice; the corners of an element "
                                      "are different nodes",
                                      nodes[i])};
    }
  }
  return std::nullopt;
}

/// Finding about a node that a link names.
Finding link_problem(const fem::StructureSpec& spec) {
  if (!spec.links) return std::nullopt;
  const auto check = [&spec](const std::string& key, const std::string& node) -> Finding {
    if (base::find_named(spec.nodes, node) != nullptr) return std::nullopt;
    return unknown_node("links." + key, node, names_of(spec.nodes));
  };
  const auto check_links = [&check](const char* kind, const auto& links) -> Finding {
    for (std::size_t i = 0; i < links.size(); ++i) {
      const std::string key = fmt::format("{}.{}", kind, i);
      if (Finding found = check(key + ".reference", links[i].reference)) return found;
      for (const std::string& node : links[i].nodes) {
        if (Finding found = check(key + ".nodes", node)) return found;
      }
    }
    return std::nullopt;
  };
  if (Finding found = check_links("rigid", spec.links->rigid)) return found;
  if (Finding found = check_links("averages", spec.links->averages)) return found;
  for (std::size_t i = 0; i < spec.links->equations.size(); ++i) {
    for (const auto& term : spec.links->equations[i].terms) {
      if (Finding found = check(fmt::format("equations.{}.terms", i), term.node)) return found;
    }
  }
  for (std::size_t i = 0; i < spec.links->springs.size(); ++i) {
    for (const std::string& node : spec.links->springs[i].between) {
      if (Finding found = check(fmt::format("springs.{}.between", i), node)) return found;
    }
  }
  return std::nullopt;
}

Finding mass_problem(const std::vector<fem::PointMassSpec>& masses,
                     const std::vector<std::string>& nodes) {
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (std::find(nodes.begin(), nodes.end(), masses[i].at) != nodes.end()) continue;
    return unknown_node(fmt::format("masses.{}.at", i), masses[i].at, nodes);
  }
  return std::nullopt;
}

}  // namespace

Finding problem(const fem::MeshSpec& spec, const ReadContext&) {
  if (spec.is_file()) return std::nullopt;
  if (!spec.material) {
    return Problem{"", "the key \"material\" is missing; add it, for example material: steel"};
  }
  if (!spec.materials.empty()) {
    return Problem{"materials", "a generated mesh is of one `material`; remove this key"};
  }
  if (spec.length_unit || spec.mass_unit) {
    return Problem{spec.length_unit ? "length-unit" : "mass-unit",
                   "only files need to be told their units; write the unit behind the number"};
  }
  if (const auto found = fem::size_problem(spec)) return Problem{"", *found};
  return mass_problem(spec.masses, fem::named_nodes(spec));
}

Finding problem(const fem::GeometrySpec& spec, const ReadContext&) {
  if (spec.order == 1 || spec.order == 2) return std::nullopt;
  return Problem{"order", "elements are linear (1) or quadratic (2)"};
}

Finding problem(const fem::FaceColorSpec& spec, const ReadContext&) {
  for (const int part : spec.rgb) {
    if (part > 255) {
      return Problem{"", "red, green and blue go from 0 to 255, for example [255, 0, 0]"};
    }
  }
  return std::nullopt;
}

Finding problem(const fem::StructureSpec& spec, const ReadContext&) {
  if (spec.beams.empty() && spec.bars.empty() && spec.solids.empty() && spec.shells.empty()) {
    return Problem{"", "a structure needs beams, bars, solids or shells"};
  }
  for (const auto& node : spec.nodes) {
    if (node.name == "origin" || node.name == "com") {
      return Problem{"nodes",
                     fmt::format("the name \"{}\" is predefined; choose another", node.name)};
    }
  }
  for (std::size_t i = 0; i < spec.beams.size(); ++i) {
    if (Finding found = member_problem(spec, spec.beams[i], "beams", i)) return found;
  }
  for (std::size_t i = 0; i < spec.bars.size(); ++i) {
    if (Finding found = member_problem(spec, spec.bars[i], "bars", i)) return found;
  }
  for (std::size_t i = 0; i < spec.solids.size(); ++i) {
    const std::string key = fmt::format("solids.{}.nodes", i);
    if (Finding found = corner_problem(spec, spec.solids[i].nodes, key)) return found;
  }
  for (std::size_t i = 0; i < spec.shells.size(); ++i) {
    const std::string key = fmt::format("shells.{}.nodes", i);
    if (Finding found = corner_problem(spec, spec.shells[i].nodes, key)) return found;
  }
  if (Finding found = link_problem(spec)) return found;
  return mass_problem(spec.masses, names_of(spec.nodes));
}

Finding problem(const fem::CylinderSelection& spec, const ReadContext&) {
  if ((spec.to - spec.from).norm() > 0.0) return std::nullopt;
  return Problem{"to", "the cylinder has the length zero: \"from\" and \"to\" are the same point"};
}

Finding problem(const fem::PlaneSelection& spec, const ReadContext&) {
  if (spec.normal.norm() > 0.0) return std::nullopt;
  return Problem{"normal", "a normal cannot be [0, 0, 0]; give its direction"};
}

Finding problem(const body::CouplingSpec& spec, const ReadContext&) {
  if (spec.level == body::CouplingLevel::automatic && !spec.drop.empty()) {
    return Problem{"drop", "`auto` chooses the terms itself; drop terms from another level"};
  }
  if (spec.tolerance > 1.0) {
    return Problem{"tolerance", "more than all cannot be neglected; give 1 % or the like"};
  }
  return std::nullopt;
}

Finding problem(const body::OrientationSpec& spec, const ReadContext&) {
  if (spec.axis.has_value() != spec.angle.has_value()) {
    return Problem{spec.axis ? "axis" : "angle", "\"axis\" and \"angle\" belong together"};
  }
  const int ways = (spec.axis ? 1 : 0) + (spec.euler ? 1 : 0) + (spec.quaternion ? 1 : 0);
  if (ways != 1) {
    return Problem{"", "give the orientation in one way: axis and angle, euler, or quaternion"};
  }
  if (spec.axis) return axis_problem(*spec.axis);
  if (spec.quaternion && std::all_of(spec.quaternion->begin(), spec.quaternion->end(),
                                     [](double q) { return q == 0.0; })) {
    return Problem{"quaternion", "a quaternion cannot be zero"};
  }
  return std::nullopt;
}

Finding problem(const body::MarkerSpec& spec, const ReadContext&) {
  if (spec.position.has_value() == spec.at.empty()) return std::nullopt;
  return Problem{"", "exactly one of the keys position and at is needed"};
}

Finding problem(const body::RigidSpec& spec, const ReadContext&) {
  return inertia_problem(spec.inertia);
}

namespace {

/// Keys that need elements.
Finding matrices_problem(const body::BodySpec& spec, const fem::MatricesSpec& matrices) {
  if (!spec.frames.is_one()) {
    return Problem{"frames", "a body given by matrices cannot be divided; remove the key"};
  }
  if (spec.geometric_stiffness) {
    return Problem{"geometric-stiffness", "it belongs to beams and bars; remove the key"};
  }
  if (spec.damping && !matrices.damping.empty()) {
    return Problem{
        "damping",
        "give either a damping matrix (`matrices: {damping: file}`) or Rayleigh damping"};
  }
  return std::nullopt;
}

}  // namespace

Finding problem(const body::BodySpec& spec, const ReadContext&) {
  if (const auto conflict = body::reduction_conflict(spec)) {
    return Problem{conflict->key, conflict->text};
  }
  if (spec.is_rigid() && !spec.frames.is_one()) {
    return Problem{"frames", "a rigid body has one frame; remove the key \"frames\""};
  }
  if (spec.is_rigid() && spec.geometric_stiffness) {
    return Problem{"geometric-stiffness", "a rigid body has no stiffness; remove the key"};
  }
  if (const auto* matrices = std::get_if<fem::MatricesSpec>(&spec.kind)) {
    return matrices_problem(spec, *matrices);
  }
  const auto* structure = std::get_if<fem::StructureSpec>(&spec.kind);
  const bool is_solid =
      std::holds_alternative<fem::MeshSpec>(spec.kind) ||
      std::holds_alternative<fem::GeometrySpec>(spec.kind) ||
      (structure != nullptr && structure->beams.empty() && structure->bars.empty());
  if (is_solid && spec.geometric_stiffness) {
    return Problem{"geometric-stiffness",
                   "it belongs to beams and bars, a solid has none; remove the key, or give the "
                   "body more `frames`"};
  }
  if (structure != nullptr) {
    for (std::size_t i = 0; i < structure->bars.size() && !spec.frames.per_element; ++i) {
      if (structure->bars[i].elements == 1) continue;
      return Problem{fmt::format("structure.bars.{}.elements", i),
                     "bars in a row are a mechanism in one frame; write `frames: per-element`, or "
                     "use a beam"};
    }
  }
  return std::nullopt;
}

}  // namespace buckens::io

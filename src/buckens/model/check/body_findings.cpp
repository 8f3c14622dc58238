// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/body/reduction_conflict.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::model {

namespace {

using Eigen::Vector3d;

Found inertia_problem(const std::vector<double>& entries) {
  if (entries.empty()) return std::nullopt;
  if (entries.size() != 3 && entries.size() != 6) {
    return Finding{
        "inertia",
        fmt::format(
            "expected 3 values (Ixx, Iyy, Izz) or 6 (Ixx, Iyy, Izz, Ixy, Ixz, Iyz), found {}",
            entries.size())};
  }
  const Vector3d principal =
      spatial::principal_axes(fem::symmetric_matrix(entries)).values;  // ascending
  // Data sheets round to three digits or so; planar models often give Izz alone.
  const double tolerance = 1e-3 * std::max(std::abs(principal[0]), principal[2]);
  if (principal[0] < -1e-12 * std::abs(principal[2])) {
    return Finding{"inertia",
                   fmt::format("the principal moments are {:.4g}, {:.4g}, {:.4g} kg m^2; "
                               "none can be negative. Check the signs and the order "
                               "Ixx, Iyy, Izz, Ixy, Ixz, Iyz",
                               principal[0], principal[1], principal[2])};
  }
  const bool is_planar_data = principal[1] == 0.0;
  if (!is_planar_data && principal[0] + principal[1] < principal[2] - tolerance) {
    return Finding{"inertia",
                   fmt::format("the principal moments {:.4g}, {:.4g}, {:.4g} kg m^2 are physically "
                               "impossible: the largest exceeds the sum of the other two",
                               principal[0], principal[1], principal[2])};
  }
  return std::nullopt;
}

}  // namespace

Found problem(const fem::DampingSpec& spec, const ModelDescription&) {
  if (spec.ratio.has_value() == spec.at.empty()) {
    return Finding{spec.ratio ? "ratio" : "at",
                   "\"ratio\" and \"at\" belong together: {ratio: 2 %, at: [10 Hz, 200 Hz]}"};
  }
  if (!spec.ratio) {
    if (spec.of == fem::DampedModes::held) return std::nullopt;
    return Finding{"of",
                   "it says which vibrations `ratio` refers to and has no meaning for `mass` and "
                   "`stiffness`; remove the key"};
  }
  if (spec.mass != 0 || spec.stiffness != 0) {
    return Finding{"ratio", "give either \"ratio\" and \"at\", or \"mass\" and \"stiffness\""};
  }
  if (spec.at.size() > 2) {
    return Finding{"at", fmt::format("a ratio can be given at one or two frequencies, not at {}",
                                     spec.at.size())};
  }
  if (spec.at.size() == 2 && spec.at[0] >= spec.at[1]) {
    return Finding{"at", "the second frequency must be higher than the first"};
  }
  return std::nullopt;
}

Found problem(const fem::TubeSpec& spec, const ModelDescription&) {
  if (spec.thickness.has_value() == spec.inner_diameter.has_value()) {
    return Finding{"", "exactly one of the keys thickness and inner-diameter is needed"};
  }
  if (spec.inner() > 0 && spec.inner() < spec.outer_diameter) return std::nullopt;
  return Finding{
      spec.thickness ? "thickness" : "inner-diameter",
      fmt::format(
          "the inner diameter would be {:g} m, but the outer diameter is {:g} m; the inner one "
          "must be positive and less than the outer one (for a solid section use a circle)",
          spec.inner(), spec.outer_diameter)};
}

Found problem(const fem::BoxSpec& spec, const ModelDescription&) {
  if (2 * spec.thickness < std::min(spec.width, spec.height)) return std::nullopt;
  return Finding{"thickness", "the wall is thicker than half the box; use a rectangle"};
}

Found problem(const fem::PointMassSpec& spec, const ModelDescription&) {
  return inertia_problem(spec.inertia);
}

Found problem(const fem::CylinderSelection& spec, const ModelDescription&) {
  if ((spec.to - spec.from).norm() > 0.0) return std::nullopt;
  return Finding{"to", "the cylinder has zero length: \"from\" and \"to\" are the same point"};
}

Found problem(const fem::PlaneSelection& spec, const ModelDescription&) {
  if (spec.normal.norm() > 0.0) return std::nullopt;
  return Finding{"normal", "a normal cannot be [0, 0, 0]; give its direction"};
}

Found problem(const body::CouplingSpec& spec, const ModelDescription&) {
  if (spec.level == body::CouplingLevel::automatic && !spec.drop.empty()) {
    return Finding{"drop", "`auto` chooses the terms itself; to drop terms, choose another level"};
  }
  if (spec.tolerance > 1.0) {
    return Finding{"tolerance", "the share must be below 100 %; 1 % is usual"};
  }
  return std::nullopt;
}

Found problem(const body::SolverSpec& spec, const ModelDescription&) {
  if (spec.petsc.empty() || spec.choice().kind == body::SolverKind::iterative ||
      spec.choice().kind == body::SolverKind::automatic) {
    return std::nullopt;
  }
  return Finding{"petsc",
                 "`direct` solves without PETSc; remove its options, or write `kind: iterative`"};
}

Found problem(const body::OrientationSpec& spec, const ModelDescription&) {
  if (spec.axis.has_value() != spec.angle.has_value()) {
    return Finding{spec.axis ? "axis" : "angle", "\"axis\" and \"angle\" belong together"};
  }
  const int ways = (spec.axis ? 1 : 0) + (spec.euler ? 1 : 0) + (spec.quaternion ? 1 : 0);
  if (ways != 1) {
    return Finding{
        "", "give the orientation in exactly one form: axis and angle, euler, or quaternion"};
  }
  if (spec.axis) return axis_problem(*spec.axis);
  // Squares of smaller parts vanish, and with them the rotation.
  constexpr double kLeastPart = 1e-100;
  if (spec.quaternion && std::all_of(spec.quaternion->begin(), spec.quaternion->end(),
                                     [](double q) { return std::abs(q) < kLeastPart; })) {
    return Finding{"quaternion", "a quaternion cannot be zero"};
  }
  return std::nullopt;
}

Found problem(const body::MarkerSpec& spec, const ModelDescription&) {
  if (spec.position.has_value() == spec.at.empty()) return std::nullopt;
  return Finding{"", "exactly one of the keys position and at is needed"};
}

Found problem(const body::RigidSpec& spec, const ModelDescription&) {
  return inertia_problem(spec.inertia);
}

namespace {

/// Keys that need elements.
Found matrices_problem(const body::BodySpec& spec, const fem::MatricesSpec& matrices) {
  if (!spec.frames.is_one()) {
    return Finding{"frames", "a body given by matrices cannot be divided; remove the key"};
  }
  if (spec.geometric_stiffness) {
    return Finding{"geometric-stiffness", "it applies to beams and bars only; remove the key"};
  }
  if (spec.damping && !matrices.damping.empty()) {
    return Finding{
        "damping",
        "give either a damping matrix (`matrices: {damping: file}`) or Rayleigh damping"};
  }
  return std::nullopt;
}

/// Bodies without large systems of their own.
Found solver_problem(const body::BodySpec& spec) {
  const body::SolverKind kind = spec.solver.choice().kind;
  if (kind == body::SolverKind::direct) return std::nullopt;
  if (spec.is_rigid()) {
    return Finding{"solver", "a rigid body has no equations to solve; remove the key"};
  }
  if (kind == body::SolverKind::automatic) return std::nullopt;
  if (!spec.reduction.is_none() || spec.flexibility == body::Flexibility::quasi_static) {
    return Finding{"solver",
                   "a reduced or quasi-static body has a diagonal matrix, and its shapes come from "
                   "a factor of the mesh; write `solver: direct`, or keep the full mesh"};
  }
  if (!spec.frames.is_one()) {
    return Finding{"solver",
                   "the parts of a body with several frames are solved by factors; write `solver: "
                   "direct`, or `frames: 1`"};
  }
  return std::nullopt;
}

}  // namespace

Found problem(const body::BodySpec& spec, const ModelDescription&) {
  if (spec.name == "ground") {
    return Finding{"", "\"ground\" is reserved for the fixed world; choose another name"};
  }
  if (const auto conflict = body::reduction_conflict(spec)) {
    return Finding{conflict->key, conflict->text};
  }
  if (Found found = solver_problem(spec)) return found;
  if (spec.is_rigid() && !spec.frames.is_one()) {
    return Finding{"frames", "a rigid body has one frame; remove the key \"frames\""};
  }
  if (spec.is_rigid() && spec.geometric_stiffness) {
    return Finding{"geometric-stiffness", "a rigid body has no stiffness; remove the key"};
  }
  if (const auto* matrices = std::get_if<fem::MatricesSpec>(&spec.kind)) {
    return matrices_problem(spec, *matrices);
  }
  const auto* structure = std::get_if<fem::StructureSpec>(&spec.kind);
  // What is in a mesh file is known later.
  const auto* mesh = std::get_if<fem::MeshSpec>(&spec.kind);
  const bool is_solid =
      (mesh != nullptr && !mesh->is_file()) ||
      std::holds_alternative<fem::GeometrySpec>(spec.kind) ||
      (structure != nullptr && structure->beams.empty() && structure->bars.empty());
  if (is_solid && spec.geometric_stiffness) {
    return Finding{
        "geometric-stiffness",
        "it applies to beams and bars only; remove the key, or give the body more `frames`"};
  }
  if (structure != nullptr) {
    for (std::size_t i = 0; i < structure->bars.size() && !spec.frames.per_element; ++i) {
      if (structure->bars[i].elements == 1) continue;
      return Finding{fmt::format("structure.bars.{}.elements", i),
                     "a chain of bars in one frame is a mechanism; write `frames: per-element`, or "
                     "use a beam"};
    }
  }
  return std::nullopt;
}

Found problem_when_complete(const body::BodySpec& spec, const ModelDescription&) {
  if (spec.is_rigid() && spec.damping) {
    return Finding{"", "a rigid body has no material damping; remove the key \"damping\""};
  }
  if (spec.is_rigid() && !spec.interfaces.empty()) {
    return Finding{"", "a rigid body has no mesh and no interfaces; use `markers`"};
  }
  return names_problem(spec);
}

Found problem_when_complete(const InitialBodySpec& spec, const ModelDescription& model) {
  const body::BodySpec* body = base::find_named(model.bodies, spec.name);
  if (body == nullptr) {
    return Finding{"", fmt::format("unknown body \"{}\".{}", spec.name,
                                   base::suggestion(spec.name, names_of(model.bodies)))};
  }
  if (body->is_rigid() && spec.nodal_displacement) {
    return Finding{"",
                   fmt::format("body \"{}\" is rigid and has no nodes to displace; remove the key "
                               "\"nodal-displacement\"",
                               spec.name)};
  }
  if (body->is_rigid() && spec.nodal_velocity) {
    return Finding{"", fmt::format("body \"{}\" is rigid and has no nodal velocity; remove the key "
                                   "\"nodal-velocity\"",
                                   spec.name)};
  }
  return std::nullopt;
}

}  // namespace buckens::model

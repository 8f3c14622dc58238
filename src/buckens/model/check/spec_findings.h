// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Directions must not be zero.
Found axis_problem(const Eigen::Vector3d& axis);

// What is wrong with a spec whose fields are each valid; field paths start in the spec. Most specs
// have no such rules. `model` has what the spec may refer to: everything before it in the model
// file. record_rules.cpp lists the specs that have some.

Found problem(const fem::DampingSpec& spec, const ModelDescription& model);
Found problem(const fem::TubeSpec& spec, const ModelDescription& model);
Found problem(const fem::BoxSpec& spec, const ModelDescription& model);
Found problem(const fem::PointMassSpec& spec, const ModelDescription& model);
Found problem(const fem::BeamSpec& spec, const ModelDescription& model);
Found problem(const fem::BeamMemberSpec& spec, const ModelDescription& model);
Found problem(const fem::BarMemberSpec& spec, const ModelDescription& model);
Found problem(const fem::SolidMemberSpec& spec, const ModelDescription& model);
Found problem(const fem::ShellMemberSpec& spec, const ModelDescription& model);
Found problem(const fem::AverageLinkSpec& spec, const ModelDescription& model);
Found problem(const fem::StructureSpec& spec, const ModelDescription& model);
Found problem(const fem::GroupSectionSpec& spec, const ModelDescription& model);
Found problem(const fem::MeshSpec& spec, const ModelDescription& model);
Found problem(const fem::GeometrySpec& spec, const ModelDescription& model);
Found problem(const fem::FaceColorSpec& spec, const ModelDescription& model);
Found problem(const fem::BoxMeshSpec& spec, const ModelDescription& model);
Found problem(const fem::PlateMeshSpec& spec, const ModelDescription& model);
Found problem(const fem::CylinderMeshSpec& spec, const ModelDescription& model);
Found problem(const fem::TubeMeshSpec& spec, const ModelDescription& model);
Found problem(const fem::DiscMeshSpec& spec, const ModelDescription& model);
Found problem(const fem::OrthotropicSpec& spec, const ModelDescription& model);
Found problem(const fem::MaterialSpec& spec, const ModelDescription& model);
Found problem(const fem::CylinderSelection& spec, const ModelDescription& model);
Found problem(const fem::PlaneSelection& spec, const ModelDescription& model);
Found problem(const body::OrientationSpec& spec, const ModelDescription& model);
Found problem(const body::CouplingSpec& spec, const ModelDescription& model);
Found problem(const body::SolverSpec& spec, const ModelDescription& model);
Found problem(const body::MarkerSpec& spec, const ModelDescription& model);
Found problem(const body::RigidSpec& spec, const ModelDescription& model);
Found problem(const body::BodySpec& spec, const ModelDescription& model);
Found problem(const base::PathSegmentSpec& spec, const ModelDescription& model);
Found problem(const joints::JointSpec& spec, const ModelDescription& model);
Found problem(const loads::LoadSpec& spec, const ModelDescription& model);
Found problem(const SimulationSpec& spec, const ModelDescription& model);
Found problem(const StaticSpec& spec, const ModelDescription& model);
Found problem(const SignalSpec& spec, const ModelDescription& model);
Found problem(const MarkerSignalSpec& spec, const ModelDescription& model);
Found problem(const TransferFunctionSpec& spec, const ModelDescription& model);
Found problem(const StateSpaceSpec& spec, const ModelDescription& model);
Found problem(const PidSpec& spec, const ModelDescription& model);
Found problem(const TableSignalSpec& spec, const ModelDescription& model);
Found problem(const SwitchSpec& spec, const ModelDescription& model);
Found problem(const EventSpec& spec, const ModelDescription& model);
Found problem(const InitialJointSpec& spec, const ModelDescription& model);
Found problem(const InitialSpec& spec, const ModelDescription& model);
Found problem(const SensorSpec& spec, const ModelDescription& model);
Found problem(const ModelDescription& spec, const ModelDescription& model);

/// Joints that start outside of their stops.
Found stops_problem(const ModelDescription& model);
/// An axis is zero, or left out where no plane says it.
Found needed_axis_problem(const std::optional<Eigen::Vector3d>& axis,
                          const ModelDescription& model);

/// What is wrong with a body once it is known what it is made of: `like` resolved, mesh read.
Found problem_when_complete(const body::BodySpec& spec, const ModelDescription& model);
Found problem_when_complete(const InitialBodySpec& spec, const ModelDescription& model);

}  // namespace buckens::model

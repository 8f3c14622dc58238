// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/model/model_description.h"
#include "buckens/model_file/table.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// What is wrong with a spec whose fields are fine each by itself.
struct Problem {
  std::string key;  ///< the field to be corrected; empty: the whole
  std::string text;
};

using Finding = std::optional<Problem>;

/// Puts "key." before the key of a finding.
Finding under(const char* key, const Finding& finding);

/// Directions have a length.
Finding axis_problem(const Eigen::Vector3d& axis);

/// Most specs have no rules beyond those of their fields.
template <class T>
Finding problem(const T& /*spec*/, const ReadContext& /*context*/) {
  return std::nullopt;
}

Finding problem(const TableLawSpec& spec, const ReadContext& context);
Finding problem(const fem::DampingSpec& spec, const ReadContext& context);
Finding problem(const fem::TubeSpec& spec, const ReadContext& context);
Finding problem(const fem::BoxSpec& spec, const ReadContext& context);
Finding problem(const fem::PointMassSpec& spec, const ReadContext& context);
Finding problem(const fem::BeamSpec& spec, const ReadContext& context);
Finding problem(const fem::BeamMemberSpec& spec, const ReadContext& context);
Finding problem(const fem::BarMemberSpec& spec, const ReadContext& context);
Finding problem(const fem::SolidMemberSpec& spec, const ReadContext& context);
Finding problem(const fem::ShellMemberSpec& spec, const ReadContext& context);
Finding problem(const fem::AverageLinkSpec& spec, const ReadContext& context);
Finding problem(const fem::StructureSpec& spec, const ReadContext& context);
Finding problem(const fem::GroupSectionSpec& spec, const ReadContext& context);
Finding problem(const fem::MeshSpec& spec, const ReadContext& context);
Finding problem(const fem::GeometrySpec& spec, const ReadContext& context);
Finding problem(const fem::FaceColorSpec& spec, const ReadContext& context);
Finding problem(const fem::BoxMeshSpec& spec, const ReadContext& context);
Finding problem(const fem::PlateMeshSpec& spec, const ReadContext& context);
Finding problem(const fem::CylinderMeshSpec& spec, const ReadContext& context);
Finding problem(const fem::TubeMeshSpec& spec, const ReadContext& context);
Finding problem(const fem::DiscMeshSpec& spec, const ReadContext& context);
Finding problem(const fem::OrthotropicSpec& spec, const ReadContext& context);
Finding problem(const fem::MaterialSpec& spec, const ReadContext& context);
Finding problem(const fem::CylinderSelection& spec, const ReadContext& context);
Finding problem(const fem::PlaneSelection& spec, const ReadContext& context);
Finding problem(const body::OrientationSpec& spec, const ReadContext& context);
Finding problem(const body::CouplingSpec& spec, const ReadContext& context);
Finding problem(const body::MarkerSpec& spec, const ReadContext& context);
Finding problem(const body::RigidSpec& spec, const ReadContext& context);
Finding problem(const body::BodySpec& spec, const ReadContext& context);
Finding problem(const joints::JointSpec& spec, const ReadContext& context);
Finding problem(const loads::LoadSpec& spec, const ReadContext& context);
Finding problem(const model::SimulationSpec& spec, const ReadContext& context);
Finding problem(const model::StaticSpec& spec, const ReadContext& context);
Finding problem(const model::SensorSpec& spec, const ReadContext& context);
Finding problem(const model::ModelDescription& spec, const ReadContext& context);

}  // namespace buckens::model_file

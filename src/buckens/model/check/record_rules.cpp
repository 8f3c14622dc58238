// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/record_rules.h"

#include <typeindex>
#include <unordered_map>

#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

using Rule = Found (*)(const void* spec, const ModelDescription& model);
using Rules = std::unordered_map<std::type_index, Rule>;

template <class... Spec>
Rules written_rules() {
  return {{typeid(Spec), [](const void* spec, const ModelDescription& model) {
             return problem(*static_cast<const Spec*>(spec), model);
           }}...};
}

template <class... Spec>
Rules complete_rules() {
  return {{typeid(Spec), [](const void* spec, const ModelDescription& model) {
             return problem_when_complete(*static_cast<const Spec*>(spec), model);
           }}...};
}

Found applied(const Rules& rules, const base::Member& record, const ModelDescription& model) {
  const auto rule = rules.find(record.type->id());
  return rule == rules.end() ? std::nullopt : rule->second(record.at, model);
}

}  // namespace

Found written_problem(const base::Member& record, const ModelDescription& model) {
  static const Rules rules = written_rules<
      fem::DampingSpec, fem::TubeSpec, fem::BoxSpec, fem::PointMassSpec, fem::BeamSpec,
      fem::BeamMemberSpec, fem::BarMemberSpec, fem::SolidMemberSpec, fem::ShellMemberSpec,
      fem::AverageLinkSpec, fem::StructureSpec, fem::GroupSectionSpec, fem::MeshSpec,
      fem::GeometrySpec, fem::FaceColorSpec, fem::BoxMeshSpec, fem::PlateMeshSpec,
      fem::CylinderMeshSpec, fem::TubeMeshSpec, fem::DiscMeshSpec, fem::OrthotropicSpec,
      fem::MaterialSpec, fem::CylinderSelection, fem::PlaneSelection, body::OrientationSpec,
      body::CouplingSpec, body::SolverSpec, body::MarkerSpec, body::RigidSpec, body::BodySpec,
      base::PathSegmentSpec, joints::JointSpec, loads::LoadSpec, SimulationSpec, StaticSpec,
      SignalSpec, MarkerSignalSpec, TransferFunctionSpec, StateSpaceSpec, PidSpec, TableSignalSpec,
      SwitchSpec, EventSpec, InitialJointSpec, InitialSpec, SensorSpec, ModelDescription>();
  return applied(rules, record, model);
}

Found record_problem(const base::Member& record, const ModelDescription& model) {
  static const Rules rules = complete_rules<body::BodySpec, InitialBodySpec>();
  if (const Found found = written_problem(record, model)) return found;
  return applied(rules, record, model);
}

}  // namespace buckens::model

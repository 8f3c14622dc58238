// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Whether a load is a law on the angle (or the displacement) of a joint.
bool acts_on_coordinate(const loads::LoadSpec& load, bool turns);

/// Whether a joint has rigid teeth with play, which are one-sided rows.
bool has_play(const joints::JointSpec& joint);

/// Whether a sensor names a joint that does not exist.
Found joint_problem(const std::string& name, const ModelDescription& model);
/// The same of a sensor of its force or torque: rows of teeth with play are one-sided, and not
/// among these.
Found joint_force_problem(const std::string& name, const ModelDescription& model);

/// A coordinate of a joint that a model file asks for.
struct CoordinateQuery {
  std::string joint;
  std::optional<base::CoordinateChoice> asked;
  base::CoordinateSort sort = base::CoordinateSort::any;
  std::string key = "joint";        ///< field that names the joint
  std::string which_key = "which";  ///< field that names the coordinate
};

/// Whether a joint does not exist, or has no such coordinate, or several that may be meant.
Found coordinate_problem(const CoordinateQuery& query, const ModelDescription& model);

/// Whether joints do not exist or cannot be attached during a run.
/// @param key field that names them
Found attached_problem(const std::vector<std::string>& joints, const char* key,
                       const ModelDescription& model);

/// That an event cannot take teeth with play out of mesh, or bring them into it.
Finding released_play_problem(const joints::JointSpec& joint, const char* key);

// What is wrong with joints, laws and sensors of joints beyond their ends and axes.

Found own_joint_problem(const loads::HingeSpringSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::SlideSpringSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::HingeStopSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::SlideStopSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::HingeFrictionSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::BallFrictionSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::SlideFrictionSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::RopeSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::HingeMotorSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::SlideMotorSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::HingeBrakeSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::SlideBrakeSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::ElasticBeltSpec& spec, const ModelDescription& model);
Found own_joint_problem(const BeltSensor& spec, const ModelDescription& model);
Found own_joint_problem(const loads::CableSpec& spec, const ModelDescription& model);
Found own_joint_problem(const CableSensor& spec, const ModelDescription& model);
Found own_joint_problem(const JointCoordinateSensor& spec, const ModelDescription& model);
Found own_joint_problem(const joints::UniversalSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::ScrewSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::GearSpec& spec, const ModelDescription& model);
Found own_joint_problem(const loads::ElasticGearSpec& spec, const ModelDescription& model);
Found own_joint_problem(const GearSensor& spec, const ModelDescription& model);
Found own_joint_problem(const loads::CamSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::SlotSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::RackSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::CouplerSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::SliderOnBeamSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::RollingSpec& spec, const ModelDescription& model);
Found own_joint_problem(const joints::PrescribedCoordinateSpec& spec,
                        const ModelDescription& model);
/// Whether a coupler or a drive names joints that do not exist, or have no such coordinate.
Found coupled_joints_problem(const ModelDescription& model);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// What is wrong with a contact beyond its markers.
Found own_joint_problem(const loads::ContactSpec& spec, const ModelDescription& model);
/// What is wrong with contacts of many bodies.
Found own_joint_problem(const loads::ContactsSpec& spec, const ModelDescription& model);
/// What is wrong with the restitution of contacts.
Found restitution_problem(const loads::ContactForceSpec& spec, bool is_elastic);
/// Whether the contact that a sensor names exists.
Found own_joint_problem(const ContactSensor& spec, const ModelDescription& model);

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/timed_phase.h"
#include "buckens/body/basis_store.h"
#include "buckens/model/build/field_places.h"
#include "buckens/model/model.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// What a sensor observes.
struct SensorPlace {
  std::vector<MarkerId> markers;  ///< in the order of the spec
  int body = kGround;             ///< of section forces and stresses, index into Model::bodies
  int element = -1;               ///< line element of that body; −1 without `solids`: all
  int end = 0;                    ///< 0 its first end, 1 its second
  int coordinate = -1;            ///< of joint coordinates, index into Model::coordinates
  std::vector<int> solids;        ///< solid elements of that body at which stresses are averaged
};

/// A joint coordinate with an initial value or rate.
struct StartCoordinate {
  int coordinate = 0;           ///< index into Model::coordinates
  std::optional<double> value;  ///< [rad] or [m]
  std::optional<double> rate;   ///< [rad/s] or [m/s]
  SourceLocation where;
};

/// A built model and the non-mechanical contents of the description.
struct BuiltModel {
  Model model;
  ModelDescription description;
  std::vector<SensorPlace> sensors;     ///< one per entry of description.output.sensors
  std::vector<StartCoordinate> starts;  ///< of description.initial.joints
  std::vector<FieldPlaces> fields;      ///< of description.output.field_output; empty without it
  base::PhaseSeconds phases;            ///< of reading and building it
};

/// Builds and checks the mechanism.
/// @throws InputError or ModelError citing file:line:column, with names of bodies, joints and
/// markers
/// @param bases stores reduced bases between runs; null: none are stored
std::unique_ptr<BuiltModel> build_model(ModelDescription description,
                                        body::BasisStore* bases = nullptr);

}  // namespace buckens::model

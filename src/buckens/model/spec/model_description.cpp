// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

ModelDescription::ModelDescription() = default;
ModelDescription::ModelDescription(const ModelDescription&) = default;
ModelDescription::ModelDescription(ModelDescription&&) noexcept = default;
ModelDescription& ModelDescription::operator=(const ModelDescription&) = default;
ModelDescription& ModelDescription::operator=(ModelDescription&&) noexcept = default;
ModelDescription::~ModelDescription() = default;

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/paired_model.h"

namespace buckens::model {

PairedModel::PairedModel(const BuiltModel& built) : given_(built) {
  if (!RigidPairs::are_needed(built.model)) return;
  own_ = std::make_unique<BuiltModel>(built);
  pairs_.emplace(own_->model);
}

}  // namespace buckens::model

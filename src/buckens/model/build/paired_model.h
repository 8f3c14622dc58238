// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "buckens/model/build/build_model.h"
#include "buckens/model/build/rigid_pairs.h"

namespace buckens::model {

/// A built model, and where it has rigid contact groups a copy of it, whose loads change with the
/// pairs that are near each other.
class PairedModel {
 public:
  /// @param built must outlive this object
  explicit PairedModel(const BuiltModel& built);
  PairedModel(const PairedModel&) = delete;
  PairedModel& operator=(const PairedModel&) = delete;

  const BuiltModel& built() const { return own_ ? *own_ : given_; }
  /// Null without rigid groups.
  RigidPairs* pairs() { return pairs_ ? &*pairs_ : nullptr; }

 private:
  const BuiltModel& given_;
  std::unique_ptr<BuiltModel> own_;
  std::optional<RigidPairs> pairs_;
};

}  // namespace buckens::model

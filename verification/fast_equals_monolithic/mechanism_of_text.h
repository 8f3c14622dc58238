// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "verification/fast_equals_monolithic/same_steps.h"

#include "buckens/analysis/initial/prepare.h"
#include "buckens/model_file/model_file.h"

namespace buckens::verification {

/// The mechanism of a model file, ready for its first step.
struct MechanismOfText {
  std::unique_ptr<model::BuiltModel> built;
  test::Start start;

  explicit MechanismOfText(const std::string& text)
      : built(model::build_model(model_file::read_model_text(text, "model.yaml", {}))) {
    const dynamics::MassMetric metric(built->model);
    analysis::Prepared prepared = analysis::prepare(*built, metric);
    start = {std::move(prepared.state), std::move(prepared.rows_in_use)};
  }
};

}  // namespace buckens::verification

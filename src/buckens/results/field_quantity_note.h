// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/fe_model.h"
#include "buckens/model/spec/field_spec.h"

namespace buckens::results {

/// How a field quantity is called and measured.
struct QuantityNote {
  const char* name;
  const char* unit;
  const char* description;
  std::vector<std::string> components;
};

QuantityNote note_of(model::FieldQuantity quantity);

bool is_motion(model::FieldQuantity quantity);

/// Whether one of these quantities needs stresses.
bool has_tensors(const std::vector<model::FieldQuantity>& quantities);

/// Solid elements without shells, which are counted behind them.
int volume_elements(const fem::FeModel& mesh);

}  // namespace buckens::results

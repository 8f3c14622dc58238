// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/source_location.h"
#include "buckens/loads/signal_factor.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// The signal that multiplies a load. @param name of the signal; empty: none
/// @throws InputError naming load and signal if there is no such signal
loads::SignalFactor find_factor(const Model& model, const std::string& name,
                                const std::string& load, const SourceLocation& where);

}  // namespace buckens::model

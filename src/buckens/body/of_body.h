// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "buckens/base/errors.h"

namespace buckens::body {

/// Runs work on one body and adds its name to exceptions: matrices do not know which body they
/// belong to.
template <class Work>
auto of_body(const std::string& body, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const NumericalError& error) {
    throw NumericalError(error.where(), "body \"" + body + "\": " + error.text());
  }
}

}  // namespace buckens::body

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "buckens/base/errors.h"

namespace buckens::body {

/// Carries out work on one body and names it in what the work fails with: matrices do not know
/// whose they are.
template <class Work>
auto of_body(const std::string& body, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const NumericalError& error) {
    throw NumericalError(error.where(), "body \"" + body + "\": " + error.text());
  }
}

}  // namespace buckens::body

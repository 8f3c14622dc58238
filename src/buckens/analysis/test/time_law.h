// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/time_law.h"

namespace buckens::analysis::test {

/// A formula of t.
inline base::TimeLaw law_of_time(const std::string& text) {
  return base::TimeLaw::expression(base::Expression(text, {"t"}, {}, {}));
}

}  // namespace buckens::analysis::test

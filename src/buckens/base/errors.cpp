// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/errors.h"

namespace buckens {

void assertion_failed(const char* expression, const char* file, int line) {
  throw std::logic_error(std::string("internal error, please report it: ") + expression +
                         " does not hold at " + file + ":" + std::to_string(line));
}

}  // namespace buckens

// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/last_looks.h"

namespace buckens::spatial {

LastLooks& LastLooks::of_this_thread() {
  thread_local LastLooks looks;
  return looks;
}

}  // namespace buckens::spatial

// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/column_descriptions.h"

#include <new>

namespace buckens::linalg {

int ColumnDescriptions::give(void* source, int first, int end, const void** bytes,
                             long* count) try {
  auto& own = *static_cast<ColumnDescriptions*>(source);
  own.last_ = {};
  own.last_ = (*own.describe_)(first, end);
  *bytes = own.last_.data();
  *count = static_cast<long>(own.last_.size());
  return 0;
} catch (const std::bad_alloc&) {
  return 1;  // the plug-in says so to all processes
}

}  // namespace buckens::linalg

// SPDX-License-Identifier: Apache-2.0
#include "reasons.h"

#include <cstdio>

namespace buckens_petsc {

namespace {

std::string reason;  // one thread calls at a time

}  // namespace

std::string take_reason() {
  std::string out = reason.empty() ? "unknown error of PETSc" : reason;
  reason.clear();
  return out;
}

void set_reason(const std::string& text) { reason = text; }

int fail(char* error, int size) {
  std::snprintf(error, static_cast<std::size_t>(size), "%s", take_reason().c_str());
  return 1;
}

}  // namespace buckens_petsc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens_petsc {

/// The last error, which is forgotten by this.
std::string take_reason();
void set_reason(const std::string& text);
/// Writes it, and returns 1.
int fail(char* error, int size);

}  // namespace buckens_petsc

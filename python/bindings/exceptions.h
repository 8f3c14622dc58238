// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::python {

/// Converts the library's exceptions to those of buckens.errors, with text and location unchanged.
void translate_exceptions();

}  // namespace buckens::python

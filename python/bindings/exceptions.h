// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::python {

/// Turns the library's exceptions into those of buckens.errors, with text and place unchanged.
void translate_exceptions();

}  // namespace buckens::python

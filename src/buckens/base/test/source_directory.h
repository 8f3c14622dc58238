// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::test {

/// The checkout, for tests that read its files. Defined in a generated source, so that no other one
/// depends on where the checkout lies and compiler caches serve all of them.
extern const char* const kSourceDirectory;

}  // namespace buckens::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::test {

/// The checkout, for tests that read its files. Defined in a generated source, so that no other
/// source depends on where the checkout is and compiler caches work for all.
extern const char* const kSourceDirectory;

}  // namespace buckens::test

// SPDX-License-Identifier: Apache-2.0
// Any text as a deck of Abaqus: it is read or refused with an error of this library.
#include "tests/fuzz/memory_file.h"

#include "buckens/base/errors.h"
#include "buckens/mesh_io/abaqus/deck.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const buckens::fuzz::MemoryFile file;
  try {
    buckens::mesh_io::read_abaqus_deck(file.write(data, size));
  } catch (const buckens::Error&) {
    return 0;
  }
  return 0;
}

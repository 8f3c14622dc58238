// SPDX-License-Identifier: Apache-2.0
// Any text as a matrix and as the table of its nodes: both are read or refused with an error of
// this library.
#include "tests/fuzz/memory_file.h"

#include "buckens/base/errors.h"
#include "buckens/mesh_io/matrix/file.h"
#include "buckens/mesh_io/matrix/node_table.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const buckens::fuzz::MemoryFile file;
  const std::filesystem::path path = file.write(data, size);
  try {
    buckens::mesh_io::read_matrix_file(path);
  } catch (const buckens::Error&) {
    // The table is read nevertheless.
  }
  try {
    buckens::mesh_io::read_matrix_node_table(path);
  } catch (const buckens::Error&) {
    return 0;
  }
  return 0;
}

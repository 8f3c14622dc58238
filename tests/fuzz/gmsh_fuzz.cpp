// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh of Gmsh or a universal file: they are read or refused with an error of this
// library.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/gmsh/mesh.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    // Universal files begin with "    -1", those of Gmsh with a dollar sign.
    buckens::mesh_io::read_gmsh_bytes(bytes, bytes.starts_with(' ') ? "input.unv" : "input.msh");
  } catch (const buckens::Error&) {
    return 0;
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Any text as a deck of Nastran: it is read or refused with an error of this library.
#include <cstddef>
#include <cstdint>
#include <string>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/deck.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    // Included files: the deck itself under short names, nothing else.
    buckens::mesh_io::read_nastran_text(text, "deck.bdf", [&](const std::filesystem::path& path) {
      if (path.string().size() > 8) throw buckens::IoError("no such file");
      return text.substr(text.size() / 2);
    });
  } catch (const buckens::Error&) {
    return 0;
  }
  return 0;
}

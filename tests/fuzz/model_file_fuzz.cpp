// SPDX-License-Identifier: Apache-2.0
// Any text as a model file: it is read or refused with an error of this library.
#include <cstddef>
#include <cstdint>
#include <string>

#include "buckens/base/errors.h"
#include "buckens/model_file/model_file.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    // Files that it names are looked for where there are none.
    buckens::model_file::read_model_text(std::string(reinterpret_cast<const char*>(data), size),
                                         "nowhere/model.yaml");
  } catch (const buckens::Error&) {
    return 0;
  }
  return 0;
}

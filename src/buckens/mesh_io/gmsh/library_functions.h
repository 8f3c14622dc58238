// SPDX-License-Identifier: Apache-2.0
// How the sources of GmshLibrary call functions of the library.
#pragma once

#include <cstddef>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/gmsh/library.h"

namespace buckens::mesh_io {

inline std::vector<int> flat(const std::vector<GmshEntity>& entities) {
  std::vector<int> out;
  for (const auto& [dimension, tag] : entities) {
    out.push_back(dimension);
    out.push_back(tag);
  }
  return out;
}

inline std::vector<GmshEntity> pairs(const int* found, std::size_t count) {
  std::vector<GmshEntity> out;
  for (std::size_t i = 0; i + 1 < count; i += 2) out.emplace_back(found[i], found[i + 1]);
  return out;
}

/// The function of the library with its type from gmshc.h.
#define BUCKENS_GMSH(name) function<decltype(&::name)>(#name)

template <class Function>
Function GmshLibrary::function(const char* name) const {
  void* found = ::dlsym(handle_, name);
  if (found == nullptr) {
    throw IoError(fmt::format("the library {} has no function {}; Buckens needs Gmsh 4.8 or newer",
                              BUCKENS_GMSH_LIBRARY, name));
  }
  return reinterpret_cast<Function>(found);
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "solver_library.h"

#include <dlfcn.h>

#include "reasons.h"

namespace buckens_petsc {

namespace {

constexpr const char* kFile = "libbuckens_petsc_solvers.so";

const SolverLibrary* loaded = nullptr;

/// Beside this library.
std::string place_of_library() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&place_of_library), &info) == 0) return kFile;
  const std::string own = info.dli_fname == nullptr ? "" : info.dli_fname;
  const std::size_t slash = own.rfind('/');
  return slash == std::string::npos ? kFile : own.substr(0, slash + 1) + kFile;
}

}  // namespace

const SolverLibrary* solver_library() {
  if (loaded != nullptr) return loaded;
  const std::string place = place_of_library();
  void* library = ::dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  const auto find =
      library == nullptr
          ? nullptr
          : reinterpret_cast<const SolverLibrary* (*)()>(::dlsym(library, "buckens_petsc_solvers"));
  if (find == nullptr) {
    const char* text = ::dlerror();
    set_reason(
        "the solvers of PETSc cannot be loaded: " + (text == nullptr ? place : text) +
        "; install the libraries that they need (Debian: libpetsc-real3.18, libslepc-real3.18)");
    return nullptr;
  }
  loaded = find();
  return loaded;
}

void end_solver_library() {
  if (loaded != nullptr) loaded->end();
}

}  // namespace buckens_petsc

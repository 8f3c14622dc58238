// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/grid_library.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {

constexpr const char* kGridVariable = "BUCKENS_GRID_PLUGIN";
constexpr const char* kGridFile = "libbuckens_petsc.so";

struct GridLibrary {
  const BuckensGridPlugin* plugin = nullptr;
  std::string reason;

  GridLibrary() {
    const std::vector<std::filesystem::path> places = candidates();
    for (const std::filesystem::path& place : places) {
      std::error_code ignored;
      if (!std::filesystem::exists(place, ignored)) continue;
      take(place.string());
      return;
    }
    reason = fmt::format(
        "this installation has none: there is no file {}; build Buckens with "
        "-DBUCKENS_PETSC=ON (Debian: libpetsc-real-dev, libslepc-real-dev, libptscotch-dev)",
        places.empty() ? kGridFile : places.back().string());
  }

 private:
  static std::vector<std::filesystem::path> candidates() {
    if (const char* named = std::getenv(kGridVariable); named != nullptr && *named != '\0') {
      return {named};
    }
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&missing_grid_solver), &info) == 0) return {};
    std::error_code ignored;
    std::filesystem::path home = std::filesystem::canonical("/proc/self/exe", ignored);
    // Code of a shared library such as the Python module looks beside that.
    if (info.dli_fname != nullptr && std::string(info.dli_fname).find(".so") != std::string::npos) {
      home = std::filesystem::absolute(info.dli_fname, ignored);
    }
    home = home.parent_path();
    return {home / kGridFile, home.parent_path() / "lib" / kGridFile,
            home.parent_path() / "lib" / "buckens" / kGridFile};
  }

  void take(const std::string& file) {
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      const char* text = ::dlerror();
      reason = fmt::format(
          "it cannot be loaded: {}; install the libraries that it needs (Debian: "
          "libpetsc-real3.18)",
          text == nullptr ? file : text);
      return;
    }
    const auto find =
        reinterpret_cast<BuckensFindGridPlugin>(::dlsym(library, "buckens_grid_plugin"));
    const BuckensGridPlugin* found = find == nullptr ? nullptr : find();
    if (found == nullptr || found->version != kBuckensGridVersion) {
      reason = fmt::format(
          "{} belongs to another version of Buckens; build both from the same "
          "sources",
          file);
      return;
    }
    plugin = found;
  }
};

const GridLibrary& grid_library() {
  static const GridLibrary library;
  return library;
}

}  // namespace

std::string missing_grid_solver() { return grid_library().reason; }

std::mutex& turn_of_grid_solver() {
  static std::mutex mutex;
  return mutex;
}

const BuckensGridPlugin& grid_solver() {
  if (grid_library().plugin == nullptr) {
    throw IoError("iterative solves need the multigrid solver: " + grid_library().reason);
  }
  return *grid_library().plugin;
}

}  // namespace buckens::linalg

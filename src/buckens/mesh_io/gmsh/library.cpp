// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/gmsh/library.h"

#include <cstdio>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/gmsh/library_functions.h"

namespace buckens::mesh_io {

GmshLibrary::GmshLibrary() : handle_(::dlopen(BUCKENS_GMSH_LIBRARY, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    const char* reason = ::dlerror();
    throw IoError(
        fmt::format("STEP files are meshed by the library of Gmsh, which cannot be "
                    "loaded: {}. Install it (Debian: libgmsh4.8)",
                    reason == nullptr ? BUCKENS_GMSH_LIBRARY : reason));
  }
  // A copied process has none of the threads that OpenMP remembers.
  if (void* threads = ::dlsym(handle_, "omp_set_num_threads")) {
    reinterpret_cast<void (*)(int)>(threads)(1);
  }
  int error = 0;
  BUCKENS_GMSH(gmshInitialize)(0, nullptr, 0, &error);
  check(error);
  set_number("General.Terminal", 0);
  set_number("General.NumThreads", 1);
  BUCKENS_GMSH(gmshLoggerStart)(&error);
  check(error);
}

void GmshLibrary::check(int error) const {
  if (error == 0) return;
  char* text = nullptr;
  int ignored = 0;
  BUCKENS_GMSH(gmshLoggerGetLastError)(&text, &ignored);
  throw IoError(text == nullptr || *text == '\0' ? fmt::format("error {}", error) : text);
}

void GmshLibrary::set_number(const char* option, double value) {
  int error = 0;
  BUCKENS_GMSH(gmshOptionSetNumber)(option, value, &error);
  check(error);
}

void GmshLibrary::set_text(const char* option, const char* value) {
  int error = 0;
  BUCKENS_GMSH(gmshOptionSetString)(option, value, &error);
  check(error);
}

void GmshLibrary::new_model(const char* name) {
  int error = 0;
  BUCKENS_GMSH(gmshModelAdd)(name, &error);
  check(error);
}

void GmshLibrary::use_model(const char* name) {
  int error = 0;
  BUCKENS_GMSH(gmshModelSetCurrent)(name, &error);
  check(error);
}

void GmshLibrary::add_group(int dimension, std::vector<int> entities, const std::string& name) {
  int error = 0;
  const int tag = BUCKENS_GMSH(gmshModelAddPhysicalGroup)(dimension, entities.data(),
                                                          entities.size(), -1, &error);
  check(error);
  BUCKENS_GMSH(gmshModelSetPhysicalName)(dimension, tag, name.c_str(), &error);
  check(error);
}

void GmshLibrary::mesh(int dimension) {
  int error = 0;
  BUCKENS_GMSH(gmshModelMeshGenerate)(dimension, &error);
  check(error);
}

void GmshLibrary::clear_mesh() {
  int error = 0;
  BUCKENS_GMSH(gmshModelMeshClear)(nullptr, 0, &error);
  check(error);
  BUCKENS_GMSH(gmshLoggerStop)(&error);
  BUCKENS_GMSH(gmshLoggerStart)(&error);
  check(error);
}

std::pair<std::vector<std::size_t>, std::vector<double>> GmshLibrary::nodes() const {
  int error = 0;
  std::size_t *tags = nullptr, num_tags = 0, num_places = 0, num_ignored = 0;
  double *places = nullptr, *ignored = nullptr;
  BUCKENS_GMSH(gmshModelMeshGetNodes)
  (&tags, &num_tags, &places, &num_places, &ignored, &num_ignored, -1, -1, 0, 0, &error);
  check(error);
  return {{tags, tags + num_tags}, {places, places + num_places}};
}

std::vector<std::size_t> GmshLibrary::element_nodes(int type, int entity) const {
  int error = 0;
  std::size_t *tags = nullptr, *nodes = nullptr, num_tags = 0, num_nodes = 0;
  BUCKENS_GMSH(gmshModelMeshGetElementsByType)
  (type, &tags, &num_tags, &nodes, &num_nodes, entity, 0, 1, &error);
  check(error);
  return {nodes, nodes + num_nodes};
}

void GmshLibrary::bound_sizes(const SizeOf* size) {
  int error = 0;
  if (size == nullptr) {
    BUCKENS_GMSH(gmshModelMeshRemoveSizeCallback)(&error);
    return check(error);
  }
  const auto ask = [](int dimension, int entity, double, double, double, void* data) {
    return (*static_cast<const SizeOf*>(data))(dimension, entity);
  };
  BUCKENS_GMSH(gmshModelMeshSetSizeCallback)(ask, const_cast<SizeOf*>(size), &error);
  check(error);
}

void GmshLibrary::set_order(int order) {
  int error = 0;
  BUCKENS_GMSH(gmshModelMeshSetOrder)(order, &error);
  check(error);
}

void GmshLibrary::optimize(const char* way) {
  int error = 0;
  BUCKENS_GMSH(gmshModelMeshOptimize)(way, 0, 1, nullptr, 0, &error);
  check(error);
}

void GmshLibrary::write(const std::string& file) {
  int error = 0;
  BUCKENS_GMSH(gmshWrite)(file.c_str(), &error);
  check(error);
}

void GmshLibrary::be_heard() { set_number("General.Terminal", 1); }

std::vector<std::string> GmshLibrary::log() const {
  int error = 0;
  char** lines = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshLoggerGet)(&lines, &count, &error);
  return error == 0 ? std::vector<std::string>(lines, lines + count) : std::vector<std::string>();
}

std::array<double, 3> GmshLibrary::mesh_seconds() const {
  std::array<double, 3> out{};
  for (const std::string& line : log()) {
    int dimension = 0;
    double seconds = 0;
    const std::size_t at = line.find("Done meshing");
    if (at == std::string::npos) continue;
    if (std::sscanf(line.c_str() + at, "Done meshing %dD (Wall %lfs", &dimension, &seconds) == 2 &&
        dimension >= 1 && dimension <= 3) {
      out[static_cast<std::size_t>(dimension - 1)] = seconds;
    }
  }
  return out;
}

std::vector<std::string> GmshLibrary::messages() const {
  std::vector<std::string> out;
  for (const std::string& line : log()) {
    if (line.starts_with("Warning") || line.starts_with("Error")) out.push_back(line);
  }
  return out;
}

std::vector<GmshEntity> GmshLibrary::entities_at_fault() const {
  int error = 0;
  int* found = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelMeshGetLastEntityError)(&found, &count, &error);
  return error == 0 ? pairs(found, count) : std::vector<GmshEntity>();
}

}  // namespace buckens::mesh_io

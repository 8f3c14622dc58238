// SPDX-License-Identifier: Apache-2.0
// Shapes in Gmsh: what they are, where they are, and what is done to them.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <dlfcn.h>
#include <gmshc.h>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/gmsh/library_functions.h"

namespace buckens::mesh_io {

void GmshLibrary::import_shapes(const std::string& file) {
  int error = 0;
  int* entities = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelOccImportShapes)(file.c_str(), &entities, &count, 0, "step", &error);
  check(error);
  BUCKENS_GMSH(gmshModelOccSynchronize)(&error);
  check(error);
}

std::vector<std::vector<GmshEntity>> GmshLibrary::fragment(const std::vector<GmshEntity>& volumes) {
  int error = 0;
  std::vector<int> objects = flat({volumes.begin(), volumes.begin() + 1});
  std::vector<int> tools = flat({volumes.begin() + 1, volumes.end()});
  int* out = nullptr;
  int** map = nullptr;
  std::size_t count = 0, maps = 0;
  std::size_t* map_sizes = nullptr;
  BUCKENS_GMSH(gmshModelOccFragment)
  (objects.data(), objects.size(), tools.data(), tools.size(), &out, &count, &map, &map_sizes,
   &maps, -1, 1, 1, &error);
  check(error);
  BUCKENS_GMSH(gmshModelOccSynchronize)(&error);
  check(error);
  std::vector<std::vector<GmshEntity>> pieces;
  for (std::size_t k = 0; k < maps; ++k) pieces.push_back(pairs(map[k], map_sizes[k]));
  return pieces;
}

void GmshLibrary::remove(const std::vector<GmshEntity>& volumes) {
  int error = 0;
  std::vector<int> tags = flat(volumes);
  BUCKENS_GMSH(gmshModelOccRemove)(tags.data(), tags.size(), 1, &error);
  check(error);
  BUCKENS_GMSH(gmshModelOccSynchronize)(&error);
  check(error);
}

void GmshLibrary::heal(double tolerance) {
  int error = 0;
  int* out = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelOccHealShapes)(&out, &count, nullptr, 0, tolerance, 1, 1, 1, 1, 1, &error);
  check(error);
  BUCKENS_GMSH(gmshModelOccSynchronize)(&error);
  check(error);
}

std::vector<GmshEntity> GmshLibrary::boundary(const std::vector<GmshEntity>& entities) const {
  int error = 0;
  std::vector<int> tags = flat(entities);
  int* found = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelGetBoundary)(tags.data(), tags.size(), &found, &count, 1, 0, 0, &error);
  check(error);
  return pairs(found, count);
}

std::vector<GmshEntity> GmshLibrary::boundary_of_each(
    const std::vector<GmshEntity>& entities) const {
  int error = 0;
  std::vector<int> tags = flat(entities);
  int* found = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelGetBoundary)(tags.data(), tags.size(), &found, &count, 0, 0, 0, &error);
  check(error);
  return pairs(found, count);
}

void GmshLibrary::replace_faces(const GmshEntity& solid,
                                const std::vector<std::vector<int>>& shells,
                                const std::map<int, std::vector<int>>& loops,
                                const std::map<int, std::vector<std::array<double, 3>>>& points) {
  int error = 0;
  const auto take_away = [&](const GmshEntity& entity) {
    std::vector<int> tags = flat({entity});
    BUCKENS_GMSH(gmshModelOccRemove)(tags.data(), tags.size(), 0, &error);
    check(error);
  };
  take_away(solid);
  for (const auto& [face, curves] : loops) {
    take_away({2, face});
    std::vector<int> tags = curves;
    const int wire = BUCKENS_GMSH(gmshModelOccAddWire)(tags.data(), tags.size(), -1, 1, &error);
    check(error);
    std::vector<int> through;
    if (const auto own = points.find(face); own != points.end()) {
      for (const auto& [x, y, z] : own->second) {
        through.push_back(BUCKENS_GMSH(gmshModelOccAddPoint)(x, y, z, 0.0, -1, &error));
        check(error);
      }
    }
    BUCKENS_GMSH(gmshModelOccAddSurfaceFilling)
    (wire, face, through.data(), through.size(), &error);
    check(error);
    for (const int point : through) take_away({0, point});
  }
  std::vector<int> loop_tags;
  for (std::vector<int> faces : shells) {
    loop_tags.push_back(
        BUCKENS_GMSH(gmshModelOccAddSurfaceLoop)(faces.data(), faces.size(), -1, 0, &error));
    check(error);
  }
  BUCKENS_GMSH(gmshModelOccAddVolume)(loop_tags.data(), loop_tags.size(), solid.second, &error);
  check(error);
  BUCKENS_GMSH(gmshModelOccSynchronize)(&error);
  check(error);
}

std::vector<std::array<double, 3>> GmshLibrary::inner_points(int face, int count) const {
  int error = 0;
  double *low = nullptr, *high = nullptr;
  std::size_t num_low = 0, num_high = 0;
  BUCKENS_GMSH(gmshModelGetParametrizationBounds)
  (2, face, &low, &num_low, &high, &num_high, &error);
  check(error);
  const std::array<double, 4> bounds = {low[0], high[0], low[1], high[1]};
  BUCKENS_GMSH(gmshFree)(low);
  BUCKENS_GMSH(gmshFree)(high);
  std::vector<std::array<double, 3>> places, normals;
  std::array<double, 3> sum{};
  const auto share = [count](int k) { return 0.25 + 0.5 * k / (count - 1); };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      std::array<double, 2> at = {bounds[0] + (bounds[1] - bounds[0]) * share(i),
                                  bounds[2] + (bounds[3] - bounds[2]) * share(j)};
      const int is_inside = BUCKENS_GMSH(gmshModelIsInside)(2, face, at.data(), 2, &error);
      check(error);
      if (is_inside == 0) continue;
      double *place = nullptr, *normal = nullptr;
      std::size_t length = 0;
      BUCKENS_GMSH(gmshModelGetValue)(2, face, at.data(), 2, &place, &length, &error);
      check(error);
      BUCKENS_GMSH(gmshModelGetNormal)(face, at.data(), 2, &normal, &length, &error);
      check(error);
      places.push_back({place[0], place[1], place[2]});
      normals.push_back({normal[0], normal[1], normal[2]});
      BUCKENS_GMSH(gmshFree)(place);
      BUCKENS_GMSH(gmshFree)(normal);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normals.back()[k];
    }
  }
  std::vector<std::array<double, 3>> out;
  for (std::size_t p = 0; p < places.size(); ++p) {
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) along += normals[p][k] * sum[k];
    if (along > 0) out.push_back(places[p]);
  }
  return out;
}

std::vector<GmshEntity> GmshLibrary::entities(int dimension) const {
  int error = 0;
  int* found = nullptr;
  std::size_t count = 0;
  BUCKENS_GMSH(gmshModelGetEntities)(&found, &count, dimension, &error);
  check(error);
  return pairs(found, count);
}

std::string GmshLibrary::name(const GmshEntity& entity) const {
  int error = 0;
  char* found = nullptr;
  BUCKENS_GMSH(gmshModelGetEntityName)(entity.first, entity.second, &found, &error);
  check(error);
  return found == nullptr ? "" : found;
}

GmshLibrary::Color GmshLibrary::color(const GmshEntity& entity) const {
  int error = 0;
  Color out{};
  BUCKENS_GMSH(gmshModelGetColor)
  (entity.first, entity.second, &out.red, &out.green, &out.blue, &out.alpha, &error);
  check(error);
  return out;
}

double GmshLibrary::size(const GmshEntity& entity) const {
  int error = 0;
  double out = 0;
  BUCKENS_GMSH(gmshModelOccGetMass)(entity.first, entity.second, &out, &error);
  check(error);
  return out;
}

double GmshLibrary::largest_curvature(int face) const {
  int error = 0;
  double *low = nullptr, *high = nullptr, *most = nullptr, *least = nullptr, *ignored[2] = {};
  std::size_t num_low = 0, num_high = 0, num_most = 0, num_least = 0, sizes[2] = {};
  BUCKENS_GMSH(gmshModelGetParametrizationBounds)
  (2, face, &low, &num_low, &high, &num_high, &error);
  if (error != 0 || num_low < 2 || num_high < 2) return 0;
  std::vector<double> places;
  for (const double u : {1.0 / 6, 0.5, 5.0 / 6}) {
    for (const double v : {1.0 / 6, 0.5, 5.0 / 6}) {
      places.push_back(low[0] + u * (high[0] - low[0]));
      places.push_back(low[1] + v * (high[1] - low[1]));
    }
  }
  BUCKENS_GMSH(gmshModelGetPrincipalCurvatures)
  (face, places.data(), places.size(), &most, &num_most, &least, &num_least, &ignored[0], &sizes[0],
   &ignored[1], &sizes[1], &error);
  double out = 0;
  for (std::size_t k = 0; error == 0 && k < std::min(num_most, num_least); ++k) {
    for (const double found : {most[k], least[k]}) {
      if (std::isfinite(found)) out = std::max(out, std::abs(found));
    }
  }
  return out;
}

std::array<double, 3> GmshLibrary::centre(const GmshEntity& entity) const {
  int error = 0;
  std::array<double, 3> out{};
  BUCKENS_GMSH(gmshModelOccGetCenterOfMass)
  (entity.first, entity.second, &out[0], &out[1], &out[2], &error);
  check(error);
  return out;
}

std::array<double, 6> GmshLibrary::box(const GmshEntity& entity) const {
  int error = 0;
  std::array<double, 6> out{};
  BUCKENS_GMSH(gmshModelGetBoundingBox)
  (entity.first, entity.second, &out[0], &out[1], &out[2], &out[3], &out[4], &out[5], &error);
  check(error);
  return out;
}

}  // namespace buckens::mesh_io

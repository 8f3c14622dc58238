// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::mesh_io {

/// Numbers for every point or cell of a VTK grid, or for the grid as a whole.
struct VtuArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::uint8_t>,
                              std::vector<std::int32_t>, std::vector<std::int64_t>>;

  std::string name;
  int components = 1;                        ///< numbers per point or cell, consecutive
  Values values;                             ///< written with the type they have here
  std::vector<std::string> component_names;  ///< as many as components, or none
};

/// An unstructured grid of VTK with data.
struct VtuGrid {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::int64_t> connectivity;  ///< points of all cells, one after the other
  std::vector<std::int64_t> offsets;       ///< end of each cell in `connectivity`
  std::vector<std::uint8_t> types;         ///< VTK's number of each cell's shape
  std::vector<VtuArray> point_data, cell_data;
  std::vector<VtuArray> field_data;  ///< of any length, for instance TimeValue

  /// @param nodes in the order of Abaqus; VTK's differs for wedges
  void add_cell(fem::CellKind kind, std::span<const int> nodes);
};

/// VTK's number of a shape.
std::uint8_t vtk_cell_type(fem::CellKind kind);

/// The grid as an XML file of VTK (version 1.0): little-endian, raw appended, compressed with zlib
/// in blocks of 64 KiB.
/// @throws InputError if the length of an array does not match its components
std::string vtu_bytes(const VtuGrid& grid);

/// Writes vtu_bytes() atomically: a reader sees all of it or the old contents. @throws IoError
void write_vtu(const std::filesystem::path& path, const VtuGrid& grid);

/// One instant of a collection.
struct PvdEntry {
  double time = 0;
  std::string file;  ///< relative to the collection
};

/// A ParaView collection: which file belongs to which instant. @throws IoError
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::bench {

/// Steel block of solid elements: a cube of 0.1 m, or 1 × 0.1 × 0.1 m where there are more than
/// four times as many elements along as across.
struct SolidBlock {
  fem::SolidKind kind = fem::SolidKind::hex8;
  std::array<int, 3> divisions = {1, 1, 1};

  /// From "hex8:274,10,10". @throws std::invalid_argument
  static SolidBlock parse(const std::string& text);

  bool is_slender() const { return divisions[0] > 4 * divisions[1]; }
  std::string element() const { return kind == fem::SolidKind::tet10 ? "tet10" : "hex8"; }
  std::string shape() const {
    return fmt::format("{} x {} x {}", divisions[0], divisions[1], divisions[2]);
  }
  Eigen::Vector3d size() const { return {is_slender() ? 1.0 : 0.1, 0.1, 0.1}; }
  fem::FeModel assembled() const;
};

inline SolidBlock SolidBlock::parse(const std::string& text) {
  SolidBlock out;
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (kind == "tet10") {
    out.kind = fem::SolidKind::tet10;
  } else if (kind != "hex8" || colon == std::string::npos) {
    throw std::invalid_argument("a block is written hex8:274,10,10 or tet10:137,5,5");
  }
  std::size_t place = colon;
  for (int& division : out.divisions) {
    if (place == std::string::npos) throw std::invalid_argument("a block has three divisions");
    division = std::stoi(text.substr(place + 1));
    place = text.find(',', place + 1);
  }
  return out;
}

inline fem::FeModel SolidBlock::assembled() const {
  fem::Structure structure;
  fem::Box box;
  box.size = size();
  box.divisions = divisions;
  fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850),
               fem::SolidForm::usual(kind));
  return fem::assemble(structure);
}

/// K̂ of a step of 0.1 ms by average acceleration.
inline linalg::SparseMatrix step_matrix(const fem::FeModel& fe) {
  constexpr double kStep = 1e-4;
  linalg::SparseMatrix out = fe.M.whole() + (0.25 * kStep * kStep) * fe.K.whole();
  out.makeCompressed();
  return out;
}

/// A block that falls from the horizontal on a ball joint at a corner.
/// @param loads forces on as many nodes of a face, three interface variables each
inline std::string block_pendulum(const SolidBlock& block, const std::string& level,
                                  int loads = 0) {
  std::string markers, forces;
  for (int k = 0; k < loads; ++k) {
    // Nodes of the face x = 0 except the one that is held.
    const int across = block.divisions[1] + 1;
    const double y = 0.1 * ((k + 1) % across) / block.divisions[1];
    const double z = 0.1 * ((k + 1) / across) / block.divisions[2];
    markers += fmt::format("      m{}: {{position: [0, {}, {}]}}\n", k, y, z);
    forces += fmt::format("  f{0}: {{force: {{on: block/m{0}, value: [0, 1, 0]}}}}\n", k);
  }
  return fmt::format(R"(buckens: 1
gravity: [0, -9.81, 0]
bodies:
  block:
    mesh:
      box: {{size: [{}, 0.1, 0.1], divisions: [{}, {}, {}], element: {}}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850, damping: {{mass: 0.1, stiffness: 1e-7 s}}}}
    coupling: {}
{}joints:
  pin: {{spherical: {{between: [ground, block/corner_000]}}}}
{})",
                     block.size().x(), block.divisions[0], block.divisions[1], block.divisions[2],
                     block.element(), level, loads > 0 ? "    markers:\n" + markers : "",
                     loads > 0 ? "loads:\n" + forces : "");
}

}  // namespace buckens::bench

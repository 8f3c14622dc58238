// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/mesh_part.h"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "buckens/fem/assembly/element_numbers.h"
#include "buckens/fem/line/bar_block.h"
#include "buckens/fem/line/beam_block.h"
#include "buckens/fem/point/point_mass_block.h"
#include "buckens/fem/point/spring_block.h"
#include "buckens/fem/shell/block.h"
#include "buckens/fem/solid/block.h"

namespace buckens::fem {

namespace {

using KindsOfBlocks =
    std::tuple<BeamBlock, BarBlock, PointMassBlock, SolidBlock, ShellBlock, SpringBlock>;
constexpr auto kEachKind = std::make_index_sequence<std::tuple_size_v<KindsOfBlocks>>();

// What elements of a block have in common, or null; its numbers; and those of an element alone.

const void* common_of(const ElementBlock& /*block*/, int /*e*/) { return nullptr; }
const void* common_of(const BeamBlock& beams, int e) { return &beams.properties(e); }
const void* common_of(const SolidBlock& solids, int e) { return solids.material(e); }
const void* common_of(const ShellBlock& shells, int e) { return &shells.shell_section(e); }

void put_common(const ElementBlock& /*block*/, int /*e*/, base::BytesTo& /*put*/) {}
void put_common(const BeamBlock& beams, int e, base::BytesTo& put) {
  BeamProperties copy = beams.properties(e);
  visit_numbers(copy, put);
}
void put_common(const SolidBlock& solids, int e, base::BytesTo& put) {
  Material copy = *solids.material(e);
  visit_numbers(copy, put);
}
void put_common(const ShellBlock& shells, int e, base::BytesTo& put) {
  ShellSection copy = shells.shell_section(e);
  visit_numbers(copy, put);
}

void take_common(base::BytesFrom& /*take*/, ElementBlock& /*block*/) {}
void take_common(base::BytesFrom& take, BeamBlock& beams) {
  BeamProperties properties;
  visit_numbers(properties, take);
  beams.add_properties(std::move(properties));
}
void take_common(base::BytesFrom& take, SolidBlock& solids) {
  Material material;
  visit_numbers(material, take);
  solids.add_material(material);
}
void take_common(base::BytesFrom& take, ShellBlock& shells) {
  ShellSection section;
  visit_numbers(section, take);
  shells.add_section(section);
}

void put_own(const BeamBlock& beams, int e, base::BytesTo& put) {
  BeamPortion portion = beams.portion(e);
  visit_numbers(portion.up, put);
  const SectionTaper* taper = beams.taper(e);
  put(taper != nullptr);
  if (taper == nullptr) return;
  SectionTaper copy = *taper;
  visit_numbers(copy, put);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int common, BeamBlock& beams) {
  BeamPortion portion;
  visit_numbers(portion.up, take);
  SectionTaper taper;
  const bool is_tapered = take.next<bool>();
  if (is_tapered) visit_numbers(taper, take);
  beams.add(nodes[0], nodes[1], common, portion, is_tapered ? &taper : nullptr);
}

void put_own(const BarBlock& bars, int e, base::BytesTo& put) {
  Material material = *bars.material(e);
  Section section = *bars.section(e);
  visit_numbers(material, put);
  visit_numbers(section, put);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int /*common*/, BarBlock& bars) {
  Material material;
  Section section;
  visit_numbers(material, take);
  visit_numbers(section, take);
  bars.add(nodes[0], nodes[1], material, section);
}

void put_own(const PointMassBlock& masses, int e, base::BytesTo& put) {
  Eigen::Matrix3d inertia = masses.inertia(e);
  put(masses.mass(e));
  visit_numbers(inertia, put);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int /*common*/,
              PointMassBlock& masses) {
  const auto mass = take.next<double>();
  Eigen::Matrix3d inertia;
  visit_numbers(inertia, take);
  masses.add(nodes[0], mass, inertia);
}

void put_own(const SolidBlock& solids, int e, base::BytesTo& put) {
  put(solids.form(e).kind);
  put(solids.form(e).integration);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int common, SolidBlock& solids) {
  SolidForm form;
  take(form.kind);
  take(form.integration);
  solids.add(form, nodes, common);
}

void put_own(const ShellBlock& shells, int e, base::BytesTo& put) {
  // They are not computed anew: those at the border depend on elements that are not here.
  ShellVectors directors = shells.directors({}, e);
  visit_numbers(directors, put);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int common, ShellBlock& shells) {
  ShellVectors directors(3, static_cast<Eigen::Index>(nodes.size()));
  visit_numbers(directors, take);
  shells.add(nodes, common, directors);
}

void put_own(const SpringBlock& springs, int e, base::BytesTo& put) {
  SpringBlock::Stiffness stiffness = springs.stiffness(e);
  visit_numbers(stiffness, put);
}
void take_own(base::BytesFrom& take, std::span<const int> nodes, int /*common*/,
              SpringBlock& springs) {
  SpringBlock::Stiffness stiffness;
  visit_numbers(stiffness, take);
  springs.add(nodes[0], nodes[1], stiffness);
}

template <class Block>
void put_elements(const Block& block, const std::vector<int>& elements,
                  const std::vector<int>& number, base::BytesTo& put) {
  std::map<const void*, int> places;
  std::vector<int> with;  // an element for each place
  for (const int e : elements) {
    if (places.emplace(common_of(block, e), static_cast<int>(with.size())).second) {
      with.push_back(e);
    }
  }
  put(static_cast<int>(with.size()));
  for (const int e : with) put_common(block, e, put);
  put(static_cast<int>(elements.size()));
  for (const int e : elements) {
    const std::span<const int> nodes = block.nodes(e);
    put(places.at(common_of(block, e)));
    put(static_cast<int>(nodes.size()));
    for (const int node : nodes) put(number[static_cast<std::size_t>(node)]);
    put_own(block, e, put);
  }
}

template <class Block>
std::shared_ptr<const ElementBlock> taken_elements(base::BytesFrom& take) {
  auto out = std::make_shared<Block>();
  for (int left = take.next<int>(); left > 0; --left) take_common(take, *out);
  std::vector<int> nodes;
  for (int left = take.next<int>(); left > 0; --left) {
    const int common = take.next<int>();
    nodes.resize(static_cast<std::size_t>(take.next<int>()));
    for (int& node : nodes) take(node);
    take_own(take, nodes, common, *out);
  }
  return out;
}

template <std::size_t... kinds>
void put_block(const ElementBlock& block, const std::vector<int>& elements,
               const std::vector<int>& number, base::BytesTo& put,
               std::index_sequence<kinds...> /*each*/) {
  bool is_known = false;
  const auto put_as = [&](const auto* own, int kind) {
    if (own == nullptr) return;
    is_known = true;
    put(kind);
    put_elements(*own, elements, number, put);
  };
  (put_as(dynamic_cast<const std::tuple_element_t<kinds, KindsOfBlocks>*>(&block),
          static_cast<int>(kinds)),
   ...);
  if (!is_known) throw std::logic_error("elements of a kind that KindsOfBlocks lacks");
}

template <std::size_t... kinds>
std::shared_ptr<const ElementBlock> taken_block(base::BytesFrom& take,
                                                std::index_sequence<kinds...> /*each*/) {
  const int kind = take.next<int>();
  std::shared_ptr<const ElementBlock> out;
  const auto take_as = [&](auto taken, int own) {
    if (kind == own) out = taken(take);
  };
  (take_as(taken_elements<std::tuple_element_t<kinds, KindsOfBlocks>>, static_cast<int>(kinds)),
   ...);
  return out;
}

bool is_any_asked(const DofMap& dofs, std::span<const int> nodes,
                  const std::vector<bool>& is_asked) {
  return std::any_of(nodes.begin(), nodes.end(), [&](int node) {
    const auto& own = dofs.node_dofs[static_cast<std::size_t>(node)];
    return std::any_of(own.begin(), own.end(), [&](int dof) {
      return dof >= 0 && is_asked[static_cast<std::size_t>(dof)];
    });
  });
}

}  // namespace

std::vector<int> put_part(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                          const MeshView& mesh, const std::vector<bool>& is_asked,
                          base::BytesTo& put) {
  std::vector<std::vector<int>> elements;
  for (const auto& block : blocks) {
    auto& own = elements.emplace_back();
    for (int e = 0; e < block->num_elements(); ++e) {
      if (is_any_asked(mesh.dofs, block->nodes(e), is_asked)) own.push_back(e);
    }
  }
  return put_part(blocks, mesh, elements, put);
}

std::vector<int> put_part(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                          const MeshView& mesh, const std::vector<std::vector<int>>& elements,
                          base::BytesTo& put) {
  std::vector<int> number(mesh.nodes.size(), -1);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const int e : elements[b]) {
      for (const int node : blocks[b]->nodes(e)) number[static_cast<std::size_t>(node)] = 0;
    }
  }
  std::vector<int> variables;
  int count = 0;
  for (int& place : number) place = place < 0 ? -1 : count++;
  put(mesh.dofs.num_dofs);
  put(count);
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    for (const double coordinate : mesh.nodes[node].position) put(coordinate);
    for (const int dof : mesh.dofs.node_dofs[node]) {
      put(dof);
      if (dof >= 0) variables.push_back(dof);
    }
  }
  put(static_cast<int>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    put_block(*blocks[b], elements[b], number, put, kEachKind);
  }
  return variables;
}

MeshPart taken_part(base::BytesFrom& take) {
  MeshPart out;
  take(out.size);
  for (int left = take.next<int>(); left > 0; --left) {
    Node& node = out.nodes.emplace_back();
    for (double& coordinate : node.position) take(coordinate);
    for (int& dof : out.dofs.node_dofs.emplace_back()) {
      take(dof);
      if (dof < 0) continue;
      out.variables.push_back(dof);
      dof = out.dofs.num_dofs++;
    }
  }
  for (int left = take.next<int>(); left > 0; --left) {
    out.blocks.push_back(taken_block(take, kEachKind));
  }
  return out;
}

}  // namespace buckens::fem

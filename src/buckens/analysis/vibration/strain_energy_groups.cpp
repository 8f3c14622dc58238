// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/strain_energy_groups.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "buckens/fem/line/bar_block.h"
#include "buckens/fem/line/beam_block.h"

namespace buckens::analysis {

namespace {

/// More members than this of a kind are taken together.
constexpr std::size_t kMostMembers = 50;

using Parts = std::vector<std::pair<std::string, std::unique_ptr<fem::ElementBlock>>>;

/// Members are counted from 1, as sensors and loads count them.
std::string member(const char* kind, std::size_t index, std::size_t count) {
  return count == 1 ? fmt::format("{}s", kind) : fmt::format("{} {}", kind, index + 1);
}

/// One block for each beam of the model file: its elements share their properties.
Parts split_beams(const fem::BeamBlock& block) {
  std::map<const fem::BeamProperties*, std::vector<int>> members;
  for (int e = 0; e < block.num_elements(); ++e) members[&block.properties(e)].push_back(e);
  Parts parts;
  for (const auto& [properties, elements] : members) {
    auto part = std::make_unique<fem::BeamBlock>();
    const int own = part->add_properties(*properties);
    for (const int e : elements) {
      part->add(block.ends(e)[0], block.ends(e)[1], own, block.portion(e));
    }
    parts.emplace_back(member("beam", parts.size(), members.size()), std::move(part));
  }
  return parts;
}

Parts split_bars(const fem::BarBlock& block) {
  Parts parts;
  const auto count = static_cast<std::size_t>(block.num_elements());
  for (std::size_t e = 0; e < count; ++e) {
    const int element = static_cast<int>(e);
    auto part = std::make_unique<fem::BarBlock>();
    const std::array<int, 2> ends = block.ends(element);
    part->add(ends[0], ends[1], *block.material(element), *block.section(element));
    parts.emplace_back(member("bar", e, count), std::move(part));
  }
  return parts;
}

const char* kind_name(const fem::ElementBlock& block) {
  if (block.is_solid()) return "solids";
  if (block.is_shell()) return "shells";
  if (!block.is_line()) return "springs";
  return block.has_rotations() ? "beams" : "bars";
}

bool is_solid_or_empty(const std::shared_ptr<const fem::ElementBlock>& block) {
  return block->is_solid() || block->num_elements() == 0;
}

}  // namespace

StrainEnergyGroups::StrainEnergyGroups(const fem::FeModel& fe) {
  const fem::MeshView mesh{fe.nodes, fe.dofs};
  // All the energy is in a group on its own: large meshes of one kind need no second stiffness.
  if (std::all_of(fe.blocks.begin(), fe.blocks.end(), is_solid_or_empty) && fe.K.nonZeros() > 0) {
    names_.emplace_back("solids");
    return;
  }
  const auto add = [&](std::string name, const fem::ElementBlock& block) {
    fem::StiffnessSum sum;
    block.add_stiffness(mesh, sum);
    if (sum.K.empty()) return;
    names_.push_back(std::move(name));
    linalg::SparseMatrix K(fe.dofs.num_dofs, fe.dofs.num_dofs);
    K.setFromTriplets(sum.K.begin(), sum.K.end());
    stiffness_.push_back(std::move(K));
  };
  for (const auto& block : fe.blocks) {
    Parts parts;
    if (const auto* beams = dynamic_cast<const fem::BeamBlock*>(block.get())) {
      parts = split_beams(*beams);
    } else if (const auto* bars = dynamic_cast<const fem::BarBlock*>(block.get())) {
      parts = split_bars(*bars);
    }
    if (parts.empty() || parts.size() > kMostMembers) {
      add(kind_name(*block), *block);
    } else {
      for (const auto& [name, part] : parts) add(name, *part);
    }
  }
}

std::vector<double> StrainEnergyGroups::shares(const linalg::Vector& d) const {
  if (stiffness_.empty()) return std::vector<double>(names_.size(), 1.0);
  std::vector<double> out;
  double sum = 0.0;
  for (const linalg::SparseMatrix& K : stiffness_) {
    out.push_back(0.5 * d.dot(K * d));
    sum += out.back();
  }
  for (double& energy : out) energy = sum > 0.0 ? energy / sum : 0.0;
  return out;
}

}  // namespace buckens::analysis

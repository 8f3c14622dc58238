// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/fem/mesh/group_section_spec.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

Found thickness_problem(const fem::ShellPropertySpec& spec) {
  if (spec.thickness.has_value() == spec.layers.empty()) {
    if (spec.direction && spec.direction->norm() == 0.0) {
      return Finding{"direction", "a direction cannot be zero"};
    }
    return std::nullopt;
  }
  return Finding{"", "exactly one of the keys thickness and layers is needed"};
}

}  // namespace

Found problem(const fem::ShellMemberSpec& spec, const ModelDescription&) {
  if (spec.nodes.size() != 3 && spec.nodes.size() != 4) {
    return Finding{"nodes", fmt::format("a shell has 3 or 4 nodes, found {}", spec.nodes.size())};
  }
  return thickness_problem(spec);
}

Found problem(const fem::PlateMeshSpec& spec, const ModelDescription&) {
  return thickness_problem(spec);
}

Found problem(const fem::GroupSectionSpec& spec, const ModelDescription&) {
  const int given = (spec.thickness ? 1 : 0) + (spec.layers.empty() ? 0 : 1) + (spec.beam ? 1 : 0) +
                    (spec.bar ? 1 : 0);
  if (given != 1) {
    return Finding{"", "exactly one of the keys thickness, layers, beam and bar is needed"};
  }
  const auto foreign = [](const char* key, const char* owner) {
    return Finding{key, fmt::format("this belongs to {}; remove the key", owner)};
  };
  if (!spec.is_shell()) {
    if (spec.offset != 0.0) return foreign("offset", "shells");
    if (spec.direction) return foreign("direction", "shells");
    if (spec.along_first_side) return foreign("along-first-side", "shells");
  }
  if (!spec.beam) {
    if (spec.up) return foreign("up", "beams");
    if (spec.theory) return foreign("theory", "beams");
    if (spec.rotary_inertia) return foreign("rotary-inertia", "beams");
  }
  if (spec.direction && spec.along_first_side) {
    return Finding{"along-first-side", "`direction` already determines the x axis"};
  }
  if (spec.direction && spec.direction->norm() == 0.0) {
    return Finding{"direction", "a direction cannot be zero"};
  }
  if (spec.up && spec.up->norm() == 0.0) return Finding{"up", "a direction cannot be zero"};
  return std::nullopt;
}

Found problem(const fem::AverageLinkSpec& spec, const ModelDescription&) {
  if (spec.nodes.empty()) return Finding{"nodes", "name at least one node"};
  if (spec.weights.empty() || spec.weights.size() == spec.nodes.size()) return std::nullopt;
  return Finding{"weights", fmt::format("found {} weights for {} nodes", spec.weights.size(),
                                        spec.nodes.size())};
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/fem/shell_spec.h"
#include "buckens/io/model_file_checks.h"

namespace buckens::io {

namespace {

Finding thickness_problem(const fem::ShellPropertySpec& spec) {
  if (spec.thickness.has_value() == spec.layers.empty()) {
    if (spec.direction && spec.direction->norm() == 0.0) {
      return Problem{"direction", "a direction cannot be zero"};
    }
    return std::nullopt;
  }
  return Problem{"", "exactly one of the keys thickness and layers is needed"};
}

}  // namespace

Finding problem(const fem::ShellMemberSpec& spec, const ReadContext&) {
  if (spec.nodes.size() != 3 && spec.nodes.size() != 4) {
    return Problem{"nodes",
                   fmt::format("{} nodes stand here; a shell has 3 or 4", spec.nodes.size())};
  }
  return thickness_problem(spec);
}

Finding problem(const fem::PlateMeshSpec& spec, const ReadContext&) {
  return thickness_problem(spec);
}

Finding problem(const fem::AverageLinkSpec& spec, const ReadContext&) {
  if (spec.nodes.empty()) return Problem{"nodes", "name at least one node"};
  if (spec.weights.empty() || spec.weights.size() == spec.nodes.size()) return std::nullopt;
  return Problem{"weights", fmt::format("{} weights stand here for {} nodes", spec.weights.size(),
                                        spec.nodes.size())};
}

}  // namespace buckens::io

// SPDX-License-Identifier: Apache-2.0
// What is wrong with cables and their sensors.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/loads/cable.h"
#include "buckens/model/check/joint_findings.h"

namespace buckens::model {

Found own_joint_problem(const loads::CableSpec& spec, const ModelDescription&) {
  const std::size_t least = spec.ends ? 1 : 2;
  if (spec.pulleys.size() < least) {
    return Finding{"pulleys", spec.ends ? "a cable needs a pulley; without one use a `rope` or a "
                                          "`spring-damper`"
                                        : "a closed cable needs two pulleys; add one, or give "
                                          "`ends`"};
  }
  const std::size_t nodes = spec.pulleys.size() + (spec.ends ? 2 : 0);
  if (nodes > loads::Cable::kMostNodes) {
    return Finding{
        "pulleys",
        fmt::format("a cable can have at most {} pulleys and ends, found {}; split it at a marker",
                    loads::Cable::kMostNodes, nodes)};
  }
  if (spec.axis && !(spec.axis->norm() > 0.0)) {
    return Finding{"axis", "an axis cannot be [0, 0, 0]; give its direction"};
  }
  if (!spec.ends && spec.coefficient && spec.pretension == 0.0) {
    return Finding{"pretension",
                   "a closed cable with `friction` transmits no force without pretension; give it "
                   "a pretension, or remove `friction` for a toothed belt"};
  }
  return std::nullopt;
}

Found own_joint_problem(const CableSensor& spec, const ModelDescription& model) {
  std::vector<std::string> known;
  for (const loads::LoadSpec& load : model.loads) {
    if (std::holds_alternative<loads::CableSpec>(load.kind)) known.push_back(load.name);
  }
  if (std::find(known.begin(), known.end(), spec.cable) != known.end()) return std::nullopt;
  return Finding{"cable", fmt::format("there is no cable \"{}\".{}", spec.cable,
                                      known.empty() ? " The model has none."
                                                    : base::suggestion(spec.cable, known))};
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/eliminate_links.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/rigid_regions.h"

namespace buckens::model {

void eliminate_links(const NamedStructure& mesh, bool is_divided, body::Body& body) {
  std::vector<body::RigidRegion> regions;
  for (const InterfaceRegion& interface : mesh.interfaces) {
    if (!interface.is_rigid) continue;
    regions.push_back({interface.name, interface.region.nodes, interface.region.centre});
  }
  const fem::NodeLinks& links = mesh.structure.links;
  if (regions.empty() && links.empty()) return;
  const std::string what = regions.empty()
                               ? "links inside its mesh"
                               : fmt::format("rigid interface \"{}\"", regions.front().name);
  if (is_divided) {
    throw ModelError(fmt::format(
        "{}: a body with several frames can have `average` interfaces only and no links; change "
        "the interface's kind or remove `frames`",
        what));
  }
  if (body.flexible->geometric) {
    throw ModelError(fmt::format(
        "geometric stiffness and {} exclude each other; make an interface `average`, or give the "
        "body more `frames`",
        what));
  }
  body.flexible = body::with_links(body.name, *body.flexible, regions, links);
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/eliminate_links.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/rigid_regions.h"

namespace buckens::model {

namespace {

std::vector<body::RigidRegion> rigid_regions(const std::vector<InterfaceRegion>& interfaces) {
  std::vector<body::RigidRegion> out;
  for (const InterfaceRegion& interface : interfaces) {
    if (!interface.is_rigid) continue;
    out.push_back({interface.name, interface.region.nodes, interface.region.centre});
  }
  return out;
}

}  // namespace

void eliminate_links(const NamedStructure& mesh, body::Body& body,
                     std::vector<std::string>& notes) {
  const std::vector<body::RigidRegion> regions = rigid_regions(mesh.interfaces);
  const fem::NodeLinks& links = mesh.structure.links;
  if (regions.empty() && links.empty()) return;
  const std::string what = regions.empty()
                               ? "links inside its mesh"
                               : fmt::format("rigid interface \"{}\"", regions.front().name);
  if (body.flexible->geometric) {
    throw ModelError(
        fmt::format("geometric stiffness and {} cannot be combined; make an interface `average`, "
                    "or give the body more `frames`",
                    what));
  }
  body::LinkedPart linked = body::with_links(body.name, *body.flexible, regions, links);
  body.flexible = std::move(linked.part);
  if (!linked.note.empty()) {
    notes.push_back(fmt::format("body \"{}\": {}", body.name, linked.note));
  }
}

std::unique_ptr<body::FlexiblePart> undivided_part(const WholeBody& whole,
                                                   const body::CouplingChoice& coupling) {
  auto out = std::make_unique<body::FlexiblePart>(whole.name, *whole.mesh, coupling);
  const std::vector<body::RigidRegion> regions = rigid_regions(whole.interfaces);
  if (regions.empty()) return out;
  return body::with_links(whole.name, *out, regions).part;
}

}  // namespace buckens::model

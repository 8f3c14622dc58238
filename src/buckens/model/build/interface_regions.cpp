// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/interface_regions.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

// Share of the size of the mesh within which a node counts as in a selection, and a frame as at the
// centre.
constexpr double kTolerance = 1e-6;

double size_of(const fem::Structure& structure) {
  Eigen::AlignedBox3d box;
  for (const fem::Node& node : structure.nodes) box.extend(node.position);
  return box.diagonal().norm();
}

/// Finds one region in the way its alternative says.
class RegionFinder {
 public:
  RegionFinder(const body::BodySpec& body, const body::InterfaceSpec& spec,
               const NamedStructure& mesh)
      : body_(body), spec_(spec), mesh_(mesh) {}

  fem::NodeRegion operator()(const fem::NamedFaceSpec& face) const {
    const fem::Structure& structure = mesh_.structure;
    if (const fem::FaceSet* found = fem::find_face_set(structure, face.name)) {
      return fem::face_region(structure, *found);
    }
    std::vector<std::string> known;
    for (const fem::FaceSet& set : structure.face_sets) known.push_back(set.name);
    fail(face.where, known.empty()
                         ? "the mesh has no named faces; select its nodes by `set`, `sphere`, "
                           "`box`, `cylinder` or `plane`"
                         : fmt::format("the mesh has no face \"{}\".{}", face.name,
                                       base::suggestion(face.name, known)));
  }

  fem::NodeRegion operator()(const fem::NodeSetSpec& set) const {
    std::vector<int> nodes;
    for (const std::string& name : set.nodes) add_named(name, set.where, nodes);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty()) fail(set.where, "the set is empty; name at least one node");
    return fem::node_region(mesh_.structure, std::move(nodes));
  }

  template <class Selection>
  fem::NodeRegion operator()(const Selection& selection) const {
    const double tolerance = selection.tolerance.value_or(kTolerance * size_of(mesh_.structure));
    std::vector<int> nodes;
    double least = HUGE_VAL;
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < mesh_.structure.nodes.size(); ++k) {
      const double distance = fem::distance(selection, mesh_.structure.nodes[k].position);
      if (distance <= tolerance) nodes.push_back(static_cast<int>(k));
      if (distance < least) nearest = k;
      least = std::min(least, distance);
    }
    if (!nodes.empty()) return fem::node_region(mesh_.structure, std::move(nodes));
    const Vector3d& at = mesh_.structure.nodes[nearest].position;
    fail(
        selection.where,
        fmt::format("no node lies in the {}; the nearest one, at ({:g}, {:g}, {:g}) m, is {:.3g} m "
                    "away from it and the tolerance is {:.3g} m. Move or enlarge it, or give a "
                    "larger `tolerance`",
                    Selection::kKey, at.x(), at.y(), at.z(), least, tolerance));
  }

 private:
  void add_named(const std::string& name, const SourceLocation& where,
                 std::vector<int>& nodes) const {
    const fem::Structure& structure = mesh_.structure;
    if (const auto place = mesh_.find(name); place && place->node >= 0) {
      nodes.push_back(place->node);
      return;
    }
    if (const auto* set = base::find_named(structure.node_sets, name)) {
      nodes.insert(nodes.end(), set->nodes.begin(), set->nodes.end());
      return;
    }
    if (const auto* set = base::find_named(structure.face_sets, name)) {
      const auto more = fem::face_set_nodes(structure, *set);
      nodes.insert(nodes.end(), more.begin(), more.end());
      return;
    }
    std::vector<std::string> known = mesh_.names;
    for (const fem::NodeSet& set : structure.node_sets) known.push_back(set.name);
    for (const fem::FaceSet& set : structure.face_sets) known.push_back(set.name);
    fail(where,
         fmt::format("the mesh has no node or set \"{}\".{}", name, base::suggestion(name, known)));
  }

  [[noreturn]] void fail(const SourceLocation& where, const std::string& what) const {
    throw InputError(
        where, fmt::format("interface \"{}\" of body \"{}\": {}", spec_.name, body_.name, what));
  }

  const body::BodySpec& body_;
  const body::InterfaceSpec& spec_;
  const NamedStructure& mesh_;
};

InterfaceRegion find_interface(const body::BodySpec& body, const body::InterfaceSpec& spec,
                               const NamedStructure& mesh) {
  InterfaceRegion out;
  out.name = spec.name;
  out.is_rigid = spec.kind == body::InterfaceKind::rigid;
  out.region = std::visit(RegionFinder(body, spec, mesh), spec.region);
  out.at = spec.at.value_or(out.region.centre);
  out.orientation = spec.rotation();
  if (out.region.turns()) return out;
  const auto refuse = [&](const std::string& what) {
    throw InputError(
        spec.where, fmt::format("interface \"{}\" of body \"{}\": {}", spec.name, body.name, what));
  };
  if (out.is_rigid) {
    refuse(why_no_moment(out) +
           ", or make the interface `average`, since there is nothing to hold rigid");
  }
  if ((out.at - out.region.centre).norm() > kTolerance * size_of(mesh.structure)) {
    refuse(why_no_moment(out) + ", and a force at `at`, off their centre, needs one");
  }
  return out;
}

}  // namespace

std::string why_no_moment(const InterfaceRegion& interface) {
  const std::size_t count = interface.region.nodes.size();
  const std::string reason =
      count < 3
          ? fmt::format("it has {} node{}, but three are needed to carry a moment", count,
                        count == 1 ? "" : "s")
          : fmt::format("its {} nodes lie on one line and cannot carry a moment about it", count);
  return reason + "; use nodes that span a surface";
}

std::vector<InterfaceRegion> find_interfaces(const body::BodySpec& spec,
                                             const NamedStructure& mesh) {
  std::vector<InterfaceRegion> out;
  for (const body::InterfaceSpec& interface : spec.interfaces) {
    const bool has_surface =
        mesh.structure.solids.num_elements() + mesh.structure.shells.num_elements() > 0;
    if (!has_surface && !mesh.matrices) {
      throw InputError(interface.where,
                       fmt::format("interface \"{}\" of body \"{}\": interfaces belong to meshes "
                                   "of solids and shells; beams and bars have markers at nodes",
                                   interface.name, spec.name));
    }
    out.push_back(find_interface(spec, interface, mesh));
  }
  return out;
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/load_place.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

namespace {

/// Number of a beam in the model file, counted from 1; 0 where the text is none.
int beam_number(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? number : 0;
}

}  // namespace

namespace {

/// The remedy if a mesh has nothing of a kind that could be named.
std::string remedy_without(const std::string& kind) {
  if (kind == "face") return "select nodes of its surface by an entry under `interfaces`";
  return "define sets in the program that made the mesh, or load the whole body";
}

}  // namespace

void LoadPlaceFinder::fail(const std::string& what) const {
  throw InputError(on_.where, fmt::format("load \"{}\" on \"{}\": {}", load_, on_.text, what));
}

void LoadPlaceFinder::fail_unknown(const char* kind, const std::vector<std::string>& known) const {
  fail(fmt::format("body \"{}\" has no {} \"{}\".{}", body_.name, kind, on_.part(),
                   known.empty()
                       ? fmt::format(" It has no {}s at all; {}", kind, remedy_without(kind))
                       : base::suggestion(on_.part(), known)));
}

LoadedFaces LoadPlaceFinder::faces() const {
  const fem::Structure& structure = mesh_.structure;
  if (structure.solids.num_elements() + structure.shells.num_elements() == 0) {
    fail("its mesh has no faces; use a `line-load` on beams, or a `force` on a marker at a point");
  }
  std::vector<std::string> known;
  for (const fem::FaceSet& set : structure.face_sets) known.push_back(set.name);
  for (const InterfaceRegion& interface : mesh_.interfaces) known.push_back(interface.name);
  const std::string part = on_.part();
  if (part.empty()) {
    fail(fmt::format("a face is needed, for example \"{}/{}\"", on_.body(),
                     known.empty() ? "top" : known.front()));
  }
  const body::InterfaceSpec* interface = base::find_named(body_.interfaces, part);
  if (interface == nullptr) {
    if (const fem::FaceSet* set = fem::find_face_set(structure, part))
      return {set->faces, set->shells};
    fail_unknown("face", known);
  }
  if (const auto* face = std::get_if<fem::NamedFaceSpec>(&interface->region)) {
    const fem::FaceSet* set = fem::find_face_set(structure, face->name);
    return {set->faces, set->shells};
  }
  const std::vector<int>& nodes = mesh_.find_interface(part)->region.nodes;
  LoadedFaces found{fem::faces_within(structure, nodes), {}};
  for (int e = 0; e < structure.shells.num_elements(); ++e) {
    const auto own = structure.shells.nodes(e);
    const bool is_within = std::all_of(own.begin(), own.end(), [&](int node) {
      return std::binary_search(nodes.begin(), nodes.end(), node);
    });
    if (is_within) found.shells.push_back({e, false});
  }
  if (found.solids.empty() && found.shells.empty()) {
    fail(
        fmt::format("no face on the surface of the mesh has all its nodes in the interface; "
                    "select more nodes{}",
                    structure.face_sets.empty() ? "" : " or take a named face"));
  }
  return found;
}

LoadedElements LoadPlaceFinder::elements() const {
  const fem::Structure& structure = mesh_.structure;
  const int beams = structure.beams.num_elements();
  LoadedElements out;
  const std::string part = on_.part();
  if (part.empty()) {
    for (int e = 0; e < beams + structure.bars.num_elements(); ++e) out.lines.push_back(e);
    for (int e = 0; e < structure.solids.num_elements(); ++e) out.solids.push_back(e);
    for (int e = 0; e < structure.shells.num_elements(); ++e) out.shells.push_back(e);
    return out;
  }
  std::vector<std::string> known;
  for (const fem::ElementSet& set : structure.element_sets) {
    known.push_back(set.name);
    if (set.name != part) continue;
    out.lines = set.beams;
    for (const int bar : set.bars) out.lines.push_back(beams + bar);
    out.solids = set.solids;
    out.shells = set.shells;
    return out;
  }
  const int number = beam_number(part);
  if (number >= 1 && number <= static_cast<int>(mesh_.beams.size())) {
    const fem::BeamDivision& beam = mesh_.beams[static_cast<std::size_t>(number - 1)];
    for (int k = 0; k < beam.num_elements; ++k) out.lines.push_back(beam.first_element + k);
    return out;
  }
  if (!mesh_.beams.empty()) {
    fail(fmt::format(
        "body \"{}\" has no element set and no beam \"{}\".{} Its beams are numbered "
        "from 1 to {}",
        body_.name, part, known.empty() ? "" : base::suggestion(part, known), mesh_.beams.size()));
  }
  fail_unknown("element set", known);
}

LoadedElements LoadPlaceFinder::lines() const {
  LoadedElements out = elements();
  out.solids.clear();
  out.shells.clear();
  if (out.lines.empty()) {
    fail(
        "there are no beams or bars there; on solids use a `pressure`, `traction` or `body-force`");
  }
  return out;
}

}  // namespace buckens::model

// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>

#include "buckens/base/nearest.h"

namespace buckens::mesh_io {

namespace {

// Relative to the size of a face. Boxes are widened by the tolerance of the kernel, 1e-7 m, which
// is 1e-4 of a face of a millimetre; areas and centres are integrals of smooth functions.
constexpr double kBoxMargin = 1e-4;
constexpr double kSame = 1e-5;

struct Face {
  int number;
  GmshLibrary::Color color;
  std::array<double, 6> box;
  double area;
  std::array<double, 3> centre;

  double width() const { return std::hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]); }
  bool lies_in(const Face& other) const {
    const double margin = kBoxMargin * other.width();
    for (std::size_t k = 0; k < 3; ++k) {
      if (box[k] < other.box[k] - margin || box[k + 3] > other.box[k + 3] + margin) return false;
    }
    return true;
  }
};

bool same_color(const GmshLibrary::Color& a, const GmshLibrary::Color& b) {
  return a.alpha > 0 && b.alpha > 0 && a.red == b.red && a.green == b.green && a.blue == b.blue;
}

std::vector<Face> faces_of(const GmshLibrary& gmsh) {
  std::vector<Face> out;
  for (const GmshEntity& face : gmsh.entities(2)) {
    out.push_back(
        {face.second, gmsh.color(face), gmsh.box(face), gmsh.size(face), gmsh.centre(face)});
  }
  return out;
}

bool are_one(const Face& a, const Face& b) {
  if (!a.lies_in(b) || !b.lies_in(a) || std::abs(a.area - b.area) > kSame * b.area) return false;
  const double apart =
      std::hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1], a.centre[2] - b.centre[2]);
  return apart <= kSame * b.width();
}

/// The faces that are together what `whole` was; none if they cannot be found.
std::vector<const Face*> pieces_of(const Face& whole, const std::vector<Face>& faces) {
  std::vector<const Face*> out;
  // The box of an uncut face, bent around others, holds these, too.
  for (const Face& face : faces) {
    if (are_one(face, whole)) return {&face};
  }
  double area = 0;
  std::array<double, 3> moment{};
  for (const Face& face : faces) {
    if (!face.lies_in(whole)) continue;
    out.push_back(&face);
    area += face.area;
    for (std::size_t k = 0; k < 3; ++k) moment[k] += face.area * face.centre[k];
  }
  bool is_whole = std::abs(area - whole.area) <= kSame * whole.area;
  for (std::size_t k = 0; k < 3; ++k) {
    is_whole = is_whole && std::abs(moment[k] - whole.area * whole.centre[k]) <=
                               kSame * whole.area * whole.width();
  }
  return is_whole ? out : std::vector<const Face*>();
}

void add_color(GluedShapes& out, int face, const GmshLibrary::Color& color) {
  const bool is_known =
      std::any_of(out.colors.begin(), out.colors.end(), [&](const ColoredShape& known) {
        return known.face == face && same_color(known.color, color);
      });
  if (color.alpha > 0 && !is_known) out.colors.push_back({face, color});
}

/// The colours of faces on the pieces that they were cut into.
void color_pieces(GluedShapes& out, const std::vector<Face>& before,
                  const std::vector<Face>& after) {
  for (const Face& face : before) {
    if (face.color.alpha == 0) continue;
    const auto pieces = pieces_of(face, after);
    if (pieces.empty()) ++out.lost;
    for (const Face* piece : pieces) add_color(out, piece->number, face.color);
  }
}

/// @param pieces what each solid became
std::vector<std::pair<std::size_t, std::size_t>> common_pieces(
    const std::vector<std::vector<GmshEntity>>& pieces) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  std::map<GmshEntity, std::size_t> owner;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (const GmshEntity& piece : pieces[k]) {
      const auto [known, is_new] = owner.emplace(piece, k);
      if (!is_new) out.emplace_back(known->second, k);
    }
  }
  return out;
}

/// Takes away all solids but one. @return what is wrong; empty: nothing
std::string keep_only(GmshLibrary& gmsh, const std::string& wanted) {
  const auto solids = gmsh.entities(3);
  std::vector<std::string> names;
  std::vector<GmshEntity> others;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    names.push_back(label_of_solid(gmsh, solids[k]));
    if (names.back() != wanted && std::to_string(k + 1) != wanted) others.push_back(solids[k]);
  }
  if (others.size() == solids.size()) {
    return fmt::format("the file has no solid \"{}\", but {}, counted from 1.{}", wanted,
                       solids.size(), base::suggestion(wanted, names));
  }
  if (!others.empty()) gmsh.remove(others);
  return {};
}

}  // namespace

std::string label_of_solid(const GmshLibrary& gmsh, const GmshEntity& solid) {
  const std::string path = gmsh.name(solid);
  std::string out = path.substr(path.rfind('/') + 1);
  return out.empty() ? fmt::format("volume_{}", solid.second) : out;
}

std::string load_part(GmshLibrary& gmsh, const char* model, const std::string& file,
                      const SolidChoice& choice) {
  gmsh.new_model(model);
  gmsh.import_shapes(file);
  if (!choice.only.empty()) return keep_only(gmsh, choice.only);
  const auto solids = gmsh.entities(3);
  std::vector<GmshEntity> others;
  for (const std::size_t place : choice.without) others.push_back(solids.at(place));
  if (!others.empty()) gmsh.remove(others);
  return {};
}

GluedShapes glue_solids(GmshLibrary& gmsh) {
  GluedShapes out;
  const auto solids = gmsh.entities(3);
  out.num_faces = gmsh.entities(2).size();
  if (solids.size() < 2) {
    for (const GmshEntity& face : gmsh.entities(2)) add_color(out, face.second, gmsh.color(face));
    return out;
  }
  const std::vector<Face> before = faces_of(gmsh);
  for (const GmshEntity& solid : solids) {
    out.labels.push_back(label_of_solid(gmsh, solid));
    out.volumes.push_back(std::abs(gmsh.size(solid)));
  }
  out.overlaps = common_pieces(gmsh.fragment(solids));
  const std::vector<Face> after = faces_of(gmsh);
  for (const Face& face : after) add_color(out, face.number, face.color);
  color_pieces(out, before, after);
  return out;
}

GluedShapes colors_of_copy(GmshLibrary& gmsh, const char* part, const GluedShapes& glued,
                           const std::string& copy, const SolidChoice& choice) {
  GluedShapes out;
  const std::vector<Face> after = faces_of(gmsh);
  const bool is_cut = gmsh.entities(3).size() > 1;
  load_part(gmsh, "copy", copy, choice);
  out.num_faces = gmsh.entities(2).size();
  if (out.num_faces == glued.num_faces && !is_cut) {
    for (const GmshEntity& face : gmsh.entities(2)) add_color(out, face.second, gmsh.color(face));
  } else if (out.num_faces == glued.num_faces) {
    color_pieces(out, faces_of(gmsh), after);
  }
  gmsh.use_model(part);
  return out;
}

std::vector<std::size_t> smaller_of_overlapping(const GluedShapes& glued) {
  std::set<std::size_t> out;
  for (const auto& [first, second] : glued.overlaps) {
    out.insert(glued.volumes.at(first) < glued.volumes.at(second) ? first : second);
  }
  return {out.begin(), out.end()};
}

std::vector<SharedEdge> edges_without_faces(const GmshLibrary& gmsh) {
  const auto solids = gmsh.entities(3);
  std::vector<SharedEdge> out;
  if (solids.size() < 2) return out;
  // Solids that share faces get the number of one of them.
  std::vector<std::size_t> group(solids.size());
  std::map<int, std::size_t> of_face;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    group[k] = k;
    for (const GmshEntity& face : gmsh.boundary({solids[k]})) {
      const auto [known, is_new] = of_face.emplace(std::abs(face.second), k);
      if (is_new) continue;
      const std::size_t joined = group[known->second], own = group[k];
      std::replace(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(k) + 1, own, joined);
    }
  }
  std::map<int, std::size_t> of_curve;
  for (const auto& [face, solid] : of_face) {
    for (const GmshEntity& curve : gmsh.boundary({{2, face}})) {
      const int number = std::abs(curve.second);
      const auto [known, is_new] = of_curve.emplace(number, solid);
      if (is_new || group[known->second] == group[solid]) continue;
      out.push_back({number, label_of_solid(gmsh, solids[known->second]),
                     label_of_solid(gmsh, solids[solid])});
    }
  }
  return out;
}

SurfaceFaults surface_faults(const GmshLibrary& gmsh) {
  const auto faces = gmsh.entities(2);
  std::vector<std::vector<GmshEntity>> curves;
  std::map<GmshEntity, int> num_faces;
  for (const GmshEntity& face : faces) {
    curves.push_back(gmsh.boundary({face}));  // without seams
    for (GmshEntity& curve : curves.back()) {
      curve.second = std::abs(curve.second);
      ++num_faces[curve];
    }
  }
  SurfaceFaults out;
  for (const auto& [curve, count] : num_faces) {
    if (count == 1) out.free.push_back(curve);
    if (count > 2) out.crowded.push_back(curve);
  }
  std::map<GmshEntity, int> without_walls;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool is_wall = std::all_of(curves[k].begin(), curves[k].end(),
                                     [&](const auto& curve) { return num_faces.at(curve) != 2; });
    if (is_wall && !curves[k].empty()) {
      out.walls.push_back(faces[k]);
    } else {
      for (const GmshEntity& curve : curves[k]) ++without_walls[curve];
    }
  }
  const bool is_closed =
      !without_walls.empty() && std::all_of(without_walls.begin(), without_walls.end(),
                                            [](const auto& entry) { return entry.second == 2; });
  if (!is_closed) out.walls.clear();
  return out;
}

std::vector<FaceExtent> face_extents(const GmshLibrary& gmsh) {
  std::map<int, double> lengths;
  for (const GmshEntity& curve : gmsh.entities(1)) lengths[curve.second] = gmsh.size(curve);
  std::vector<FaceExtent> out;
  for (const GmshEntity& face : gmsh.entities(2)) {
    FaceExtent extent{std::abs(gmsh.size(face)), gmsh.largest_curvature(face.second), {}};
    for (const GmshEntity& curve : gmsh.boundary({face})) {
      extent.edges.push_back(lengths[std::abs(curve.second)]);
    }
    out.push_back(std::move(extent));
  }
  return out;
}

}  // namespace buckens::mesh_io

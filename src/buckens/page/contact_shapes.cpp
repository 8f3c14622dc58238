// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/contact_shapes.h"

#include <utility>
#include <vector>

#include "buckens/files/base64.h"
#include "buckens/files/vector_json.h"

namespace buckens::page {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json side_json(const results::GeometrySide& side) {
  return {
      {"body", side.body}, {"marker", side.marker}, {"position", files::json_of(side.position)}};
}

Json shapes_json(const results::Geometry& geometry) {
  Json all = Json::array();
  for (const results::GeometryShape& shape : geometry.shapes) {
    Json one = {{"name", shape.name},
                {"kind", shape.kind},
                {"on", side_json(shape.on)},
                {"orientation", {shape.q.w(), shape.q.x(), shape.q.y(), shape.q.z()}},
                {"axis", files::json_of(shape.axis)},
                {"radius", shape.radius},
                {"length", shape.length},
                {"size", files::json_of(shape.size)}};
    if (!shape.points.empty()) {
      std::vector<double> points;
      for (const Eigen::Vector3d& p : shape.points) {
        points.insert(points.end(), {p.x(), p.y(), p.z()});
      }
      std::vector<int> corners;
      for (const auto& t : shape.triangles) corners.insert(corners.end(), t.begin(), t.end());
      one["points"] = files::base64_float32(points);
      one["triangles"] = files::base64_int32(corners);
    }
    all.push_back(std::move(one));
  }
  return all;
}

Json cables_json(const results::Geometry& geometry) {
  Json all = Json::array();
  for (const results::GeometryCable& cable : geometry.cables) {
    Json sides = Json::array();
    for (const results::GeometrySide& side : cable.sides) sides.push_back(side_json(side));
    all.push_back({{"name", cable.name},
                   {"kind", cable.kind},
                   {"closed", cable.is_closed},
                   {"firstPulley", cable.first_pulley},
                   {"axis", files::json_of(cable.axis)},
                   {"sides", std::move(sides)},
                   {"radii", cable.radii}});
  }
  return all;
}

}  // namespace buckens::page

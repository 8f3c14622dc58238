// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <nlohmann/json.hpp>

#include "buckens/page/frames.h"
#include "buckens/results/geometry.h"

namespace buckens::page {

/// The visible part of a body: the nodes of its lines and of its surface, and the solid elements
/// below the surface. Nothing else of a body with solids is in the page.
struct VisibleParts {
  explicit VisibleParts(const results::GeometryBody& body);

  std::vector<std::size_t> nodes;   ///< of the body that are in the page, increasing
  std::vector<int> number;          ///< in the page for each node of the body, −1 if not there
  std::vector<std::size_t> solids;  ///< solid elements below the surface, increasing
  std::vector<std::size_t> places;  ///< of fields at nodes on the surface, increasing
};

/// A body in the page (PageBody in viewer/src/page_data.ts).
class PageBody {
 public:
  /// @param body outlives the object
  explicit PageBody(const results::GeometryBody& body);

  const std::string& name() const { return body_.name; }
  const VisibleParts& visible() const { return visible_; }
  /// Numbers per row (PageRows) of the displacements in every frame.
  std::size_t displacements_per_frame(const run_store::RunReader& run) const;
  nlohmann::ordered_json json(const FrameReader& reader) const;

 private:
  using Json = nlohmann::ordered_json;

  std::size_t values_per_node() const;
  Json faces_into(Json out) const;
  void sections_into(Json& out) const;
  std::vector<int> face_edges() const;
  Json markers() const;
  Json pose(const FrameReader& reader) const;
  Json displacement(const FrameReader& reader) const;
  Json motion(const FrameReader& reader) const;

  const results::GeometryBody& body_;
  VisibleParts visible_;
};

}  // namespace buckens::page

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <nlohmann/json.hpp>

#include "buckens/io/view_page_frames.h"
#include "buckens/results/geometry.h"

namespace buckens::io {

/// A body as the page holds it (PageBody in viewer/src/page_data.ts). Of solids only what can be
/// seen goes there: the nodes of the surface and the stresses of the elements below it.
class PageBody {
 public:
  /// @param body outlives the object
  explicit PageBody(const results::GeometryBody& body);

  bool is_solid() const { return !body_.faces.empty(); }
  const std::string& name() const { return body_.name; }
  /// How many numbers a solid takes in every frame.
  std::size_t values_per_frame() const;
  nlohmann::ordered_json json(const FrameReader& reader) const;

 private:
  using Json = nlohmann::ordered_json;

  void choose_nodes();
  std::size_t values_per_node() const { return body_.elements.empty() ? 3 : 6; }
  Json markers() const;
  Json pose(const FrameReader& reader) const;
  Json displacement(const FrameReader& reader) const;
  Json motion(const FrameReader& reader) const;
  Json stress(const FrameReader& reader) const;
  Json solid_stress(const FrameReader& reader) const;

  const results::GeometryBody& body_;
  std::vector<std::size_t> nodes_;   // of the body that the page has
  std::vector<int> number_;          // in the page of each node of the body, −1 if it has not
  std::vector<std::size_t> solids_;  // solid elements below the surface, increasing
};

}  // namespace buckens::io

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "buckens/page/body.h"

namespace buckens::page {

/// A quantity of a body that the page can show in colour (PageField in viewer/src/page_data.ts).
struct PageField {
  enum class From { records, fields, fixed };

  std::string name;  ///< "von_mises" …; the page knows the usual ones
  /// "places" on the surface, "elements" with a face, "lines", or "lineEnds": two per line.
  std::string on;
  /// Source of the values: a channel of the records, a field over a mesh, values that exist once.
  From from = From::records;
  std::string path;
  std::string unit;
  std::vector<std::string> components;  ///< one empty name for a scalar
  std::size_t count = 0;                ///< of places
  FrameReader::Choose choose;           ///< the row of the page from that of the channel
  std::string level = {};               ///< side of a shell, "layer 2, top"; empty: none

  std::size_t values_per_frame() const {
    return from == From::fixed ? 0 : count * components.size();
  }
  nlohmann::ordered_json json(const FrameReader& reader) const;
};

/// The fields that the run recorded over the body.
std::vector<PageField> page_fields(const results::GeometryBody& body, const VisibleParts& visible,
                                   const run_store::RunReader& run);

}  // namespace buckens::page

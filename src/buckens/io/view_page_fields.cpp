// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace buckens::io {

namespace {

using results::Channel;
using results::GeometryBody;

const Channel* find(const RunReader& run, const std::string& path) {
  const int index = run.layout().find(path);
  return index < 0 ? nullptr : &run.layout().channel(static_cast<std::size_t>(index));
}

/// Every `stride`-th value from `first` on.
FrameReader::Choose column(std::size_t first, std::size_t stride) {
  return [first, stride](const std::vector<double>& all) {
    std::vector<double> out;
    for (std::size_t i = first; i < all.size(); i += stride) out.push_back(all[i]);
    return out;
  };
}

/// The largest magnitude among `stride` values at a time.
FrameReader::Choose largest_of(std::size_t stride) {
  return [stride](const std::vector<double>& all) {
    std::vector<double> out(all.size() / stride, 0.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
      out[i / stride] = std::max(out[i / stride], std::abs(all[i]));
    }
    return out;
  };
}

/// Stresses of beams and bars: by name where the channel names them, else the largest.
void add_lines(const GeometryBody& body, const RunReader& run, std::vector<PageField>& out) {
  const std::string path = fmt::format("bodies/{}/stress", body.name);
  const Channel* channel = find(run, path);
  const std::size_t lines = body.elements.size();
  if (channel == nullptr || lines == 0 || channel->size() % lines != 0) return;
  const std::size_t stride = channel->size() / lines;
  const auto add = [&](const std::string& name, FrameReader::Choose choose) {
    out.push_back({name, "lines", path, channel->unit, {""}, lines, std::move(choose)});
  };
  const auto& names = channel->components;
  if (names.size() != stride) {
    add("stress", largest_of(stride));
    return;
  }
  for (std::size_t k = 0; k < stride; ++k) {
    const bool mises = names[k] == "mises";
    add(mises ? "von_mises" : fmt::format("{}_stress", names[k]), column(k, stride));
  }
}

/// Von Mises stresses at the centres of the solid elements below the surface.
void add_solids(const GeometryBody& body, const VisibleParts& visible, const RunReader& run,
                std::vector<PageField>& out) {
  const std::string path = fmt::format("bodies/{}/solid_stress", body.name);
  const Channel* channel = find(run, path);
  const auto& solids = visible.solids;
  if (channel == nullptr || solids.empty() || channel->size() <= solids.back()) return;
  out.push_back({"von_mises",
                 "elements",
                 path,
                 channel->unit,
                 {""},
                 solids.size(),
                 [solids](const std::vector<double>& all) { return values_at(all, solids); }});
}

}  // namespace

nlohmann::ordered_json PageField::json(const FrameReader& reader) const {
  return {{"name", name},
          {"unit", unit},
          {"components", components},
          {"on", on},
          {"values", reader.rows(path, choose)}};
}

std::vector<PageField> page_fields(const GeometryBody& body, const VisibleParts& visible,
                                   const RunReader& run, const std::vector<std::string>& wanted) {
  std::vector<PageField> all;
  add_lines(body, run, all);
  add_solids(body, visible, run, all);
  if (wanted.empty()) return all;
  std::erase_if(all, [&](const PageField& field) {
    return std::find(wanted.begin(), wanted.end(), field.name) == wanted.end();
  });
  return all;
}

}  // namespace buckens::io

// SPDX-License-Identifier: Apache-2.0
#include "buckens/io/view_page_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/io/base64.h"

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
    out.push_back({name,
                   "lines",
                   PageField::From::records,
                   path,
                   channel->unit,
                   {""},
                   lines,
                   std::move(choose)});
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

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

/// The values at the given places, `stride` at each; NaN for kNowhere.
FrameReader::Choose groups_at(std::vector<std::size_t> places, std::size_t stride) {
  return [places = std::move(places), stride](const std::vector<double>& all) {
    std::vector<double> out;
    out.reserve(stride * places.size());
    for (const std::size_t place : places) {
      for (std::size_t k = 0; k < stride; ++k) {
        out.push_back(place == kNowhere ? std::nan("") : all.at(stride * place + k));
      }
    }
    return out;
  };
}

/// Von Mises stresses at the centres of the solid elements below the surface; shells have none.
void add_solids(const GeometryBody& body, const VisibleParts& visible, const RunReader& run,
                std::vector<PageField>& out) {
  const std::string path = fmt::format("bodies/{}/solid_stress", body.name);
  const Channel* channel = find(run, path);
  if (channel == nullptr || visible.solids.empty()) return;
  std::vector<std::size_t> places = visible.solids;
  for (std::size_t& place : places) place = place < channel->size() ? place : kNowhere;
  out.push_back({"von_mises",
                 "elements",
                 PageField::From::records,
                 path,
                 channel->unit,
                 {""},
                 places.size(),
                 groups_at(places, 1)});
}

/// The row in fields at elements of each visible solid element.
std::vector<std::size_t> element_rows(const GeometryBody& body, const VisibleParts& visible) {
  std::vector<std::size_t> rows;
  const auto& known = body.field_elements;
  for (const std::size_t solid : visible.solids) {
    const auto at = std::lower_bound(known.begin(), known.end(), static_cast<int>(solid));
    const bool found = at != known.end() && *at == static_cast<int>(solid);
    rows.push_back(found ? static_cast<std::size_t>(at - known.begin()) : kNowhere);
  }
  return rows;
}

std::vector<std::string> names_of(const Channel& channel) {
  if (channel.shape.size() < 2) return {""};
  if (!channel.components.empty()) return channel.components;
  std::vector<std::string> names;
  for (int k = 1; k <= channel.shape.back(); ++k) names.push_back(fmt::format("{}", k));
  return names;
}

/// Fields over the mesh, at nodes and at elements. The page has displacements already.
void add_fields(const GeometryBody& body, const VisibleParts& visible, const RunReader& run,
                std::vector<PageField>& out) {
  const std::vector<std::size_t> rows = element_rows(body, visible);
  const std::string group = fmt::format("fields/bodies/{}/", body.name);
  for (const Channel& channel : run.field_layout().channels()) {
    if (!channel.path.starts_with(group)) continue;
    const std::string rest = channel.path.substr(group.size());
    const std::size_t slash = rest.find('/');
    const std::string name = slash == rest.npos ? "" : rest.substr(slash + 1);
    const bool at_nodes = rest.starts_with("nodes/");
    const auto& places = at_nodes ? visible.places : rows;
    if (name.empty() || name.find('/') != name.npos || name == "displacement" || places.empty() ||
        (!at_nodes && !rest.starts_with("elements/"))) {
      continue;
    }
    const std::vector<std::string> components = names_of(channel);
    out.push_back({name, at_nodes ? "places" : "elements", PageField::From::fields, channel.path,
                   channel.unit, components, places.size(), groups_at(places, components.size())});
  }
}

/// The largest von Mises stress of the run at each place, and when.
void add_extremes(const GeometryBody& body, const VisibleParts& visible, const RunReader& run,
                  std::vector<PageField>& out) {
  if (visible.places.empty()) return;
  const std::string path = fmt::format("extremes/bodies/{}/nodes/von_mises", body.name);
  const auto add = [&](const std::string& name, const std::string& from, const std::string& unit) {
    if (run.read_fixed(from).size() <= visible.places.back()) return;
    out.push_back({name,
                   "places",
                   PageField::From::fixed,
                   from,
                   unit,
                   {""},
                   visible.places.size(),
                   groups_at(visible.places, 1)});
  };
  add("von_mises_largest", path, "Pa");
  add("von_mises_time", path + "_time", "s");
}

}  // namespace

nlohmann::ordered_json PageField::json(const FrameReader& reader) const {
  nlohmann::ordered_json out = {
      {"name", name}, {"unit", unit}, {"components", components}, {"on", on}};
  if (from == From::records) out["values"] = reader.rows(path, choose);
  if (from == From::fixed) {
    out["constant"] = true;
    out["values"] = reader.fixed_row(path, choose);
  }
  if (from == From::fields) {
    const PageFrames& frames = reader.frames();
    if (frames.field_rows.size() != frames.records.size()) {
      out["frames"] = base64_int32(frames.field_frames);
    }
    out["values"] = reader.field_rows(path, choose);
  }
  return out;
}

std::vector<PageField> page_fields(const GeometryBody& body, const VisibleParts& visible,
                                   const RunReader& run, const std::vector<std::string>& wanted) {
  std::vector<PageField> all;
  add_lines(body, run, all);
  add_fields(body, visible, run, all);
  add_extremes(body, visible, run, all);
  const bool has_elements = std::any_of(all.begin(), all.end(), [](const PageField& field) {
    return field.name == "von_mises" && field.on == "elements";
  });
  if (!has_elements) add_solids(body, visible, run, all);
  if (wanted.empty()) return all;
  std::erase_if(all, [&](const PageField& field) {
    return std::find(wanted.begin(), wanted.end(), field.name) == wanted.end();
  });
  return all;
}

}  // namespace buckens::io

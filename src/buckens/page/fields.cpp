// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/files/base64.h"
#include "buckens/run_store/run_snapshot.h"

namespace buckens::page {

namespace {

using results::Channel;
using results::GeometryBody;

const Channel* find(const run_store::RunReader& run, const std::string& path) {
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
void add_lines(const GeometryBody& body, const run_store::RunReader& run,
               std::vector<PageField>& out) {
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

/// Section forces of beams and bars at both ends of every element.
void add_section_forces(const GeometryBody& body, const run_store::RunReader& run,
                        std::vector<PageField>& out) {
  constexpr std::size_t kPerElement = 12;
  const std::string path = fmt::format("bodies/{}/section_force", body.name);
  const Channel* channel = find(run, path);
  const std::size_t lines = body.elements.size();
  if (channel == nullptr || lines == 0 || channel->size() != kPerElement * lines) return;
  const auto add = [&](const std::string& name, const std::string& unit,
                       std::vector<std::string> components, std::size_t first) {
    const auto choose = [first](const std::vector<double>& all) {
      std::vector<double> of_kind;
      of_kind.reserve(all.size() / 2);
      for (std::size_t end = first; end < all.size(); end += kPerElement / 2) {
        for (std::size_t k = 0; k < 3; ++k) of_kind.push_back(all[end + k]);
      }
      return of_kind;
    };
    out.push_back({name, "lineEnds", PageField::From::records, path, unit, std::move(components),
                   2 * lines, choose});
  };
  add("section_force", "N", {"N", "Qy", "Qz"}, 0);
  add("section_moment", "N m", {"Mt", "My", "Mz"}, 3);
}

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

/// What is taken of the values of one place.
struct Slice {
  std::size_t stride;  ///< all values of a place
  std::size_t first = 0;
  std::size_t width = stride;
};

/// The values at the given places; NaN for kNowhere.
FrameReader::Choose groups_at(std::vector<std::size_t> places, Slice slice) {
  return [places = std::move(places), slice](const std::vector<double>& all) {
    std::vector<double> out;
    out.reserve(slice.width * places.size());
    for (const std::size_t place : places) {
      for (std::size_t k = slice.first; k < slice.first + slice.width; ++k) {
        out.push_back(place == kNowhere ? std::nan("") : all.at(slice.stride * place + k));
      }
    }
    return out;
  };
}

/// Von Mises stresses at the centres of the solids and shells that can be seen.
void add_solids(const GeometryBody& body, const VisibleParts& visible,
                const run_store::RunReader& run, std::vector<PageField>& out) {
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
                 groups_at(places, {1})});
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
void add_fields(const GeometryBody& body, const VisibleParts& visible,
                const run_store::RunReader& run, std::vector<PageField>& out) {
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
                   channel.unit, components, places.size(),
                   groups_at(places, {components.size()})});
  }
}

/// The row in fields of shells of each visible element.
std::vector<std::size_t> shell_rows(const GeometryBody& body, const VisibleParts& visible) {
  const std::vector<int> shells = run_store::shells_of(body);
  std::vector<std::size_t> rows;
  if (shells.empty()) return rows;
  const auto first = static_cast<std::size_t>(shells.front());  // shells follow one another
  for (const std::size_t element : visible.solids) {
    const bool is_shell = element >= first && element < first + shells.size();
    rows.push_back(is_shell ? element - first : kNowhere);
  }
  return rows;
}

/// Stresses of shells side by side and layer by layer, and their forces and moments per length.
/// Their von Mises stress is in the records already.
void add_shells(const GeometryBody& body, const VisibleParts& visible,
                const run_store::RunReader& run, std::vector<PageField>& out) {
  const std::vector<std::size_t> rows = shell_rows(body, visible);
  if (rows.empty()) return;
  const auto add = [&](const Channel& channel, const std::string& name, const std::string& unit,
                       const std::vector<std::string>& components, Slice slice,
                       const std::string& level) {
    out.push_back({name, "elements", PageField::From::fields, channel.path, unit, components,
                   rows.size(), groups_at(rows, slice), level});
  };
  const std::string group = fmt::format("fields/bodies/{}/shells/", body.name);
  const Channel* stress = run_store::find_channel(run.field_layout(), group + "stress");
  if (stress != nullptr && stress->shape.size() == 3 && stress->shape[2] == 3) {
    const auto levels = static_cast<std::size_t>(stress->shape[1]);
    for (std::size_t level = 0; level < levels; ++level) {
      const std::string side = level % 2 == 0 ? "bottom" : "top";
      add(*stress, "shell_stress", stress->unit, {"x", "y", "xy"}, {3 * levels, 3 * level, 3},
          levels == 2 ? side : fmt::format("layer {}, {}", level / 2 + 1, side));
    }
  }
  const Channel* forces = run_store::find_channel(run.field_layout(), group + "section_force");
  if (forces != nullptr && forces->shape.size() == 2 && forces->shape[1] == 8) {
    add(*forces, "shell_force", "N/m", {"Nx", "Ny", "Nxy"}, {8, 0, 3}, "");
    add(*forces, "shell_moment", "N", {"Mx", "My", "Mxy"}, {8, 3, 3}, "");
    add(*forces, "shell_shear_force", "N/m", {"Qx", "Qy"}, {8, 6, 2}, "");
  }
}

/// The largest von Mises stresses of the run at nodes, in elements and in shells, and when.
void add_extremes(const GeometryBody& body, const VisibleParts& visible,
                  const run_store::RunReader& run, std::vector<PageField>& out) {
  const auto add = [&](const std::string& location, const char* on,
                       const std::vector<std::size_t>& rows) {
    const std::string path = fmt::format("extremes/bodies/{}/{}/von_mises", body.name, location);
    std::size_t needed = 0;
    for (const std::size_t row : rows) {
      if (row != kNowhere) needed = std::max(needed, row + 1);
    }
    if (needed == 0) return;
    for (const bool is_time : {false, true}) {
      const std::string from = is_time ? path + "_time" : path;
      if (run.read_fixed(from).size() < needed) continue;
      out.push_back({is_time ? "von_mises_time" : "von_mises_largest",
                     on,
                     PageField::From::fixed,
                     from,
                     is_time ? "s" : "Pa",
                     {""},
                     rows.size(),
                     groups_at(rows, {1})});
    }
  };
  add("nodes", "places", visible.places);
  add("elements", "elements", element_rows(body, visible));
  add("shells", "elements", shell_rows(body, visible));
}

}  // namespace

nlohmann::ordered_json PageField::json(const FrameReader& reader) const {
  nlohmann::ordered_json out = {
      {"name", name}, {"unit", unit}, {"components", components}, {"on", on}};
  if (!level.empty()) out["level"] = level;
  if (from == From::records) out["values"] = reader.rows(path, choose);
  if (from == From::fixed) {
    out["constant"] = true;
    out["values"] = reader.fixed_row(path, choose);
  }
  if (from == From::fields) {
    const PageFrames& frames = reader.frames();
    if (frames.field_rows.size() != frames.records.size()) {
      out["frames"] = files::base64_int32(frames.field_frames);
    }
    out["values"] = reader.field_rows(path, choose);
  }
  return out;
}

std::vector<PageField> page_fields(const GeometryBody& body, const VisibleParts& visible,
                                   const run_store::RunReader& run) {
  std::vector<PageField> all;
  add_lines(body, run, all);
  add_section_forces(body, run, all);
  add_fields(body, visible, run, all);
  add_shells(body, visible, run, all);
  add_extremes(body, visible, run, all);
  const bool has_elements = std::any_of(all.begin(), all.end(), [](const PageField& field) {
    return field.name == "von_mises" && field.on == "elements";
  });
  if (!has_elements || !run_store::shells_of(body).empty()) add_solids(body, visible, run, all);
  return all;
}

}  // namespace buckens::page

// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_channels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/results/motion_tables.h"

namespace buckens::run_store {

namespace {

constexpr int kDeepestChannel = 8;  // ours: fields/bodies/<body>/interfaces/<marker>

/// Goes through the groups of a file once.
class LayoutReader {
 public:
  LayoutReader(const Hdf5File& file, hsize_t rows) : file_(file), rows_(rows) {
    // A group that holds itself has no end; each object takes more of the file than this.
    constexpr std::uintmax_t kSmallestObject = 16;
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(file.path(), ignored);
    most_objects_ = ignored ? 0 : static_cast<std::size_t>(size / kSmallestObject);
  }

  results::RecordLayout read(const std::string& group) {
    add_group(group == "/" ? "" : group, 0);
    return std::move(layout_);
  }

 private:
  /// What is beside the channels.
  static bool is_apart(const std::string& path) {
    static constexpr std::array kApart = {"/geometry", "/time", "/fields", "/extremes",
                                          "/fields/time"};
    return std::find(kApart.begin(), kApart.end(), path) != kApart.end();
  }

  void add_group(const std::string& group, int depth) {
    if (depth > kDeepestChannel) refuse(file_, group, "is nested too deeply");
    for (const std::string& name : list_objects(file_, group.empty() ? "/" : group)) {
      const std::string path = group + '/' + name;
      if (is_apart(path)) continue;
      if (++num_objects_ > most_objects_) refuse(file_, path, "belongs to a loop of groups");
      const Hdf5Kind kind = kind_of_object(file_, path);
      if (kind == Hdf5Kind::group) add_group(path, depth + 1);
      if (kind == Hdf5Kind::dataset) add_channel(path);
    }
  }

  void add_channel(const std::string& path) {
    const Hdf5Dataset dataset = open_dataset(file_, path, Hdf5Values::numbers, rows_);
    const std::vector<hsize_t>& extents = dataset.extents;
    if (extents.empty() || extents[0] < rows_) {
      refuse(file_, path, fmt::format("has no value for each of {} instants", rows_));
    }
    results::Channel channel;
    channel.path = path.substr(1);
    channel.unit = read_string(file_, path, "unit");
    channel.description = read_string(file_, path, "description");
    channel.components = read_strings(file_, path, "components");
    for (std::size_t i = 1; i < extents.size(); ++i) {
      channel.shape.push_back(static_cast<int>(extents[i]));
    }
    try {
      layout_.add(std::move(channel));
    } catch (const ModelError& error) {
      refuse(file_, path, fmt::format("cannot be a channel ({})", error.what()));
    }
  }

  const Hdf5File& file_;
  hsize_t rows_;
  std::size_t most_objects_ = 0;
  std::size_t num_objects_ = 0;
  results::RecordLayout layout_;
};

void check_shape(const Hdf5File& file, const results::RecordLayout& layout, const std::string& path,
                 const std::vector<int>& shape) {
  const int index = layout.find(path);
  if (index < 0 || layout.channel(static_cast<std::size_t>(index)).shape == shape) return;
  refuse(file, '/' + path,
         fmt::format("has records of the extents [{}] in place of [{}]",
                     fmt::join(layout.channel(static_cast<std::size_t>(index)).shape, " x "),
                     fmt::join(shape, " x ")));
}

/// @param may_be_shorter it may have fewer rows
void check_table(const Hdf5File& file, const results::RecordLayout& layout,
                 results::Channel expected, bool may_be_shorter = false) {
  const int index = layout.find(expected.path);
  if (index < 0) return;
  const std::vector<int>& found = layout.channel(static_cast<std::size_t>(index)).shape;
  if (may_be_shorter && !found.empty() && found[0] < expected.shape[0]) {
    expected.shape[0] = found[0];
  }
  check_shape(file, layout, expected.path, expected.shape);
}

}  // namespace

results::RecordLayout read_layout(const Hdf5File& file, const std::string& group, hsize_t rows) {
  return LayoutReader(file, rows).read(group);
}

Hdf5Dataset open_channel(const Hdf5File& file, const results::Channel& channel) {
  const Hdf5Quiet quiet;
  const std::string path = '/' + channel.path;
  const std::string what = "read " + path;
  Hdf5Dataset out;
  out.handle =
      Hdf5Handle(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), what), H5Dclose);
  const Hdf5Handle space(file.check(H5Dget_space(out.handle.get()), what), H5Sclose);
  out.extents = extents_of(file, path, space.get());
  out.row_size = channel.size();
  if (out.extents.empty() ||
      !std::equal(out.extents.begin() + 1, out.extents.end(), channel.shape.begin(),
                  channel.shape.end(),
                  [](hsize_t found, int known) { return found == static_cast<hsize_t>(known); })) {
    refuse(file, path, "has changed its extents");
  }
  return out;
}

void check_channels(const Hdf5File& file, const results::Geometry& geometry,
                    const results::RecordLayout& records, const results::RecordLayout& fields) {
  check_table(file, records, results::motions_channel(geometry.bodies.size()));
  // Springs and the like are drawn with the joints, after them: they have no row.
  check_table(file, records, results::reactions_channel(geometry.joints.size()), true);
  for (const results::GeometryBody& body : geometry.bodies) {
    const std::string group = fmt::format("bodies/{}/", body.name);
    check_shape(file, records, group + "pose", {7});
    check_shape(file, records, group + "motion", {6});
    check_shape(file, records, group + "displacement", {static_cast<int>(body.nodes.rows()), 6});
    const auto num_shells =
        std::count_if(body.cell_kinds.begin(), body.cell_kinds.end(),
                      [](fem::CellKind kind) { return fem::dimension_of(kind) == 2; });
    const std::array<std::pair<std::string, std::size_t>, 3> places = {
        {{"fields/" + group + "nodes/", body.field_nodes.size()},
         {"fields/" + group + "elements/", body.field_elements.size()},
         {"fields/" + group + "shells/", static_cast<std::size_t>(num_shells)}}};
    for (const results::Channel& channel : fields.channels()) {
      for (const auto& [place, count] : places) {
        if (!channel.path.starts_with(place)) continue;
        if (channel.shape.empty() || static_cast<std::size_t>(channel.shape[0]) != count) {
          refuse(file, '/' + channel.path,
                 fmt::format("does not have {} places, as the body has", count));
        }
      }
    }
  }
}

}  // namespace buckens::run_store

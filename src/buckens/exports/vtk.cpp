// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/vtk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/vtu/file.h"

namespace buckens::exports {

namespace {

constexpr float kNoFloat = std::numeric_limits<float>::quiet_NaN();

/// Numbers per place.
int width_of(const results::Channel& channel) {
  return static_cast<int>(channel.size()) / channel.shape.front();
}

/// Points and cells of one body, which are the same at every instant.
struct BodyGrid {
  const results::GeometryBody* body;
  std::vector<int> point_nodes;   // −1: the origin of a rigid body
  std::vector<int> point_places;  // among field_nodes, −1
  std::vector<fem::CellKind> kinds;
  std::vector<int> corners;   // points, cell after cell
  std::size_t num_lines = 0;  // lines come first, then solids
  std::size_t num_solids = 0;
};

BodyGrid make_grid(const results::GeometryBody& body) {
  BodyGrid out{&body, {}, {}, {}, {}, body.elements.size(), body.cell_kinds.size()};
  const auto num_nodes = static_cast<std::size_t>(body.nodes.rows());
  out.point_nodes.resize(num_nodes);
  std::iota(out.point_nodes.begin(), out.point_nodes.end(), 0);
  out.point_places.assign(num_nodes, -1);
  // The first place of a node is its point; further ones become further points.
  std::vector<int> point_of_place(body.field_nodes.size());
  for (std::size_t p = 0; p < body.field_nodes.size(); ++p) {
    const int node = body.field_nodes[p];
    int& place = out.point_places[static_cast<std::size_t>(node)];
    if (place < 0) {
      place = static_cast<int>(p);
      point_of_place[p] = node;
      continue;
    }
    point_of_place[p] = static_cast<int>(out.point_nodes.size());
    out.point_nodes.push_back(node);
    out.point_places.push_back(static_cast<int>(p));
  }
  if (num_nodes == 0) {
    out.point_nodes.push_back(-1);
    out.point_places.push_back(-1);
    out.kinds.push_back(fem::CellKind::point1);
    out.corners.push_back(0);
    out.num_lines = 1;
    return out;
  }
  for (const auto& [a, b] : body.elements) {
    out.kinds.push_back(fem::CellKind::line2);
    out.corners.insert(out.corners.end(), {a, b});
  }
  out.kinds.insert(out.kinds.end(), body.cell_kinds.begin(), body.cell_kinds.end());
  for (std::size_t c = 0; c < body.cell_nodes.size(); ++c) {
    const int place = body.cell_places.empty() ? -1 : body.cell_places[c];
    out.corners.push_back(place < 0 ? body.cell_nodes[c]
                                    : point_of_place[static_cast<std::size_t>(place)]);
  }
  return out;
}

/// Data arrays by name; what a body does not have is NaN.
class Arrays {
 public:
  /// Appends values of one body. Bodies of fewer layers than others have NaN for the rest.
  void put(const results::Channel& channel, const std::string& name, std::vector<float> values) {
    const int width = width_of(channel);
    auto [at, is_new] = arrays_.try_emplace(name);
    if (is_new) {
      const bool are_named = channel.components.size() == static_cast<std::size_t>(width);
      at->second = {name, width, std::vector<float>{},
                    are_named ? channel.components : std::vector<std::string>{}};
    }
    auto& all = std::get<std::vector<float>>(at->second.values);
    if (at->second.components < width) {
      all = widened(all, at->second.components, width);
      at->second.components = width;
      at->second.component_names.clear();
    }
    const auto components = static_cast<std::size_t>(at->second.components);
    values = widened(values, width, at->second.components);
    all.resize(count_ * components, kNoFloat);
    all.insert(all.end(), values.begin(), values.end());
  }
  /// Ends the share of a body. @param count its points or cells
  void end_body(std::size_t count) { count_ += count; }

  std::vector<mesh_io::VtuArray> finished() {
    std::vector<mesh_io::VtuArray> out;
    for (auto& [name, array] : arrays_) {
      const auto components = static_cast<std::size_t>(array.components);
      std::get<std::vector<float>>(array.values).resize(count_ * components, kNoFloat);
      out.push_back(std::move(array));
    }
    return out;
  }

 private:
  /// Rows of `from` numbers with NaN behind them up to `to` numbers.
  static std::vector<float> widened(const std::vector<float>& values, int from, int to) {
    if (from == to) return values;
    const auto width = static_cast<std::size_t>(from);
    std::vector<float> out;
    for (std::size_t row = 0; row * width < values.size(); ++row) {
      out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(row * width),
                 values.begin() + static_cast<std::ptrdiff_t>((row + 1) * width));
      out.resize((row + 1) * static_cast<std::size_t>(to), kNoFloat);
    }
    return out;
  }

  std::map<std::string, mesh_io::VtuArray> arrays_;
  std::size_t count_ = 0;
};

const results::Channel kDisplacement{"", "m", {1, 3}, "", {"x", "y", "z"}};
const results::Channel kMises{"", "Pa", {1}, "", {}};

class VtkExporter {
 public:
  explicit VtkExporter(const run_store::RunReader& run) : run_(run) {
    for (const results::GeometryBody& body : run.geometry().bodies) {
      grids_.push_back(make_grid(body));
    }
  }

  mesh_io::VtuGrid grid(const run_store::Instant& now) const {
    mesh_io::VtuGrid out;
    Arrays points, cells;
    std::vector<std::int32_t> body_numbers;
    for (std::size_t b = 0; b < grids_.size(); ++b) {
      const BodyGrid& grid = grids_[b];
      add_points(grid, now, out, points);
      add_node_fields(grid, now, points);
      add_cells(grid, out);
      add_cell_fields(grid, now, cells);
      points.end_body(grid.point_nodes.size());
      cells.end_body(grid.kinds.size());
      body_numbers.insert(body_numbers.end(), grid.kinds.size(), static_cast<std::int32_t>(b));
    }
    out.point_data = points.finished();
    out.cell_data = cells.finished();
    out.cell_data.push_back({"body", 1, std::move(body_numbers), {}});
    out.field_data.push_back({"TimeValue", 1, std::vector<double>{now.t}, {}});
    return out;
  }

 private:
  void add_points(const BodyGrid& grid, const run_store::Instant& now, mesh_io::VtuGrid& out,
                  Arrays& arrays) const {
    const spatial::Pose X = run_store::pose_of(run_, grid.body->name, now.record);
    const Eigen::Matrix3Xd u = run_store::displacements_of(run_, *grid.body, now.record);
    std::vector<float> turned;
    for (const int node : grid.point_nodes) {
      if (node < 0) {
        out.points.push_back(X.p);
        continue;
      }
      const Eigen::Vector3d place = grid.body->nodes.row(node).transpose();
      out.points.push_back(X * Eigen::Vector3d(place + u.col(node)));
      const Eigen::Vector3d world = X.q * u.col(node);
      for (int k = 0; k < 3; ++k) turned.push_back(static_cast<float>(world[k]));
    }
    if (!turned.empty()) arrays.put(kDisplacement, "displacement", std::move(turned));
  }

  void add_node_fields(const BodyGrid& grid, const run_store::Instant& now, Arrays& arrays) const {
    if (!now.field_row) return;
    for (const std::string& name : run_store::field_names(run_, grid.body->name, "nodes")) {
      if (name == "displacement") continue;  // there already
      const std::string path = fmt::format("fields/bodies/{}/nodes/{}", grid.body->name, name);
      const results::Channel& channel = *run_store::find_channel(run_.field_layout(), path);
      const std::vector<double> values = run_.read_fields(path, std::array{*now.field_row});
      arrays.put(channel, name, spread(channel, values, grid.point_places));
    }
  }

  /// Values of the given rows, NaN for −1.
  static std::vector<float> spread(const results::Channel& channel,
                                   const std::vector<double>& values,
                                   const std::vector<int>& rows) {
    const auto width = static_cast<std::size_t>(width_of(channel));
    std::vector<float> out;
    for (const int row : rows) {
      for (std::size_t k = 0; k < width; ++k) {
        out.push_back(row < 0
                          ? kNoFloat
                          : static_cast<float>(values[static_cast<std::size_t>(row) * width + k]));
      }
    }
    return out;
  }

  static void add_cells(const BodyGrid& grid, mesh_io::VtuGrid& out) {
    const std::size_t first =
        out.points.size() - grid.point_nodes.size();  // the body's points came just before
    std::vector<int> nodes;
    std::size_t corner = 0;
    for (const fem::CellKind kind : grid.kinds) {
      nodes.clear();
      for (int k = 0; k < fem::num_nodes(kind); ++k) {
        nodes.push_back(grid.corners[corner++] + static_cast<int>(first));
      }
      out.add_cell(kind, nodes);
    }
  }

  void add_cell_fields(const BodyGrid& grid, const run_store::Instant& now, Arrays& arrays) const {
    std::vector<float> mises;
    const auto of_record = [&](const char* name) {
      const std::string path = fmt::format("bodies/{}/{}", grid.body->name, name);
      if (run_store::find_channel(run_.layout(), path) == nullptr) return std::vector<double>();
      return run_.read(path, std::array{now.record});
    };
    const std::vector<double> lines = of_record("stress");
    for (std::size_t e = 0; e < grid.num_lines; ++e) {
      mises.push_back(2 * e + 1 < lines.size() ? static_cast<float>(lines[2 * e + 1]) : kNoFloat);
    }
    const std::vector<double> solids = of_record("solid_stress");
    for (std::size_t e = 0; e < grid.num_solids; ++e) {
      mises.push_back(e < solids.size() ? static_cast<float>(solids[e]) : kNoFloat);
    }
    arrays.put(kMises, "von_mises", std::move(mises));
    if (!now.field_row) return;
    add_rows(grid, now, "elements", grid.body->field_elements, "", arrays);
    add_rows(grid, now, "shells", run_store::shells_of(*grid.body), "shell_", arrays);
  }

  /// Fields of some solids or shells.
  /// @param prefix of the names of the arrays
  void add_rows(const BodyGrid& grid, const run_store::Instant& now, const std::string& location,
                const std::vector<int>& elements, const std::string& prefix, Arrays& arrays) const {
    std::vector<int> rows(grid.kinds.size(), -1);
    for (std::size_t row = 0; row < elements.size(); ++row) {
      rows.at(grid.num_lines + static_cast<std::size_t>(elements[row])) = static_cast<int>(row);
    }
    for (const std::string& name : run_store::field_names(run_, grid.body->name, location)) {
      if (name == "von_mises") continue;  // the same number as in every record
      const std::string path =
          fmt::format("fields/bodies/{}/{}/{}", grid.body->name, location, name);
      const results::Channel& channel = *run_store::find_channel(run_.field_layout(), path);
      const std::vector<double> values = run_.read_fields(path, std::array{*now.field_row});
      arrays.put(channel, prefix + name, spread(channel, values, rows));
    }
  }

  const run_store::RunReader& run_;
  std::vector<BodyGrid> grids_;
};

}  // namespace

std::size_t export_vtk(const run_store::RunReader& run, const run_store::InstantChoice& choice,
                       const std::filesystem::path& directory, const std::string& name) {
  const std::vector<run_store::Instant> instants = run_store::choose_instants(run, choice);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw IoError(
        fmt::format("{}: cannot create the directory: {}.", directory.string(), error.message()));
  }
  const VtkExporter exporter(run);
  std::vector<mesh_io::PvdEntry> entries;
  for (const run_store::Instant& now : instants) {
    const std::string file = fmt::format("{}_{:04}.vtu", name, entries.size());
    mesh_io::write_vtu(directory / file, exporter.grid(now));
    entries.push_back({now.t, file});
  }
  mesh_io::write_pvd(directory / (name + ".pvd"), entries);
  return entries.size();
}

}  // namespace buckens::exports

// SPDX-License-Identifier: Apache-2.0
#include "buckens/exports/glb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "buckens/exports/glb_file.h"
#include "buckens/exports/surface_mesh.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::exports {

namespace {

using Json = nlohmann::ordered_json;
using Colour = std::array<std::uint8_t, 4>;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
// Shapes that add less than this fraction of the largest are left out.
constexpr double kLeastShape = 1e-5;
constexpr int kTriangles = 4;  // modes of primitives
constexpr int kLines = 1;

/// Deformations of a body at some instants as a few shapes with weights.
struct Shapes {
  std::vector<Eigen::Matrix3Xf> shapes;  // of the vertices [m]
  Eigen::MatrixXd weights;               // instants × shapes
  double error = 0;                      // largest, relative to the largest displacement
};

/// @param motion 3V × instants: displacements of the vertices
Shapes find_shapes(const Eigen::MatrixXf& motion, int most) {
  Shapes out;
  const Eigen::Index count = motion.cols();
  out.weights.resize(count, 0);
  const float largest = motion.size() == 0 ? 0.0F : motion.cwiseAbs().maxCoeff();
  if (!(largest > 0.0F)) return out;
  const Eigen::MatrixXd gram = (motion.transpose() * motion).cast<double>();
  const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(gram);
  const double leading = eigen.values[count - 1];
  Eigen::MatrixXf rest = motion;
  for (Eigen::Index k = count; k-- > 0 && static_cast<int>(out.shapes.size()) < most;) {
    if (!(eigen.values[k] > kLeastShape * kLeastShape * leading)) break;
    const Eigen::VectorXf v = eigen.vectors.col(k).cast<float>();
    const Eigen::VectorXf shape = motion * v;
    rest.noalias() -= shape * v.transpose();
    out.shapes.emplace_back(shape.reshaped(3, shape.size() / 3));
    out.weights.conservativeResize(count, out.weights.cols() + 1);
    out.weights.rightCols<1>() = eigen.vectors.col(k);
  }
  out.error = static_cast<double>(rest.cwiseAbs().maxCoeff() / largest);
  return out;
}

/// Dark blue over green to yellow, as viridis; grey without value. Linear light, as glTF has it.
Colour colour_of(double share) {
  static constexpr std::array<std::array<double, 3>, 6> stops = {{{0.267, 0.005, 0.329},
                                                                  {0.254, 0.265, 0.530},
                                                                  {0.164, 0.471, 0.558},
                                                                  {0.135, 0.659, 0.518},
                                                                  {0.478, 0.821, 0.318},
                                                                  {0.993, 0.906, 0.144}}};
  std::array<double, 3> rgb = {0.6, 0.6, 0.6};
  if (!std::isnan(share)) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[c] = std::lerp(stops[low][c], stops[low + 1][c], at - static_cast<double>(low));
    }
  }
  Colour out{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(rgb[c], 2.2)));
  }
  return out;
}

/// Von Mises stress of every node, NaN where there is none.
std::vector<double> nodal_stress(const run_store::RunReader& run, const results::GeometryBody& body,
                                 const run_store::Instant& now) {
  const auto num_nodes = static_cast<std::size_t>(body.nodes.rows());
  std::vector<double> sum(num_nodes, 0.0), count(num_nodes, 0.0);
  const auto add = [&](int node, double value) {
    if (node < 0 || std::isnan(value)) return;
    sum[static_cast<std::size_t>(node)] += value;
    count[static_cast<std::size_t>(node)] += 1.0;
  };
  const std::string field = fmt::format("fields/bodies/{}/nodes/von_mises", body.name);
  const auto of_record = [&](const char* name) {
    const std::string path = fmt::format("bodies/{}/{}", body.name, name);
    if (run_store::find_channel(run.layout(), path) == nullptr) return std::vector<double>();
    return run.read(path, std::array{now.record});
  };
  if (now.field_row && run_store::find_channel(run.field_layout(), field) != nullptr) {
    const std::vector<double> values = run.read_fields(field, std::array{*now.field_row});
    for (std::size_t p = 0; p < values.size(); ++p) add(body.field_nodes[p], values[p]);
  } else {
    const std::vector<double> solids = of_record("solid_stress");
    std::size_t corner = 0;
    for (std::size_t e = 0; e < body.cell_kinds.size(); ++e) {
      for (int k = 0; k < fem::num_nodes(body.cell_kinds[e]); ++k) {
        add(body.cell_nodes[corner++], e < solids.size() ? solids[e] : kNoValue);
      }
    }
  }
  const std::vector<double> lines = of_record("stress");
  for (std::size_t e = 0; 2 * e + 1 < lines.size() && e < body.elements.size(); ++e) {
    for (const int node : body.elements[e]) add(node, lines[2 * e + 1]);
  }
  for (std::size_t n = 0; n < num_nodes; ++n) {
    sum[n] = count[n] > 0.0 ? sum[n] / count[n] : kNoValue;
  }
  return sum;
}

class GlbExporter {
 public:
  GlbExporter(const run_store::RunReader& run, const GlbOptions& options)
      : run_(run), options_(options) {
    instants_ = run_store::choose_instants(run, options.animation);
    run_store::InstantChoice still;
    still.count = 1;  // the end
    if (options.at) still.times = {*options.at};
    still_ = run_store::choose_instants(run, still).front();
    report_.at = still_.t;
    report_.instants = instants_.size();
    find_range();
  }

  GlbReport write(const std::filesystem::path& path) {
    file_.root["scene"] = 0;
    file_.root["scenes"] = {{{"nodes", Json::array()}, {"name", run_.title()}}};
    file_.root["nodes"] = Json::array();
    file_.root["materials"] = {
        {{"name", "surface"},
         {"doubleSided", true},
         {"pbrMetallicRoughness", {{"metallicFactor", 0.1}, {"roughnessFactor", 0.7}}}}};
    if (instants_.size() > 1) {
      const double duration = instants_.back().t - instants_.front().t;
      report_.playback =
          options_.playback > 0.0 ? options_.playback : std::clamp(duration, 2.0, 30.0);
      std::vector<float> times;
      for (const run_store::Instant& now : instants_) {
        times.push_back(
            static_cast<float>((now.t - instants_.front().t) * report_.playback / duration));
      }
      times_ = file_.add_floats(times, true);
    }
    for (const results::GeometryBody& body : run_.geometry().bodies) add_body(body);
    if (!meshes_.empty()) file_.root["meshes"] = meshes_;
    if (!channels_.empty()) {
      file_.root["animations"] = {
          {{"name", "motion"}, {"samplers", samplers_}, {"channels", channels_}}};
    }
    file_.root["extras"] = {{"time", still_.t},
                            {"playback", report_.playback},
                            {"von_mises_min", report_.least},
                            {"von_mises_max", report_.most},
                            {"exaggeration", options_.exaggeration}};
    file_.write(path);
    return report_;
  }

 private:
  void find_range() {
    bool is_first = true;
    for (const results::GeometryBody& body : run_.geometry().bodies) {
      stresses_.push_back(nodal_stress(run_, body, still_));
      for (const double value : stresses_.back()) {
        if (std::isnan(value)) continue;
        report_.least = is_first ? value : std::min(report_.least, value);
        report_.most = is_first ? value : std::max(report_.most, value);
        is_first = false;
      }
    }
  }

  /// Displacements of the vertices at all key frames and, in the last column, at the still.
  Eigen::MatrixXf motion_of(const results::GeometryBody& body, const SurfaceMesh& mesh) const {
    const auto vertices = static_cast<Eigen::Index>(mesh.nodes.size());
    Eigen::MatrixXf out(3 * vertices, static_cast<Eigen::Index>(instants_.size()) + 1);
    const auto factor = static_cast<float>(options_.exaggeration);
    for (Eigen::Index k = 0; k < out.cols(); ++k) {
      const bool is_still = k + 1 == out.cols();
      const run_store::Instant& now = is_still ? still_ : instants_[static_cast<std::size_t>(k)];
      const Eigen::Matrix3Xf u = run_store::displacements_of(run_, body, now.record).cast<float>();
      for (Eigen::Index v = 0; v < vertices; ++v) {
        out.col(k).segment<3>(3 * v) = factor * u.col(mesh.nodes[static_cast<std::size_t>(v)]);
      }
    }
    return out;
  }

  void add_body(const results::GeometryBody& body) {
    const int node = static_cast<int>(file_.root["nodes"].size());
    const spatial::Pose X = run_store::pose_of(run_, body.name, still_.record);
    Json entry = {{"name", body.name},
                  {"translation", {X.p.x(), X.p.y(), X.p.z()}},
                  {"rotation", {X.q.x(), X.q.y(), X.q.z(), X.q.w()}}};
    const SurfaceMesh mesh = surface_mesh(body);
    if (!mesh.triangles.empty() || !mesh.lines.empty()) {
      entry["mesh"] = meshes_.size();
      add_mesh(body, mesh, node);
    }
    file_.root["nodes"].push_back(std::move(entry));
    file_.root["scenes"][0]["nodes"].push_back(node);
    if (instants_.size() > 1) animate_frame(body, node);
  }

  void add_mesh(const results::GeometryBody& body, const SurfaceMesh& mesh, int node) {
    Json primitive = {{"attributes", {{"POSITION", file_.add_vectors(mesh.positions, true)}}},
                      {"material", 0}};
    Json entry = {{"name", body.name}};
    if (mesh.triangles.empty()) {
      primitive["indices"] = file_.add_indices(mesh.lines);
      primitive["mode"] = kLines;
    } else {
      primitive["indices"] = file_.add_indices(mesh.triangles);
      primitive["mode"] = kTriangles;
      primitive["attributes"]["COLOR_0"] =
          file_.add_colours(colours_of(mesh, static_cast<std::size_t>(node)));
      const Shapes found = find_shapes(motion_of(body, mesh), options_.shapes);
      report_.shape_error = std::max(report_.shape_error, found.error);
      Json targets = Json::array();
      Json weights = Json::array();
      for (std::size_t k = 0; k < found.shapes.size(); ++k) {
        targets.push_back({{"POSITION", file_.add_vectors(found.shapes[k], true)}});
        weights.push_back(found.weights(found.weights.rows() - 1, static_cast<Eigen::Index>(k)));
      }
      if (!targets.empty()) {
        primitive["targets"] = std::move(targets);
        entry["weights"] = std::move(weights);
        if (instants_.size() > 1) animate_shapes(found, node);
      }
    }
    // Braces around one value are a copy to clang and an array to GCC.
    entry["primitives"] = Json::array({std::move(primitive)});
    meshes_.push_back(std::move(entry));
  }

  std::vector<Colour> colours_of(const SurfaceMesh& mesh, std::size_t body) const {
    const std::vector<double>& stress = stresses_[body];
    const double span = report_.most - report_.least;
    std::vector<Colour> out;
    for (const int node : mesh.nodes) {
      const double value = stress[static_cast<std::size_t>(node)];
      out.push_back(colour_of(span > 0.0 ? (value - report_.least) / span : 0.0 * value));
    }
    return out;
  }

  void animate_frame(const results::GeometryBody& body, int node) {
    Eigen::Matrix3Xf places(3, static_cast<Eigen::Index>(instants_.size()));
    std::vector<std::array<float, 4>> turns;
    Eigen::Vector4d before = Eigen::Vector4d::Zero();
    std::vector<std::size_t> records;
    for (const run_store::Instant& now : instants_) records.push_back(now.record);
    const std::vector<spatial::Pose> poses = run_store::poses_of(run_, body.name, records);
    for (std::size_t k = 0; k < instants_.size(); ++k) {
      const spatial::Pose& X = poses[k];
      places.col(static_cast<Eigen::Index>(k)) = X.p.cast<float>();
      Eigen::Vector4d q = X.q.coeffs();
      if (q.dot(before) < 0.0) q = -q;  // interpolation takes the short way
      before = q;
      const Eigen::Vector4f f = q.cast<float>();
      turns.push_back({f[0], f[1], f[2], f[3]});
    }
    add_channel(node, "translation", file_.add_vectors(places, false));
    add_channel(node, "rotation", file_.add_quaternions(turns));
  }

  void animate_shapes(const Shapes& found, int node) {
    std::vector<float> weights;
    for (Eigen::Index row = 0; row + 1 < found.weights.rows(); ++row) {
      for (Eigen::Index k = 0; k < found.weights.cols(); ++k) {
        weights.push_back(static_cast<float>(found.weights(row, k)));
      }
    }
    add_channel(node, "weights", file_.add_floats(weights, false));
  }

  void add_channel(int node, const char* path, int output) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", "LINEAR"}});
  }

  const run_store::RunReader& run_;
  const GlbOptions& options_;
  std::vector<run_store::Instant> instants_;
  run_store::Instant still_;
  std::vector<std::vector<double>> stresses_;  // per body and node
  GlbReport report_;
  GlbFile file_;
  int times_ = -1;
  Json meshes_ = Json::array(), samplers_ = Json::array(), channels_ = Json::array();
};

}  // namespace

GlbReport export_glb(const run_store::RunReader& run, const GlbOptions& options,
                     const std::filesystem::path& path) {
  return GlbExporter(run, options).write(path);
}

}  // namespace buckens::exports

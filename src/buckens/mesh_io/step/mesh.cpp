// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/mesh.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/stopwatch.h"
#include "buckens/fem/mesh/cell_measure.h"
#include "buckens/fem/mesh/straighten.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/step/faces.h"
#include "buckens/mesh_io/step/part_trials.h"
#include "buckens/mesh_io/step/progress.h"
#include "buckens/mesh_io/step/quick_settings.h"
#include "buckens/mesh_io/step/text.h"
#include "buckens/mesh_io/step/trial.h"

namespace buckens::mesh_io {

namespace {

namespace fs = std::filesystem;

/// A directory that vanishes with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (fs::temp_directory_path() / "buckens-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw IoError(fmt::format("cannot make a temporary directory {}: {}", pattern,
                                files::system_reason(errno)));
    }
    path_ = pattern;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

// Chords of coarse meshes lose volume at curved faces, a third at four elements per circle; edges
// on the true surface lose almost nothing, but straightened ones can reach into a bore.
constexpr double kLeastFlat = 0.6, kLeastCurved = 0.97, kMostVolume = 1.03;

void check_step(const std::string& text, const std::string& file) {
  if (text.find("ISO-10303-21;") > 200) {
    throw InputError({file, 1, 1}, "this is not a STEP file: it does not begin with ISO-10303-21");
  }
  if (text.find("END-ISO-10303-21;") != std::string::npos) return;
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  throw InputError({file, lines, 1},
                   "the STEP file is truncated: END-ISO-10303-21 is missing at its end");
}

/// The output lines of the other process.
class Told {
 public:
  Told(const std::string& lines, const std::vector<std::string>& names, StepMesh& out)
      : names_(names), out_(out) {
    for (const fem::ImportedFaceSet& set : out.mesh.face_sets) {
      const int number = std::atoi(set.name.c_str() + std::strlen(kFaceName));
      faces_[number].number = number;
    }
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) take(line);
    for (const auto& [number, face] : faces_) out.faces.push_back(face);
  }

  double volume() const { return volume_; }
  /// Seconds of each part of the work.
  const std::string& times() const { return times_; }

 private:
  void take(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "message" || word == "note") {
      out_.mesh.notes.push_back({word == "note" ? line.substr(5) : "Gmsh: " + line.substr(8)});
    } else if (word == "size") {
      words >> out_.size >> volume_;
    } else if (word == "time") {
      double seconds = 0;
      words >> word >> seconds;
      times_ += fmt::format("{}{} {:.2f} s", times_.empty() ? "" : ", ", word, seconds);
    } else {
      take_face(word, words);
    }
  }

  void take_face(const std::string& word, std::istringstream& words) {
    int number = 0;
    words >> number;
    const auto face = faces_.find(number);
    if (face == faces_.end()) return;
    if (word == "color") {
      std::array<int, 3> color{};
      words >> color[0] >> color[1] >> color[2];
      face->second.colors.push_back(color);
    } else if (word == "label") {
      std::size_t name = 0;
      words >> name;
      if (name < names_.size()) face->second.labels.push_back(names_[name]);
    }
  }

  const std::vector<std::string>& names_;
  StepMesh& out_;
  std::map<int, StepFace> faces_;
  double volume_ = 0;
  std::string times_;
};

double volume_of(const fem::ImportedMesh& mesh) {
  double out = 0;
  std::vector<Eigen::Vector3d> x;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    if (block.kind != fem::CellKind::tet4 && block.kind != fem::CellKind::tet10) continue;
    x.resize(block.kind == fem::CellKind::tet4 ? 4 : 10);
    for (std::size_t first = 0; first < block.nodes.size(); first += x.size()) {
      for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] = mesh.positions[static_cast<std::size_t>(block.nodes[first + k])];
      }
      out += fem::cell_measure(block.kind, x).size;
    }
  }
  return out;
}

void compare_volumes(fem::ImportedMesh& mesh, double of_solids, int order) {
  const double volume = volume_of(mesh);
  const double least = order == 2 ? kLeastCurved : kLeastFlat;
  if (volume > least * of_solids && volume < kMostVolume * of_solids) return;
  mesh.notes.push_back(
      {fmt::format("the elements fill {:.4g} m^3, but the solids of the file {:.4g} m^3: the "
                   "elements are too large, or the surface is wrong; try a smaller size",
                   volume, of_solids)});
}

void straighten(fem::ImportedMesh& mesh) {
  const int count = fem::straighten_inverted(mesh);
  if (count == 0) return;
  mesh.notes.push_back(
      {fmt::format("elements (of {}) that the curved surface would invert have straight edges",
                   mesh.num_elements()),
       0, count});
}

}  // namespace

StepMesh mesh_step(const fs::path& path, const std::string& text, const StepRequest& request) {
  const std::string file = path.string();
  check_step(text, file);
  if (request.order != 1 && request.order != 2) {
    throw InputError({file, 0, 0}, fmt::format("elements of order {} cannot be made; give 1 or 2",
                                               request.order));
  }
  const TemporaryDirectory directory;
  // Gmsh sees copies with plain names: it would interpret the user's.
  const fs::path step = directory / "part.step", named = directory / "named.step",
                 mesh = directory / "mesh.msh";
  const ColoredStep copy = color_named_faces(text);
  files::replace_text_file(step, text);
  if (!copy.names.empty()) files::replace_text_file(named, copy.text);
  MeshingProgress progress(file);
  StepTask task{step.string(), named.string(), mesh.string(), copy.names.size(), request};
  if (has_many_faces(text)) {
    write_quick_settings(directory.path());
    task.settings = directory.path().string();
  }
  const std::string doubt = missing_entities(text);
  PartTrials trials(task, file, doubt, progress);
  const std::string lines = trials.run();
  progress.stage("straightening");
  const base::Stopwatch watch;
  StepMesh out{read_gmsh_mesh(mesh, {}, kFaceName), {}};
  out.mesh.file = file;
  out.mesh.format = "STEP, meshed by Gmsh";
  const Told told(lines, copy.names, out);
  if (!doubt.empty()) out.mesh.notes.push_back({doubt});
  add_face_names(out.mesh, out.faces);
  if (request.order == 2) straighten(out.mesh);
  compare_volumes(out.mesh, told.volume(), request.order);
  out.mesh.making = fmt::format("size {:.4g} m; {}, straightening {:.2f} s", out.size, told.times(),
                                watch.seconds());
  if (trials.in_vain() > 0) {
    out.mesh.making += fmt::format(", other ways before {:.2f} s", trials.in_vain());
  }
  return out;
}

fem::ImportedMesh mesh_step(const fs::path& path, const StepRequest& request) {
  return mesh_step(path, files::read_text_file(path, "STEP file"), request).mesh;
}

fem::ImportedMesh with_face_names(StepMesh part, const std::vector<fem::GeometryFaceSpec>& names) {
  for (const fem::GeometryFaceSpec& face : names) name_faces(part.mesh, part.faces, face);
  return std::move(part.mesh);
}

}  // namespace buckens::mesh_io

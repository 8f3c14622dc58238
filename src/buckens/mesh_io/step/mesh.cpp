// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/mesh/straighten.h"
#include "buckens/files/isolated_work.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/step/faces.h"
#include "buckens/mesh_io/step/shapes.h"
#include "buckens/mesh_io/step/text.h"

namespace buckens::mesh_io {

namespace {

namespace fs = std::filesystem;

constexpr double kMostElements = 2e7;
constexpr double kTetrahedron = 0.1179;  // volume of a regular one with edges of length 1

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

  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

struct Order {
  std::string step, named_copy, mesh;
  double size;
  int order;
  std::size_t num_names;
};

/// The last part of "Shapes/assembly/rod", in a form that model files can write.
std::string label_of(const std::string& path, int number) {
  std::string out = path.substr(path.rfind('/') + 1);
  return out.empty() ? fmt::format("volume_{}", number) : out;
}

void set_mesh_options(GmshLibrary& gmsh, const Order& order) {
  gmsh.set_text("Geometry.OCCTargetUnit", "M");
  gmsh.set_number("Mesh.MeshSizeMax", order.size);
  gmsh.set_number("Mesh.MeshSizeMin", 0.25 * order.size);
  gmsh.set_number("Mesh.MeshSizeFromCurvature", 8);
  gmsh.set_number("Mesh.ElementOrder", order.order);
  gmsh.set_number("Mesh.HighOrderOptimize", order.order > 1 ? 1 : 0);
  gmsh.set_number("Mesh.MaxNumThreads1D", 1);
  gmsh.set_number("Mesh.MaxNumThreads2D", 1);
  gmsh.set_number("Mesh.MaxNumThreads3D", 1);
  gmsh.set_number("Mesh.Binary", 1);
  gmsh.set_number("Mesh.MshFileVersion", 4.1);
  gmsh.set_number("Mesh.SaveAll", 0);
}

std::string lost_text(const GluedShapes& shapes, const char* what) {
  if (shapes.lost == 0) return {};
  return fmt::format(
      "note {} of {} faces are lost where solids cut them; choose these faces by "
      "numbers or place\n",
      what, shapes.lost);
}

/// Colours of the copy in which they stand for names, one line per face.
std::string labels(GmshLibrary& gmsh, const Order& order, std::size_t num_faces) {
  const GluedShapes shapes = load_glued(gmsh, "names", order.named_copy);
  std::string out;
  if (gmsh.entities(2).size() == num_faces) {
    for (const ColoredShape& face : shapes.colors) {
      const auto& color = face.color;
      const int name = name_of_color({color.red, color.green, color.blue}, order.num_names);
      if (name >= 0) out += fmt::format("label {} {}\n", face.face, name);
    }
  }
  gmsh.use_model("part");
  return out + lost_text(shapes, "names");
}

/// What is done in the other process. @return one line per message, colour or label
std::string mesh_with_gmsh(const Order& order) {
  try {
    GmshLibrary gmsh;
    set_mesh_options(gmsh, order);
    const GluedShapes shapes = load_glued(gmsh, "part", order.step);
    const auto volumes = gmsh.entities(3);
    if (volumes.empty()) {
      return fmt::format("error the file has no solid, only {} faces; export the part as a solid",
                         gmsh.entities(2).size());
    }
    std::string out = lost_text(shapes, "colours");
    if (shapes.overlap) {
      out +=
          "note solids overlap: what they have in common is counted once and is a solid of its "
          "own, named after one of them or volume_<number>\n";
    }
    for (const auto& [face, color] : shapes.colors) {
      out += fmt::format("color {} {} {} {}\n", face, color.red, color.green, color.blue);
    }
    if (order.num_names > 0) out += labels(gmsh, order, gmsh.entities(2).size());
    double volume = 0;
    for (const GmshEntity& solid : volumes) volume += std::abs(gmsh.size(solid));
    const double expected = volume / (kTetrahedron * std::pow(order.size, 3));
    if (!(expected < kMostElements)) {
      return fmt::format(
          "error elements of {:g} m in a volume of {:g} m^3 would be {:.2g}; give a larger size",
          order.size, volume, expected);
    }
    std::map<std::string, std::vector<int>> solids;
    for (const GmshEntity& solid : volumes) {
      solids[label_of(gmsh.name(solid), solid.second)].push_back(solid.second);
    }
    for (const auto& [name, tags] : solids) gmsh.add_group(3, tags, name);
    for (const GmshEntity& face : gmsh.entities(2)) {
      gmsh.add_group(2, {face.second}, fmt::format("face_{}", face.second));
    }
    gmsh.mesh(3);
    gmsh.write(order.mesh);
    for (std::string message : gmsh.messages()) {
      std::replace(message.begin(), message.end(), '\n', ' ');
      out += fmt::format("message {}\n", message);
    }
    return out;
  } catch (const std::exception& error) {
    return fmt::format("error {}", error.what());
  }
}

void check_step(const std::string& text, const std::string& file) {
  if (text.find("ISO-10303-21;") > 200) {
    throw InputError({file, 1, 1}, "this is not a STEP file: it does not begin with ISO-10303-21");
  }
  if (text.find("END-ISO-10303-21;") != std::string::npos) return;
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  throw InputError({file, lines, 1},
                   "the STEP file is cut off: END-ISO-10303-21 is missing at its end");
}

/// Colours and labels out of the lines of the other process.
std::vector<StepFace> read_faces(const std::string& lines, const std::vector<std::string>& names,
                                 fem::ImportedMesh& mesh) {
  std::map<int, StepFace> faces;
  for (const fem::ImportedFaceSet& set : mesh.face_sets) {
    const int number = std::atoi(set.name.c_str() + 5);  // face_12
    faces[number].number = number;
  }
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string word;
    int number = 0;
    words >> word;
    if (word == "message" || word == "note") {
      mesh.notes.push_back({word == "note" ? line.substr(5) : "Gmsh: " + line.substr(8), 0, 1});
      continue;
    }
    words >> number;
    const auto face = faces.find(number);
    if (face == faces.end()) continue;
    if (word == "color") {
      std::array<int, 3> color{};
      words >> color[0] >> color[1] >> color[2];
      face->second.colors.push_back(color);
    } else if (word == "label") {
      std::size_t name = 0;
      words >> name;
      if (name < names.size()) face->second.labels.push_back(names[name]);
    }
  }
  std::vector<StepFace> out;
  for (const auto& [number, face] : faces) out.push_back(face);
  return out;
}

}  // namespace

StepMesh mesh_step(const fs::path& path, const std::string& text, double size, int order) {
  const std::string file = path.string();
  check_step(text, file);
  if (order != 1 && order != 2) {
    throw InputError({file, 0, 0},
                     fmt::format("elements of order {} cannot be made; give 1 or 2", order));
  }
  const TemporaryDirectory directory;
  // Gmsh sees copies with plain names: it would interpret the user's.
  const fs::path step = directory / "part.step", named = directory / "named.step",
                 mesh = directory / "mesh.msh";
  const ColoredStep copy = color_named_faces(text);
  files::replace_text_file(step, text);
  if (!copy.names.empty()) files::replace_text_file(named, copy.text);
  const Order task{step.string(), named.string(), mesh.string(), size, order, copy.names.size()};
  const files::IsolatedResult result = files::do_isolated([&] { return mesh_with_gmsh(task); });
  if (!result.is_complete) {
    throw InputError({file, 0, 0},
                     fmt::format("Gmsh's library crashed on this file (signal {}); is the geometry "
                                 "broken? Try another size, or export the part again",
                                 result.signal));
  }
  if (result.output.starts_with("error ")) {
    std::string reason = result.output.substr(6);
    const std::size_t at = reason.find(task.step);  // the copy is nothing to the user
    if (at != std::string::npos) reason.replace(at, task.step.size(), path.filename().string());
    throw InputError({file, 0, 0}, fmt::format("cannot be meshed: {}", reason));
  }
  StepMesh out{read_gmsh_mesh(mesh), {}};
  out.mesh.file = file;
  out.mesh.format = "STEP, meshed by Gmsh";
  out.faces = read_faces(result.output, copy.names, out.mesh);
  add_face_names(out.mesh, out.faces);
  const int straightened = order == 2 ? fem::straighten_inverted(out.mesh) : 0;
  if (straightened > 0) {
    out.mesh.notes.push_back(
        {"elements that the curved surface would invert have straight edges", 0, straightened});
  }
  return out;
}

fem::ImportedMesh mesh_step(const fs::path& path, double size, int order) {
  return mesh_step(path, files::read_text_file(path, "STEP file"), size, order).mesh;
}

fem::ImportedMesh with_face_names(StepMesh part, const std::vector<fem::GeometryFaceSpec>& names) {
  for (const fem::GeometryFaceSpec& face : names) name_faces(part.mesh, part.faces, face);
  return std::move(part.mesh);
}

}  // namespace buckens::mesh_io

// SPDX-License-Identifier: Apache-2.0
#include "cli/mesh_report_text.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text_table.h"

#include "buckens/files/vector_json.h"

namespace buckens::cli {

namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector3d;
using fem::MeshReport;
using files::json_of;

constexpr std::size_t kMostNamed = 5;
constexpr std::size_t kMostSets = 60;
/// Aspect ratio above which an element is called a sliver, as Nastran does for tetrahedra.
constexpr double kSliver = 100;

std::string vector_text(const Vector3d& v) {
  // Rounding leaves -0 and 1e-19 where zero is meant.
  Vector3d shown = v;
  for (double& x : shown) x = std::abs(x) < 1e-12 * v.norm() ? 0.0 : x;
  return fmt::format("[{:.5g}, {:.5g}, {:.5g}]", shown.x(), shown.y(), shown.z());
}

template <class Numbers>
std::string some_of(const Numbers& numbers) {
  std::vector<std::string> shown;
  for (const auto& number : numbers) {
    if (shown.size() == kMostNamed) {
      shown.emplace_back(fmt::format("and {} more", numbers.size() - kMostNamed));
      break;
    }
    shown.push_back(fmt::to_string(number));
  }
  return fmt::format("{}", fmt::join(shown, ", "));
}

std::string kinds_text(const MeshReport& report) {
  std::vector<std::string> out;
  for (const auto& kind : report.kinds) {
    const std::string name = fem::name_of(kind.kind);
    out.push_back(kind.source.empty() || kind.source == name
                      ? fmt::format("{} {}", kind.count, name)
                      : fmt::format("{} {} ({})", kind.count, name, kind.source));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

std::string box_text(const MeshReport& report) {
  const Vector3d size = report.box.sizes();
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m", size.x(), size.y(), size.z());
}

/// What is probably wrong, as sentences.
std::vector<std::string> complaints(const MeshReport& report) {
  std::vector<std::string> out = report.warnings;
  if (!report.inverted.empty()) {
    out.push_back(fmt::format("{} inverted or flat: {}",
                              report.inverted.size() == 1 ? "an element is" : "elements are",
                              some_of(report.inverted)));
  }
  if (!report.inverted_at_nodes.empty()) {
    out.push_back(fmt::format(
        "{} inverted or flat at a corner, though not where {} integrated: {}; a body can be made "
        "of {}, but stresses near such corners are unreliable",
        report.inverted_at_nodes.size() == 1
            ? "an element is"
            : fmt::format("{} elements are", report.inverted_at_nodes.size()),
        report.inverted_at_nodes.size() == 1 ? "it is" : "they are",
        some_of(report.inverted_at_nodes), report.inverted_at_nodes.size() == 1 ? "it" : "them"));
  }
  if (report.worst_aspect > kSliver && report.inverted.empty()) {
    out.push_back(fmt::format(
        "element {} at {} m is a sliver: its aspect ratio is {:.3g}, and stresses there are "
        "unreliable; such elements come from small faces and edges of the geometry",
        report.worst_element, vector_text(report.worst_centre), report.worst_aspect));
  }
  if (!report.duplicate_nodes.empty()) {
    std::vector<std::string> pairs;
    for (const auto& [a, b] : report.duplicate_nodes) pairs.push_back(fmt::format("{} = {}", a, b));
    out.push_back(
        fmt::format("nodes coincide: {}; if the parts belong together, merge them in the program "
                    "that made the mesh",
                    some_of(pairs)));
  }
  if (report.pieces > 1) {
    out.push_back(fmt::format("the mesh consists of {} disconnected pieces", report.pieces));
  }
  return out;
}

using Entries = std::vector<std::pair<std::string, std::string>>;

Entries mass_entries(const MeshReport& report) {
  Entries out;
  if (report.volume > 0) {
    out.emplace_back("volume", fmt::format("{:.6g} m^3, centre {} m", report.volume,
                                           vector_text(report.volume_centre)));
  }
  if (report.mass > 0) {
    const Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(report.inertia).eigenvalues();
    out.emplace_back("mass", fmt::format("{:.6g} kg", report.mass));
    out.emplace_back("mass centre", vector_text(report.mass_centre) + " m");
    out.emplace_back("principal inertia", vector_text(principal) + " kg m^2");
  }
  if (report.without_density > 0) {
    out.emplace_back("without density", counted(report.without_density, "element") +
                                            "; the model file gives the material");
  }
  return out;
}

std::string sets_text(const MeshReport& report) {
  std::string out;
  std::vector<std::vector<std::string>> rows = {{"property", "material", "elements"}};
  for (const auto& property : report.properties) {
    rows.push_back({property.name.empty() ? "(none)" : property.name,
                    property.material.empty() ? "-" : property.material,
                    fmt::to_string(property.elements)});
  }
  out += "properties\n" + text_table(rows);
  if (!report.face_sets.empty()) {
    rows = {{"face set", "faces", "area [m^2]", "centre [m]"}};
    for (const auto& set : report.face_sets) {
      if (rows.size() > kMostSets) break;
      rows.push_back({set.name, fmt::to_string(set.count), fmt::format("{:.4g}", set.area),
                      vector_text(set.centre)});
    }
    out += "faces, for `face:` of interfaces and loads\n" + text_table(rows);
    if (report.face_sets.size() + 1 > rows.size()) {
      out += fmt::format("  and {} more\n", report.face_sets.size() + 1 - rows.size());
    }
  }
  const auto list = [&](const char* title, const std::vector<MeshReport::NamedCount>& sets) {
    if (sets.empty()) return;
    std::vector<std::string> names;
    for (const auto& set : sets) {
      if (names.size() == kMostSets) {
        names.push_back(fmt::format("and {} more", sets.size() - kMostSets));
        break;
      }
      names.push_back(fmt::format("{} ({})", set.name, set.count));
    }
    out += fmt::format("{}\n  {}\n", title, fmt::join(names, ", "));
  };
  list("node sets, for `set:` of interfaces", report.node_sets);
  list("element sets, for `materials:`", report.element_sets);
  return out;
}

}  // namespace

std::string note_text(const fem::ImportNote& note) {
  std::string out = note.text;
  if (note.count > 1) out += fmt::format(" ({} times)", note.count);
  if (note.line > 0) out += fmt::format(" (line {})", note.line);
  return out;
}

std::string mesh_report_text(const fem::ImportedMesh& mesh, const MeshReport& report) {
  std::string out = fmt::format("{}: {}{}{}\n", mesh.file, mesh.format,
                                mesh.making.empty() ? "" : "; ", mesh.making);
  Entries entries = {
      {"nodes", fmt::to_string(report.nodes)},
      {"elements", kinds_text(report)},
      {"variables", fmt::to_string(report.variables)},
      {"size", fmt::format("{}, from {} to {} m", box_text(report), vector_text(report.box.min()),
                           vector_text(report.box.max()))}};
  const Entries masses = mass_entries(report);
  entries.insert(entries.end(), masses.begin(), masses.end());
  entries.emplace_back("worst aspect ratio",
                       report.worst_element == 0
                           ? "1"
                           : fmt::format("{:.3g} (element {} at {} m)", report.worst_aspect,
                                         report.worst_element, vector_text(report.worst_centre)));
  entries.emplace_back("pieces", fmt::to_string(report.pieces));
  if (!report.free_nodes.empty()) {
    entries.emplace_back("free nodes",
                         fmt::format("{}: {}; they are ignored", report.free_nodes.size(),
                                     some_of(report.free_nodes)));
  }
  out += text_list(entries) + sets_text(report);
  for (const fem::ImportNote& note : mesh.notes) out += "note: " + note_text(note) + '\n';
  for (const std::string& text : complaints(report)) out += "warning: " + text + '\n';
  return out;
}

Json mesh_report_json(const fem::ImportedMesh& mesh, const MeshReport& report) {
  Json kinds = Json::array(), properties = Json::array(), faces = Json::object(),
       node_sets = Json::object(), element_sets = Json::object(), duplicates = Json::array(),
       notes = Json::array();
  for (const auto& kind : report.kinds) {
    kinds.push_back(
        {{"kind", fem::name_of(kind.kind)}, {"source", kind.source}, {"count", kind.count}});
  }
  for (const auto& p : report.properties) {
    properties.push_back({{"name", p.name},
                          {"material", p.material},
                          {"elements", p.elements},
                          {"size", p.size},
                          {"mass", p.mass}});
  }
  for (const auto& set : report.face_sets) {
    faces[set.name] = {{"faces", set.count}, {"area", set.area}, {"centre", json_of(set.centre)}};
  }
  for (const auto& set : report.node_sets) node_sets[set.name] = set.count;
  for (const auto& set : report.element_sets) element_sets[set.name] = set.count;
  for (const auto& [a, b] : report.duplicate_nodes) duplicates.push_back({a, b});
  for (const auto& note : mesh.notes) notes.push_back(note_text(note));
  return {{"file", mesh.file},
          {"format", mesh.format},
          {"nodes", report.nodes},
          {"elements", report.elements},
          {"kinds", std::move(kinds)},
          {"variables", report.variables},
          {"box", {json_of(report.box.min()), json_of(report.box.max())}},
          {"volume", report.volume},
          {"volume_centre", json_of(report.volume_centre)},
          {"mass", report.mass},
          {"mass_centre", json_of(report.mass_centre)},
          {"inertia", json_of(report.inertia)},
          {"without_density", report.without_density},
          {"worst_aspect_ratio", report.worst_aspect},
          {"worst_element", report.worst_element},
          {"worst_centre", json_of(report.worst_centre)},
          {"inverted", report.inverted},
          {"inverted_at_nodes", report.inverted_at_nodes},
          {"duplicate_nodes", std::move(duplicates)},
          {"pieces", report.pieces},
          {"free_nodes", report.free_nodes},
          {"properties", std::move(properties)},
          {"face_sets", std::move(faces)},
          {"node_sets", std::move(node_sets)},
          {"element_sets", std::move(element_sets)},
          {"notes", std::move(notes)},
          {"warnings", complaints(report)}};
}

MeshNotes mesh_notes(const body::BodySpec& body) {
  const fem::ImportedMesh* mesh = nullptr;
  bool units_given = true;
  if (const auto* file = std::get_if<fem::MeshSpec>(&body.kind)) {
    mesh = file->imported.get();
    units_given = file->length_unit.has_value();
  } else if (const auto* part = std::get_if<fem::GeometrySpec>(&body.kind)) {
    mesh = part->imported.get();
  }
  if (mesh == nullptr) return {};
  const MeshReport report = fem::report_mesh(*mesh, units_given);
  MeshNotes out;
  out.summary = fmt::format("body \"{}\": {} ({}{}{}): {} nodes, {}, {}, worst aspect ratio {:.3g}",
                            body.name, mesh->file, mesh->format, mesh->making.empty() ? "" : ", ",
                            mesh->making, report.nodes, kinds_text(report), box_text(report),
                            report.worst_aspect);
  for (const std::string& text : complaints(report)) {
    out.complaints.push_back(fmt::format("body \"{}\": {}", body.name, text));
  }
  for (const fem::ImportNote& note : mesh->notes) {
    if (!note.is_doubtful) continue;
    out.complaints.push_back(fmt::format("body \"{}\": {}", body.name, note_text(note)));
  }
  // What the model file says instead is in the notes of `buckens mesh-info` only.
  const auto first = std::find_if(mesh->notes.begin(), mesh->notes.end(), [](const auto& note) {
    return !note.is_expected && !note.is_doubtful;
  });
  if (first != mesh->notes.end()) {
    std::string text = note_text(*first);
    if (mesh->notes.size() > 1) {
      text += fmt::format("; {} more notes in `buckens mesh-info`", mesh->notes.size() - 1);
    }
    out.complaints.push_back(fmt::format("body \"{}\": {}", body.name, text));
  }
  return out;
}

}  // namespace buckens::cli
